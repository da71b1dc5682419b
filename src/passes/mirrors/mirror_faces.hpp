// The flat faces of a mesh that is a mirror: a sheet has one, a pane two, a cube six.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace lucerna::passes {

struct MirrorFace {
  vec4 planeW{0.f};  // unit normal to the front and the distance: dot(planeW, (p, 1)) is in m
  std::array<vec3, 4> cornersW{};  // of a parallelogram in the plane, around the face
  float unevenness = 0.f;          // m, from the plane to the vertex that is farthest from it
};

inline constexpr std::size_t kMostFaces = 16;

// Triangles belong to one face if they lie in one plane, to 1/10000 of the mesh's size. None if
// there are more than kMostFaces: the mesh is curved.
std::optional<std::vector<MirrorFace>> facesOf(const scene::Mesh& mesh,
                                               const mat4& worldFromObject);

}  // namespace lucerna::passes
