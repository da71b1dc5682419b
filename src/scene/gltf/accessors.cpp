#include "scene/gltf/accessors.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace lucerna::scene::gltf {

namespace {

struct Shape {
  const char* name;
  int components;
};
constexpr std::array<Shape, 7> kShapes{
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};

std::uint32_t elementBytes(const Accessor& accessor) {
  return bytesOf(accessor.type) * static_cast<std::uint32_t>(accessor.components);
}

ComponentType readComponentType(const Place& owner) {
  const Place place = owner.at("componentType");
  const auto value = place.integer(0, std::numeric_limits<std::uint64_t>::max());
  if (value < 5120 || value > 5126 || value == 5124) {
    place.refuse("one of 5120, 5121, 5122, 5123, 5125, 5126");
  }
  return static_cast<ComponentType>(value);
}

// The bytes of `count` elements in the view that `owner` names; the view's stride, if it has one,
// is written to `stride`, which comes in as the size of an element.
std::span<const std::byte> locate(const Document& document, const Place& owner, std::uint32_t count,
                                  std::uint32_t& stride, bool& lost) {
  const BufferView& view =
      document.views[owner.at("bufferView").index(document.views.size(), "bufferViews")];
  const std::uint32_t element = stride;
  if (view.stride != 0) {
    if (view.stride < element) {
      owner.refuse(
          fmt::format("elements of {} bytes in a view with byteStride {}", element, view.stride),
          "a stride that holds an element");
    }
    stride = view.stride;
  }
  const std::uint64_t offset =
      owner.integer("byteOffset", 0, 0, std::numeric_limits<std::uint32_t>::max());
  const std::uint64_t needed = std::uint64_t{stride} * (count - 1) + element;
  if (offset + needed > view.length) {
    owner.refuse(fmt::format("{} elements at byte {}, {} bytes in all", count, offset, needed),
                 fmt::format("elements inside the {} bytes of their bufferView", view.length));
  }
  if (view.bytes.empty()) {
    lost = true;
    return {};
  }
  return view.bytes.subspan(offset, needed);
}

template <typename T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

template <typename T>
void convert(const Accessor& accessor, std::span<const std::uint32_t> elements, int components,
             std::size_t count, float* out) {
  const int shared = std::min(components, accessor.components);
  const float scale =
      accessor.normalized ? 1.f / static_cast<float>(std::numeric_limits<T>::max()) : 1.f;
  for (std::size_t i = 0; i < count; ++i, out += components) {
    const std::size_t element = elements.empty() ? i : elements[i];
    const std::byte* from = accessor.bytes.data() + element * accessor.stride;
    for (int c = 0; c < shared; ++c) {
      const float value = static_cast<float>(load<T>(from + c * sizeof(T)));
      out[c] = accessor.normalized ? std::max(value * scale, -1.f) : value;
    }
  }
}

// Writes the elements that a sparse accessor changes over a packed copy of the others.
void applySparse(Document& document, Accessor& accessor, const Place& sparse) {
  const std::uint32_t element = elementBytes(accessor);
  document.spend(std::uint64_t{accessor.count} * element, accessor.place);
  Bytes packed(std::size_t{accessor.count} * element);
  for (std::size_t i = 0; i < accessor.count && !accessor.bytes.empty(); ++i) {
    std::memcpy(packed.data() + i * element, accessor.bytes.data() + i * accessor.stride, element);
  }

  const Place indexPlace = sparse.at("indices"), valuePlace = sparse.at("values");
  Accessor indices{indexPlace};
  indices.count = static_cast<std::uint32_t>(sparse.at("count").integer(1, accessor.count));
  indices.type = readComponentType(indexPlace);
  indices.stride = bytesOf(indices.type);
  indices.bytes = locate(document, indexPlace, indices.count, indices.stride, indices.lost);
  std::uint32_t stride = element;
  const auto values = locate(document, valuePlace, indices.count, stride, indices.lost);
  const auto targets = readIndices(document, indices);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i] >= accessor.count) {
      indexPlace.refuse(fmt::format("index {}", targets[i]),
                        fmt::format("indices below the accessor's count of {}", accessor.count));
    }
    std::memcpy(packed.data() + std::size_t{targets[i]} * element, values.data() + i * stride,
                element);
  }
  document.resources.push_back(std::move(packed));
  accessor.bytes = document.resources.back();
  accessor.stride = element;
}

