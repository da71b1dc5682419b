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
  std::uint32_t packed = 0;  // in DracoJob::packed
  std::vector<DracoAttribute> attributes;
  std::uint64_t vertices = 0, leastIndices = 0, mostIndices = 0;
};

struct DracoJob {
  std::vector<std::span<const std::byte>> packed;  // each once, however many ask for it
  std::vector<DracoRequest> requests;
};

struct DracoMesh {
  std::string fault;                   // what is wrong with the data; empty: the rest counts
  std::vector<std::uint32_t> indices;  // three a triangle
  std::vector<Bytes> attributes;       // in the order of the request: all vertices, packed
};

// One mesh a request. Meshes have the vertices and indices that were stated, else a fault. The
// error tells what became of the child: "the decoder of its Draco data ...".
Result<std::vector<DracoMesh>> decodeDraco(const DracoJob& job);

// What the child answers, and how that is read: whatever it wrote, each mesh has a fault or what
// its request says, but for indices, which may be of any size.
Bytes writeDracoAnswer(std::span<const DracoMesh> meshes);
Result<std::vector<DracoMesh>> readDracoAnswer(std::span<const DracoRequest> requests,
                                               std::span<const std::byte> answer);

}  // namespace lucerna::scene::gltf
