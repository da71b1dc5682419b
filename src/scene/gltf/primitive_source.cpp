#include "scene/gltf/primitive_source.hpp"

#include <algorithm>

namespace lucerna::scene::gltf {

const Accessor* PrimitiveSource::attribute(const Place& owner, const char* name,
                                           std::initializer_list<int> components) {
  const auto index = owner.index(name, context_.accessors.size(), "accessors");
  if (index == kNone) return nullptr;
  const Accessor& accessor = context_.accessors[index];
  if (vertexCount_ == 0) vertexCount_ = accessor.count;
  if (accessor.count != vertexCount_) {
    owner.at(name).refuse(fmt::format("an accessor with count {}", accessor.count),
                          fmt::format("{}, the count of POSITION", vertexCount_));
  }
  if (std::find(components.begin(), components.end(), accessor.components) == components.end()) {
    accessor.place.refuse(typeName(accessor),
                          fmt::format("VEC{} for {}", *(components.end() - 1), name));
  }
  return &accessor;
}

const Accessor* PrimitiveSource::indices() const {
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