Accessor readAccessor(Document& document, const Place& place) {
  Accessor accessor{place};
  accessor.type = readComponentType(place);
  const std::string& name = place.at("type").text();
  const auto shape =
      std::find_if(kShapes.begin(), kShapes.end(), [&](const Shape& s) { return name == s.name; });
  if (shape == kShapes.end()) place.at("type").refuse("SCALAR, VEC2 to VEC4 or MAT2 to MAT4");
  accessor.components = shape->components;
  accessor.count = static_cast<std::uint32_t>(
      place.at("count").integer(1, std::numeric_limits<std::uint32_t>::max()));
  accessor.normalized = place.boolean("normalized", false);
  if (accessor.normalized &&
      (accessor.type == ComponentType::F32 || accessor.type == ComponentType::U32)) {
    document.warn(place,
                  "is normalized, which only 8- and 16-bit integers can be: read as not "
                  "normalized");
    accessor.normalized = false;
  }
  accessor.stride = elementBytes(accessor);
  if (place.has("bufferView")) {
    accessor.bytes = locate(document, place, accessor.count, accessor.stride, accessor.lost);
  }
  if (const auto sparse = place.find("sparse")) applySparse(document, accessor, *sparse);
  return accessor;
}

void requireData(const Accessor& accessor) {
  if (accessor.lost) {
    accessor.place.refuse("a buffer without a uri, whose data is nowhere",
                          "a buffer with a uri, or a .glb with a BIN chunk");
  }
}

}  // namespace

std::uint32_t bytesOf(ComponentType type) {
  switch (type) {
    case ComponentType::S8:
    case ComponentType::U8:
      return 1;
    case ComponentType::S16:
    case ComponentType::U16:
      return 2;
    default:
      return 4;
  }
}

std::vector<Accessor> readAccessors(Document& document) {
  std::vector<Accessor> accessors;
  for (const Place& place : document.root().elements("accessors")) {
    accessors.push_back(readAccessor(document, place));
  }
  return accessors;
}

std::vector<float> readFloats(Document& document, const Accessor& accessor, int components,
                              std::span<const std::uint32_t> elements) {
  requireData(accessor);
  const std::size_t count = elements.empty() ? accessor.count : elements.size();
  document.spend(count * components * sizeof(float), accessor.place);
  std::vector<float> result(count * components);
  if (components == 4 && accessor.components < 4) {
    for (std::size_t i = 3; i < result.size(); i += 4) result[i] = 1.f;
  }
  if (accessor.bytes.empty()) return result;
  const bool packed = accessor.type == ComponentType::F32 && accessor.components == components &&
                      accessor.stride == elementBytes(accessor);
  if (packed && elements.empty()) {
    std::memcpy(result.data(), accessor.bytes.data(), result.size() * sizeof(float));
    return result;
  }
  switch (accessor.type) {
    case ComponentType::S8:
      convert<std::int8_t>(accessor, elements, components, count, result.data());
      break;
    case ComponentType::U8:
      convert<std::uint8_t>(accessor, elements, components, count, result.data());
      break;
    case ComponentType::S16:
      convert<std::int16_t>(accessor, elements, components, count, result.data());
      break;
    case ComponentType::U16:
      convert<std::uint16_t>(accessor, elements, components, count, result.data());
      break;
    case ComponentType::U32:
      convert<std::uint32_t>(accessor, elements, components, count, result.data());
      break;
    case ComponentType::F32:
      convert<float>(accessor, elements, components, count, result.data());
      break;
  }
  return result;
}

std::vector<std::uint32_t> readIndices(Document& document, const Accessor& accessor) {
  requireData(accessor);
  const bool isUnsigned = accessor.type == ComponentType::U8 ||
                          accessor.type == ComponentType::U16 ||
                          accessor.type == ComponentType::U32;
  if (accessor.components != 1 || !isUnsigned) {
    accessor.place.refuse(typeName(accessor),
                          "SCALAR of unsigned integers, because they are indices");
  }
  document.spend(std::uint64_t{accessor.count} * 4, accessor.place);
  std::vector<std::uint32_t> result(accessor.count);
  if (accessor.bytes.empty()) return result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::byte* from = accessor.bytes.data() + i * accessor.stride;
    result[i] = accessor.type == ComponentType::U8    ? load<std::uint8_t>(from)
                : accessor.type == ComponentType::U16 ? load<std::uint16_t>(from)
                                                      : load<std::uint32_t>(from);
  }
  return result;
}

std::string typeName(const Accessor& accessor) {
  static constexpr std::array kNames = {
      "signed bytes",      "unsigned bytes", "signed shorts", "unsigned shorts", "?",
      "unsigned integers", "floats"};
  const auto shape = std::find_if(kShapes.begin(), kShapes.end(), [&](const Shape& s) {
    return s.components == accessor.components;
  });
  return fmt::format("{} of {}", shape->name,
                     kNames[static_cast<std::size_t>(accessor.type) - 5120]);
}

}  // namespace lucerna::scene::gltf
