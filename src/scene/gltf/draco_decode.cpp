#include "scene/gltf/draco_decode.hpp"

#include "core/byte_stream.hpp"
#include "core/worker_program.hpp"

namespace lucerna::scene::gltf {

namespace {

constexpr const char* kDecoder = "the decoder of its Draco data";
constexpr const char* kRemedy = "export the file again, perhaps without KHR_draco_mesh_compression";

// A megabyte of packed data takes about a tenth of a second.
ChildLimits limitsFor(const DracoJob& job) {
  std::uint64_t packed = 0, unpacked = 0;
  for (const auto& bytes : job.packed) packed += bytes.size();
  for (const DracoRequest& request : job.requests) {
    std::uint64_t perVertex = 0;
    for (const DracoAttribute& attribute : request.attributes)
      perVertex += 4 * attribute.components;
    unpacked += request.vertices * perVertex + request.mostIndices * 4;
  }
  constexpr std::uint64_t kBytesPerMillisecond = 500;
  ChildLimits limits;
  limits.time = std::chrono::milliseconds(10'000 + packed / kBytesPerMillisecond);
  limits.residentBytes = (512ull << 20) + 8 * (packed + unpacked);
  limits.outputBytes = (1ull << 20) + unpacked + 1024 * job.requests.size();
  return limits;
}

Bytes written(const DracoJob& job) {
  ByteWriter writer;
  writer.list(job.packed, [](auto& w, const auto& bytes) { w(bytes); });
  writer.list(job.requests, [](auto& w, const DracoRequest& request) {
    w(request.packed), w(request.vertices), w(request.leastIndices), w(request.mostIndices);
    w.list(request.attributes, [](auto& list, const DracoAttribute& a) {
      list(a.id), list(static_cast<std::uint32_t>(a.type)), list(a.components);
    });
  });
  return std::move(writer.bytes);
}

bool fits(const DracoMesh& mesh, const DracoRequest& request) {
  if (mesh.indices.size() < request.leastIndices || mesh.indices.size() > request.mostIndices ||
      mesh.attributes.size() != request.attributes.size())
    return false;
  for (std::size_t i = 0; i < mesh.attributes.size(); ++i)
    if (mesh.attributes[i].size() != request.vertices * bytesOf(request.attributes[i]))
      return false;
  return true;
}

}  // namespace

Result<std::vector<DracoMesh>> decodeDraco(const DracoJob& job) {
  const Bytes input = written(job);
  const WorkerAnswer answer = runWorker({.arguments = {"draco"},
                                         .input = input,
                                         .limits = limitsFor(job),
                                         .name = kDecoder,
                                         .kind = ErrorKind::Input,
                                         .remedy = kRemedy});
  LUCERNA_TRY_VOID(answer.status);
  return readDracoAnswer(job.requests, answer.out);
}

Bytes writeDracoAnswer(std::span<const DracoMesh> meshes) {
  ByteWriter writer;
  for (const DracoMesh& mesh : meshes) {
    writer(mesh.fault), writer(mesh.indices);
    writer.list(mesh.attributes, [](auto& w, const Bytes& bytes) { w(bytes); });
  }
  return std::move(writer.bytes);
}

Result<std::vector<DracoMesh>> readDracoAnswer(std::span<const DracoRequest> requests,
                                               std::span<const std::byte> answer) {
  ByteReader reader(answer);
  std::vector<DracoMesh> meshes(requests.size());
  bool good = true;
  for (std::size_t i = 0; good && i < meshes.size(); ++i) {
    DracoMesh& mesh = meshes[i];
    reader(mesh.fault), reader(mesh.indices);
    reader.list(mesh.attributes, [](auto& r, Bytes& bytes) { r(bytes); });
    good = reader.good() && (!mesh.fault.empty() || fits(mesh, requests[i]));
  }
  if (!good || !reader.atEnd())
    return error(ErrorKind::Input, "{} answered with something else; {}", kDecoder, kRemedy);
  return meshes;
}

}  // namespace lucerna::scene::gltf
