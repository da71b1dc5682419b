// Maps as encoded copies of them have them.
#pragma once

#include <span>
#include <vector>

#include "bake/assemble.hpp"
#include "bake/seam_system.hpp"

namespace lucerna::bake {

// A map whose texels that no lookup meets have the mean light of the others in their block of BC6H,
// which they need not differ from then: black ones would cost the others precision.
Image withoutBlackGaps(const Image& map, const std::vector<bool>& used);

// The texels of a map that a lookup may meet: on the scene, and the filled ones beside them.
std::vector<bool> usedTexels(const MapTexels& texels, int map);

// Irradiance of each place, bit by bit what a reader of the encoded file finds; of Encoding::Png,
// which is for looking, what the maps have.
std::vector<vec3> encodedTexels(const BakedLight& baked, std::span<const TexelPlace> places,
                                Encoding encoding);

}  // namespace lucerna::bake
