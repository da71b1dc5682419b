// Numbers for what a lightmap was made for: it is told by them when that has changed.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace lucerna::lightmap {

// Of each object's mesh at rest: positions and triangles. Where objects stand is not in it, nor
// what they are made of.
std::uint64_t geometryHash(const scene::Scene& scene);

// Of where an object stands: its world matrix, to the bit.
std::uint64_t placeHash(const scene::Scene& scene, std::uint32_t object);

// Of all that a light's irradiance depends on; its place in Scene::lights is not in it.
std::uint64_t lightHash(const scene::PlacedLight& light);

// As the light stands in the scene.
std::uint64_t lightHash(const scene::Scene& scene, std::uint32_t light);

}  // namespace lucerna::lightmap
