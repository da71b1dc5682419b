// From the loose triangles of a file to an indexed mesh with normals.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace lucerna::scene {

// Where faces meet at less than this angle the surface counts as smooth.
inline constexpr float kCreaseAngle = 0.87f;  // rad, 50 degrees

// `loose` has streams of any vertex sharing, normals or not. Triangles with a position that is not
// finite, or with an index out of range, are left out and counted in `dropped`. Vertices that agree
// in all streams become one; where there are no normals, they are made: area-weighted over the
// faces at a point that meet at less than kCreaseAngle. The order of triangles is kept.
Mesh buildMesh(Mesh loose, std::size_t& dropped);

}  // namespace lucerna::scene
