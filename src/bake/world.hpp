// A scene's triangles where they stand: what is unwrapped and lit, and what is in the way of light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace lucerna::bake {

// The triangles of one of Scene::objects: as many as its mesh has, in the same order.
struct WorldObject {
  std::uint32_t object = 0;
  std::uint32_t firstTriangle = 0, triangleCount = 0;  // of the world's
  bool receives = true;                                // light; what is unlit does not
  bool mirrored = false;  // the front of its triangles is their clockwise side
};

// m from the origin, along each axis: where floats tell 6 cm.
inline constexpr float kFarthestCorner = 1e6f;

// The scene outlives it.
struct World {
  const scene::Scene* scene = nullptr;
  std::vector<vec3> positions;  // m, within kFarthestCorner; else NaN: its triangles are none
  std::vector<vec3> normals;    // unit, towards the front; as positions
  std::vector<std::uint32_t> indices;  // three a triangle, as the meshes order them
  std::vector<WorldObject> objects;    // those with triangles
  std::vector<std::uint32_t> owners;   // of each triangle, its place in objects
  std::size_t huge = 0;                // triangles with a corner that lies farther off

  std::size_t triangleCount() const { return indices.size() / 3; }
  std::span<const std::uint32_t> indicesOf(const WorldObject& object) const {
    return std::span(indices).subspan(3 * std::size_t{object.firstTriangle},
                                      3 * std::size_t{object.triangleCount});
  }
};

// As the scene stands: bent meshes as they are bent now.
World makeWorld(const scene::Scene& scene);

}  // namespace lucerna::bake
