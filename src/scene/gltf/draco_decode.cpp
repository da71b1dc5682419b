#include "scene/gltf/draco_decode.hpp"

#include "core/byte_stream.hpp"
#include "core/child_process.hpp"
#include "core/worker_program.hpp"

namespace lucerna::scene::gltf {

namespace {

// A megabyte of packed data takes about a tenth of a second.
ChildLimits limitsFor(std::span<const DracoRequest> requests) {
  std::uint64_t packed = 0, unpacked = 0;
  for (const DracoRequest& request : requests) {
    packed += request.packed.size();
    std::uint64_t perVertex = 0;
    for (const DracoAttribute& attribute : request.attributes)
      perVertex += 4 * attribute.components;
    unpacked += request.vertices * perVertex + request.indices * 4;
  }
  constexpr std::uint64_t kBytesPerMillisecond = 500;
  ChildLimits limits;
  limits.time = std::chrono::milliseconds(10'000 + packed / kBytesPerMillisecond);
  limits.residentBytes = (512ull << 20) + 8 * (packed + unpacked);
  limits.outputBytes = (1ull << 20) + unpacked + 1024 * requests.size();
  return limits;
}

}  // namespace

Result<std::vector<DracoMesh>> decodeDraco(std::span<const DracoRequest> requests) {
  ByteWriter writer;
  writer(static_cast<std::uint64_t>(requests.size()));
  for (const DracoRequest& request : requests) {
    writer(request.vertices), writer(request.indices);
    writer.list(request.attributes, [](auto& w, const DracoAttribute& a) {
      w(a.id), w(static_cast<std::uint32_t>(a.type)), w(a.components);
    });
    writer(request.packed);
  }
  const ChildLimits limits = limitsFor(requests);
  const ChildOutput output = runChild(workerProgram(), {"draco"}, writer.bytes, limits);
  if (output.end == ChildOutput::End::Cancelled)
    return error(ErrorKind::Cancelled, "reading was cancelled");
  if (output.end != ChildOutput::End::Exited || output.status != 0)
    return error(ErrorKind::Input, "{}", describeEnd(output, limits));

  ByteReader reader(output.out);
  std::vector<DracoMesh> meshes(requests.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    DracoMesh& mesh = meshes[i];
    reader(mesh.fault), reader(mesh.indices);
    reader.list(mesh.attributes, [](auto& r, Bytes& bytes) { r(bytes); });
    if (!mesh.fault.empty()) continue;
    bool fits = mesh.indices.size() == requests[i].indices &&
                mesh.attributes.size() == requests[i].attributes.size();
    for (std::size_t k = 0; fits && k < mesh.attributes.size(); ++k)
      fits = mesh.attributes[k].size() == requests[i].vertices * bytesOf(requests[i].attributes[k]);
    if (!fits) return error(ErrorKind::Input, "answered with something else");
  }
  if (!reader.good() || !reader.atEnd())
    return error(ErrorKind::Input, "answered with something else");
  return meshes;
}

}  // namespace lucerna::scene::gltf
