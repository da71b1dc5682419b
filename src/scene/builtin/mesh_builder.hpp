// Building meshes from simple shapes: flat quads, boxes, solids of revolution, grids.
//
// All shapes have unit normals, front faces counter-clockwise, and texture coordinates in metres
// divided by the stated metres per tile. They are added under the current transform.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>

#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

// Which faces of a box are made.
enum Faces : unsigned {
  kFaceLeft = 1,
  kFaceRight = 2,
  kFaceBottom = 4,
  kFaceTop = 8,
  kFaceBack = 16,
  kFaceFront = 32,
  kSideFaces = kFaceLeft | kFaceRight | kFaceBack | kFaceFront,
  kAllFaces = 63
};

struct Lathe {
  int segments = 16;
  float creaseCosine = 0.8f;  // neighbouring profile segments steeper than this stay sharp
  int flutes = 0;             // waves around the axis
  float fluteDepth = 0.f;     // share of the radius that a wave takes away
  vec2 metresPerTile{1.f, 1.f};
};

class MeshBuilder {
 public:
  // Rigid or with uniform scale, for what is added from now on.
  void setTransform(const mat4& meshFromLocal) { meshFromLocal_ = meshFromLocal; }

  // Corners counter-clockwise seen from the front, flat.
  void quad(const std::array<vec3, 4>& corners, const std::array<vec2, 4>& texCoords);
  void triangle(const std::array<vec3, 3>& corners, const std::array<vec2, 3>& texCoords);
  // u runs from corner 0 to 1 and v from corner 0 to 3 (upwards in the picture), in metres.
  void quad(const std::array<vec3, 4>& corners, float metresPerTile = 1.f);
  void box(vec3 low, vec3 high, float metresPerTile = 1.f, unsigned faces = kAllFaces);
  // A box whose edges and corners are rounded by `radius`, each edge in 2 * segments strips;
  // texture coordinates run from 0 to 1 over each side.
  void roundedBox(vec3 low, vec3 high, float radius, int segments);
  // A solid of revolution about +y. Profile: (radius, height), with the outside to the right of
  // the way along it (for an upright solid: from bottom to top).
  void lathe(std::span<const vec2> profile, const Lathe& lathe);
  // columns x rows quads over (s, t) in [0, 1]^2; the front is where s runs right and t up.
  void grid(int columns, int rows, const std::function<vec3(float s, float t)>& position,
            vec2 tiles = vec2(1.f));
  // A ring sector of an arch about the z axis through `center`: from radius `inner` to `outer`,
  // angles from 0 (+x) to pi, between z = back and z = front; inner and outer shells and both
  // faces.
  void archRing(vec3 center, float inner, float outer, float back, float front, int segments,
                float metresPerTile = 1.f);

  std::size_t triangleCount() const { return mesh_.indices.size() / 3; }
  bool empty() const { return mesh_.indices.empty(); }
  Mesh take(std::string name);  // leaves the builder empty

 private:
  std::uint32_t vertex(vec3 position, vec3 normal, vec2 texCoord);
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  mat4 meshFromLocal_{1.f};
  Mesh mesh_;
};

}  // namespace lucerna::scene::builtin
