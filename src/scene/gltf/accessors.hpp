// Accessors: typed arrays inside the buffers, checked against them once and then read.
#pragma once

#include <span>
#include <vector>

#include "scene/gltf/document.hpp"

namespace lucerna::scene::gltf {

enum class ComponentType { S8 = 5120, U8, S16, U16, U32 = 5125, F32 };

std::uint32_t bytesOf(ComponentType type);

struct Accessor {
  Place place;
  std::uint32_t count = 0;
  ComponentType type = ComponentType::F32;
  int components = 1;  // 1 to 4; matrices: 4, 9, 16
  bool normalized = false;
  std::uint32_t stride = 0;               // bytes from element to element
  std::span<const std::byte> bytes = {};  // of the first to the last element; empty: all zero
  bool lost = false;                      // its data is not in the file
};

// All accessors, sparse ones put together; checks every number of theirs. Throws Fault.
std::vector<Accessor> readAccessors(Document& document);

// Elements as floats, `components` each, the normalized ones divided by their maximum. `elements`
// says which ones (below count); empty: all. A missing fourth component is 1, others 0.
std::vector<float> readFloats(Document& document, const Accessor& accessor, int components,
                              std::span<const std::uint32_t> elements = {});
// A SCALAR accessor of unsigned integers. Throws Fault if it is another.
std::vector<std::uint32_t> readIndices(Document& document, const Accessor& accessor);

// "VEC3 of float"
std::string typeName(const Accessor& accessor);

}  // namespace lucerna::scene::gltf
