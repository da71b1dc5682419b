// builtin:materials, five cubes after figure 3.7 of system A's thesis, one for each special
// material.
//
// From the left: opacity from a texture's alpha, a reflected environment, wholly translucent,
// coordinates generated in the eye's space, a shader of its own. Metres; the floor is y = 0.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

Scene makeMaterials();

}  // namespace lucerna::scene::builtin
