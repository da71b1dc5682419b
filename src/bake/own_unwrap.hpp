// A mesh's own second set of texture coordinates (TEXCOORD_1 of glTF), where it can serve as a
// lightmap's.
#pragma once

#include <string>
#include <variant>

#include "bake/charts.hpp"

namespace lucerna::bake {

// One chart with all of the object's triangles, in texels; or why not. Nothing is said of meshes
// without such a set: the reason is empty. gap: texels that there must be between its parts.
std::variant<Chart, std::string> ownUnwrap(const World& world, std::uint32_t object,
                                           const ChartSettings& settings);

}  // namespace lucerna::bake
