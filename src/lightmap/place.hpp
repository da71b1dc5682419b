// A scene that knows its places in the lightmaps.
#pragma once

#include "lightmap/layout.hpp"

namespace lucerna::lightmap {

// Gives each object with a place in the maps a mesh of its own, with Mesh::lightmap filled;
// vertices are split where neighbours lie apart in the maps. Objects that bend keep their mesh and
// have no place. The layout must fit the scene.
void placeInMaps(scene::Scene& scene, const Layout& layout);

}  // namespace lucerna::lightmap
