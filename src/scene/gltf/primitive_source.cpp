#include "scene/gltf/primitive_source.hpp"

#include <algorithm>

namespace lucerna::scene::gltf {

PrimitiveSource::PrimitiveSource(Context& context, const Place& primitive, std::string name)
    : context_(context), primitive_(primitive), name_(std::move(name)) {
  const auto packed = context.unpacked.find(primitiveKey(primitive));
  if (packed != context.unpacked.end()) unpacked_ = &*packed->second;
}

const Accessor* PrimitiveSource::attribute(const char* name,
                                           std::initializer_list<int> components) {
  const Place attributes = primitive_.at("attributes");
  const Accessor* accessor = find(attributes, name);
  if (accessor && unpacked_) {
    const auto unpacked = unpacked_->attributes.find(name);
    if (unpacked != unpacked_->attributes.end()) accessor = &unpacked->second;
  }
  return checked(attributes, name, accessor, components);
}

const Accessor* PrimitiveSource::targetAttribute(const Place& target, const char* name,
                                                 std::initializer_list<int> components) {
  return checked(target, name, find(target, name), components);
}

const Accessor* PrimitiveSource::find(const Place& owner, const char* name) const {
  const auto index = owner.index(name, context_.accessors.size(), "accessors");
  return index == kNone ? nullptr : &context_.accessors[index];
}

const Accessor* PrimitiveSource::checked(const Place& owner, const char* name,
                                         const Accessor* accessor,
                                         std::initializer_list<int> components) {
  if (!accessor) return nullptr;
  if (vertexCount_ == 0) vertexCount_ = accessor->count;
  if (accessor->count != vertexCount_) {
    owner.at(name).refuse(fmt::format("an accessor with count {}", accessor->count),
                          fmt::format("{}, the count of POSITION", vertexCount_));
  }
  if (std::find(components.begin(), components.end(), accessor->components) == components.end()) {
    accessor->place.refuse(typeName(*accessor),
                           fmt::format("VEC{} for {}", *(components.end() - 1), name));
  }
  return accessor;
}

int PrimitiveSource::mode() const {
  constexpr int kTriangles = 4;
  return unpacked_ ? kTriangles : static_cast<int>(primitive_.integer("mode", kTriangles, 0, 6));
}

const Accessor* PrimitiveSource::indices() const {
  if (unpacked_) return &unpacked_->indices;
  const auto index = primitive_.index("indices", context_.accessors.size(), "accessors");
  return index == kNone ? nullptr : &context_.accessors[index];
}

void PrimitiveSource::keepUsedVertices(std::vector<std::uint32_t>& elements) {
  if (elements.size() * 2 >= vertexCount_) return;
  vertices_ = elements;
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (std::uint32_t& index : elements) {
    index = static_cast<std::uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), index) -
                                       vertices_.begin());
  }
}

}  // namespace lucerna::scene::gltf
