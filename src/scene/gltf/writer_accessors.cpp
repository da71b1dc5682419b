// Data in the buffer, and the accessors that say what they are.
#include <algorithm>
#include <bit>
#include <cstring>

#include "scene/gltf/writer_parts.hpp"

namespace lucerna::scene::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little-endian");

constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kVertices = 34962, kIndices = 34963;

// Begins at a multiple of four bytes, as every type here may.
template <typename T>
std::size_t addView(Output& out, std::span<const T> values, int target) {
  out.binary.resize((out.binary.size() + 3) / 4 * 4);
  const std::size_t offset = out.binary.size();
  out.binary.resize(offset + values.size_bytes());
  std::memcpy(out.binary.data() + offset, values.data(), values.size_bytes());
  return out.append("bufferViews", {{"buffer", 0},
                                    {"byteOffset", offset},
                                    {"byteLength", values.size_bytes()},
                                    {"target", target}});
}

template <typename T>
std::size_t addAccessor(Output& out, std::span<const T> values, int target, int component,
                        const char* type, Json more = Json::object()) {
  Json accessor{{"bufferView", addView(out, values, target)},
                {"componentType", component},
                {"count", values.size()},
                {"type", type}};
  accessor.update(more);
  return out.append("accessors", std::move(accessor));
}

}  // namespace

std::size_t addStream(Output& out, std::span<const vec2> values) {
  return addAccessor(out, values, kVertices, kFloat, "VEC2");
}

std::size_t addStream(Output& out, std::span<const vec3> values) {
  return addAccessor(out, values, kVertices, kFloat, "VEC3");
}

std::size_t addStream(Output& out, std::span<const vec4> values) {
  return addAccessor(out, values, kVertices, kFloat, "VEC4");
}

std::size_t addStream(Output& out, std::span<const u8vec4> values) {
  return addAccessor(out, values, kVertices, kUnsignedByte, "VEC4", {{"normalized", true}});
}

std::size_t addPositions(Output& out, std::span<const vec3> values) {
  vec3 low(values.front()), high(low);
  for (const vec3& p : values) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return addAccessor(out, values, kVertices, kFloat, "VEC3",
                     {{"min", jsonOf(low)}, {"max", jsonOf(high)}});
}

// glTF 2.0, 3.6.2: an accessor without a buffer view is zeros.
std::size_t addZeros(Output& out, std::size_t count) {
  return out.append("accessors", {{"componentType", kFloat}, {"count", count}, {"type", "VEC2"}});
}

std::size_t addIndices(Output& out, std::span<const std::uint32_t> values, std::size_t vertices) {
  constexpr std::size_t kMostShort = 65535;  // the highest value itself is not allowed
  if (vertices > kMostShort) return addAccessor(out, values, kIndices, kUnsignedInt, "SCALAR");
  const std::vector<std::uint16_t> narrow(values.begin(), values.end());
  return addAccessor(out, std::span(narrow), kIndices, kUnsignedShort, "SCALAR");
}

}  // namespace lucerna::scene::gltf
