// Single texels of maps as encoded copies have them, without encoding whole maps.
#pragma once

#include <span>
#include <vector>

#include "bake/plan.hpp"
#include "bake/seam_system.hpp"

namespace lucerna::bake {

// maps: Half RGB. Irradiance of each place, bit by bit what a reader of the encoded file finds; of
// Encoding::Png, which is for looking, what the maps have.
std::vector<vec3> encodedTexels(std::span<const Image> maps, std::span<const TexelPlace> places,
                                Encoding encoding);

}  // namespace lucerna::bake
