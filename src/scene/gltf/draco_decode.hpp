// Decoding Draco's meshes, in a child process (draco_worker.hpp): the decoder may crash, hang or
// take any amount of memory on hostile data.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "core/result.hpp"
#include "scene/gltf/accessors.hpp"

namespace lucerna::scene::gltf {

struct DracoAttribute {
  std::uint32_t id = 0;  // Draco's unique id
  ComponentType type = ComponentType::F32;
  std::uint32_t components = 1;
};

// Of a vertex.
inline std::uint64_t bytesOf(const DracoAttribute& attribute) {
  return std::uint64_t{attribute.components} * bytesOf(attribute.type);
}

// What is wanted of a piece of packed data, and how much may come of it.
struct DracoRequest {
  std::span<const std::byte> packed;
  std::vector<DracoAttribute> attributes;
  std::uint64_t vertices = 0, indices = 0;
};

struct DracoMesh {
  std::string fault;                   // what is wrong with the data; empty: the rest counts
  std::vector<std::uint32_t> indices;  // three a triangle
  std::vector<Bytes> attributes;       // in the order of the request: all vertices, packed
};

// One mesh a request. Meshes have exactly the vertices and indices that were stated, else a fault.
// The error is one phrase: what became of the child.
Result<std::vector<DracoMesh>> decodeDraco(std::span<const DracoRequest> requests);

}  // namespace lucerna::scene::gltf
