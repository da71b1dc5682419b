// One number for the shapes that a layout was made for.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace lucerna::lightmap {

// Of each object's mesh at rest: positions and triangles. Where objects stand is not in it, nor
// what they are made of.
std::uint64_t geometryHash(const scene::Scene& scene);

}  // namespace lucerna::lightmap
