#include "lightmap/geometry_hash.hpp"

#include <span>
#include <vector>

#include "core/hash.hpp"

namespace lucerna::lightmap {

std::uint64_t geometryHash(const scene::Scene& scene) {
  std::vector<std::uint64_t> meshes;
  for (const scene::Mesh& mesh : scene.meshes)
    meshes.push_back(hashBytes(std::as_bytes(std::span(mesh.indices)),
                               hashBytes(std::as_bytes(std::span(mesh.positions)))));
  std::uint64_t hash = scene.objects.size();
  for (const scene::Object& object : scene.objects) hash = hashCombine(hash, meshes[object.mesh]);
  return hash;
}

}  // namespace lucerna::lightmap
