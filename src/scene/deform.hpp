// What bends a mesh: morph targets and skins.
//
// complete() gives each object that bends a mesh of its own, and updateTransforms() writes that
// mesh's vertices and bounds, in object space, whenever joints or weights changed. So who draws,
// culls, traces or bakes Scene::meshes sees the pose and need not know of any of this;
// Mesh::version tells that vertices changed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::scene {

struct Mesh;
struct Scene;

// Added to the vertices, times the target's weight. Streams are empty or as long as the positions.
struct MorphTarget {
  std::vector<vec3> positions, normals, tangents;
  std::array<std::vector<vec2>, 2> texCoords;
  std::vector<vec4> colors;  // linear
};

// Which joints the vertices follow: `perVertex` of them each.
struct Influences {
  std::uint32_t perVertex = 0;
  std::vector<std::uint16_t> joints;  // indices in Skin::joints
  std::vector<float> weights;         // of a vertex: not negative, 1 together
};

struct Skin {
  std::string name;
  std::vector<std::uint32_t> joints;  // nodes
  std::vector<mat4> jointFromMesh;    // of each joint: the inverse bind matrices
};

// A mesh that bends, and what it was bent by last.
struct Deformation {
  std::shared_ptr<const Mesh> rest;
  std::uint32_t mesh = 0;  // in Scene::meshes: the bent one
  std::uint32_t node = 0;  // whose space its vertices are in, if it has a skin
  std::uint32_t skin = ~0u;
  std::uint32_t morphNode = 0;  // whose weights the targets take
  std::vector<float> weights;
  std::vector<mat4> objectFromMesh;  // of each joint
  bool beyondReach = false;          // told of already
};

// The rest mesh bent, into the vertex streams and bounds of `bent`, a copy of it. weights: one a
// target; objectFromMesh: one a joint of the skin, or none. Linear blend skinning; normals by the
// blended matrix's inverse transpose. What would go beyond reach (scene/extent.hpp) or be no number
// stays as it rests; returns how many vertices do.
std::size_t bend(const Mesh& rest, std::span<const float> weights,
                 std::span<const mat4> objectFromMesh, Mesh& bent);

// What addDeformations() will take for bent meshes and their poses, of which each object that bends
// like no other has one; `meshes` is what the scene's indices mean.
std::uint64_t bytesOfBent(const Scene& scene, std::span<const Mesh> meshes);
// Scene::deformations of the objects that bend. For complete().
void addDeformations(Scene& scene);
// Bends what needs it. World matrices are up to date. For updateTransforms().
void updateDeformations(Scene& scene);

}  // namespace lucerna::scene
