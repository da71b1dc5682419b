// EXT_meshopt_compression: buffer views whose bytes meshoptimizer packed. Its decoders check their
// input; what they are told of its size is checked here.
#include <meshoptimizer.h>

#include <limits>

#include "scene/gltf/document.hpp"

namespace lucerna::scene::gltf {

namespace {

struct Packed {
  std::span<const std::byte> bytes;
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};

void requireStride(const Place& place, const Packed& packed) {
  const bool attributes = packed.mode == "ATTRIBUTES";
  const std::size_t stride = packed.stride;
  if (attributes ? stride % 4 != 0 : stride != 2 && stride != 4) {
    place.at("byteStride").refuse(attributes ? "a multiple of 4" : "2 or 4, the size of an index");
  }
  if (packed.filter == "OCTAHEDRAL" && stride != 4 && stride != 8)
    place.at("byteStride").refuse("4 or 8 for the filter OCTAHEDRAL");
  if (packed.filter == "QUATERNION" && stride != 8)
    place.at("byteStride").refuse("8 for the filter QUATERNION");
}

Packed readPacked(const Place& place) {
  Packed packed;
  packed.count = place.at("count").integer(1, std::numeric_limits<std::uint32_t>::max());
  packed.stride = place.at("byteStride").integer(1, 256);
  packed.mode = place.at("mode").text();
  packed.filter = place.text("filter", "NONE");
  if (packed.mode != "ATTRIBUTES" && packed.mode != "TRIANGLES" && packed.mode != "INDICES")
    place.at("mode").refuse("\"ATTRIBUTES\", \"TRIANGLES\" or \"INDICES\"");
  if (packed.filter != "NONE" && packed.filter != "OCTAHEDRAL" && packed.filter != "QUATERNION" &&
      packed.filter != "EXPONENTIAL")
    place.at("filter").refuse("\"NONE\", \"OCTAHEDRAL\", \"QUATERNION\" or \"EXPONENTIAL\"");
  if (packed.filter != "NONE" && packed.mode != "ATTRIBUTES")
    place.at("filter").refuse("\"NONE\", for only ATTRIBUTES have filters");
  if (packed.mode == "TRIANGLES" && packed.count % 3 != 0)
    place.at("count").refuse("a multiple of 3, for they are triangles");
  requireStride(place, packed);
  return packed;
}

bool unpack(const Packed& packed, std::byte* to) {
  const auto* from = reinterpret_cast<const unsigned char*>(packed.bytes.data());
  const std::size_t size = packed.bytes.size();
  if (packed.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(to, packed.count, packed.stride, from, size) == 0;
  if (packed.mode == "INDICES")
    return meshopt_decodeIndexSequence(to, packed.count, packed.stride, from, size) == 0;
  if (meshopt_decodeVertexBuffer(to, packed.count, packed.stride, from, size) != 0) return false;
  if (packed.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to, packed.count, packed.stride);
  if (packed.filter == "QUATERNION") meshopt_decodeFilterQuat(to, packed.count, packed.stride);
  if (packed.filter == "EXPONENTIAL") meshopt_decodeFilterExp(to, packed.count, packed.stride);
  return true;
}

}  // namespace

void unpackMeshopt(Document& document, const Place& place,
                   std::span<const std::span<const std::byte>> buffers, BufferView& view) {
  Packed packed = readPacked(place);
  const auto bytes = buffers[place.at("buffer").index(buffers.size(), "buffers")];
  const std::uint64_t offset = place.integer("byteOffset", 0, 0, bytes.size());
  const std::uint64_t length =
      place.at("byteLength").integer(1, std::numeric_limits<std::uint32_t>::max());
  if (length > bytes.size() - offset) {
    place.at("byteLength")
        .refuse(fmt::format("{} at byte {}", length, offset),
                fmt::format("packed data inside the {} bytes of its buffer", bytes.size()));
  }
  packed.bytes = bytes.subspan(offset, length);
  if (packed.count * packed.stride > view.length) {
    place.at("count").refuse(
        fmt::format("{} elements of {} bytes", packed.count, packed.stride),
        fmt::format("what fits into the {} bytes of the bufferView", view.length));
  }
  if (view.stride != 0 && view.stride != packed.stride) {
    place.at("byteStride").refuse(fmt::format("{}, the byteStride of the bufferView", view.stride));
  }
  document.spend(view.length, place);
  Bytes unpacked(view.length);
  if (!unpack(packed, unpacked.data())) {
    fail(place.pointer(), "data that meshoptimizer cannot unpack",
         fmt::format("{} elements of {} bytes, packed as {}", packed.count, packed.stride,
                     packed.mode));
  }
  document.resources.push_back(std::move(unpacked));
  view.bytes = document.resources.back();
}

}  // namespace lucerna::scene::gltf
