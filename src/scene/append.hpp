// One scene put into another.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::scene {

// Adds everything of `part` but its background and exposure below a new node at `place`. The
// ambient light of both adds up.
void append(Scene& scene, Scene part, const Node& place);

}  // namespace lucerna::scene
