#include "scene/gltf/draco_worker.hpp"

#include <draco/compression/decode.h>

#include <algorithm>
#include <cstdio>

#include "core/byte_stream.hpp"
#include "core/parallel.hpp"
#include "scene/gltf/draco_decode.hpp"

namespace lucerna::scene::gltf {

namespace {

template <typename T>
bool convert(const draco::PointAttribute& from, std::uint32_t vertices, std::uint32_t components,
             Bytes& to) {
  std::vector<T> values(components);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const auto entry = from.mapped_index(draco::PointIndex(i));
    if (!from.ConvertValue(entry, static_cast<std::int8_t>(components), values.data()))
      return false;
    std::memcpy(to.data() + i * components * sizeof(T), values.data(), components * sizeof(T));
  }
  return true;
}

bool convert(const draco::PointAttribute& from, std::uint32_t vertices,
             const DracoAttribute& wanted, Bytes& to) {
  const std::uint32_t components = wanted.components;
  switch (wanted.type) {
    case ComponentType::S8:
      return convert<std::int8_t>(from, vertices, components, to);
    case ComponentType::U8:
      return convert<std::uint8_t>(from, vertices, components, to);
    case ComponentType::S16:
      return convert<std::int16_t>(from, vertices, components, to);
    case ComponentType::U16:
      return convert<std::uint16_t>(from, vertices, components, to);
    case ComponentType::U32:
      return convert<std::uint32_t>(from, vertices, components, to);
    case ComponentType::F32:
      return convert<float>(from, vertices, components, to);
  }
  return false;
}

DracoMesh failed(std::string fault) {
  DracoMesh mesh;
  mesh.fault = std::move(fault);
  return mesh;
}

DracoMesh decode(const DracoRequest& request, std::span<const std::byte> packed) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return failed(decoded.status().error_msg_string());
  const draco::Mesh& source = *decoded.value();
  const std::uint64_t vertices = source.num_points(), indices = 3ull * source.num_faces();
  const std::uint64_t least = request.leastIndices, most = request.mostIndices;
  if (vertices != request.vertices || indices < least || indices > most)
    return failed(fmt::format(
        "{} vertices and {} indices, not {} and {} as its accessors state", vertices, indices,
        request.vertices,
        least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most)));
  DracoMesh mesh;
  mesh.indices.reserve(indices);
  for (draco::FaceIndex face(0); face < source.num_faces(); ++face)
    for (int corner = 0; corner < 3; ++corner)
      mesh.indices.push_back(source.face(face)[static_cast<std::size_t>(corner)].value());
  for (const DracoAttribute& wanted : request.attributes) {
    const draco::PointAttribute* attribute = source.GetAttributeByUniqueId(wanted.id);
    if (!attribute) return failed(fmt::format("no attribute with the id {}", wanted.id));
    Bytes& bytes = mesh.attributes.emplace_back(vertices * bytesOf(wanted));
    if (!convert(*attribute, source.num_points(), wanted, bytes))
      return failed(fmt::format("values of attribute {} that its accessor cannot hold", wanted.id));
  }
  return mesh;
}

Bytes readInput() {
  Bytes bytes;
  std::byte block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, stdin))
    bytes.insert(bytes.end(), block, block + count);
  return bytes;
}

}  // namespace

int dracoWorker() {
  const Bytes input = readInput();
  ByteReader reader(input);
  std::vector<Bytes> packed;
  std::vector<DracoRequest> requests;
  reader.list(packed, [](auto& r, Bytes& bytes) { r(bytes); });
  reader.list(requests, [](auto& r, DracoRequest& request) {
    r(request.packed), r(request.vertices), r(request.leastIndices), r(request.mostIndices);
    r.list(request.attributes, [](auto& list, DracoAttribute& a) {
      std::uint32_t type = 0;
      list(a.id), list(type), list(a.components);
      a.type = static_cast<ComponentType>(type);
    });
  });
  const bool sound = std::all_of(requests.begin(), requests.end(), [&](const auto& request) {
    return request.packed < packed.size();
  });
  if (!reader.good() || !reader.atEnd() || !sound) {
    std::fputs("draco is for Lucerna itself: it wants requests on stdin\n", stderr);
    return static_cast<int>(ErrorKind::Usage);
  }
  std::vector<DracoMesh> meshes(requests.size());
  parallelFor(requests.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      meshes[i] = decode(requests[i], packed[requests[i].packed]);
  });
  const Bytes answer = writeDracoAnswer(meshes);
  const bool written = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size() &&
                       std::fflush(stdout) == 0;
  return written ? 0 : static_cast<int>(ErrorKind::Failed);
}

}  // namespace lucerna::scene::gltf
