// One scene put into another.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::scene {

// Adds everything of `part` below a new node at `place`. The ambient light of both adds up; the
// background and exposure of `part` count only where the scene was empty.
void append(Scene& scene, Scene part, const Node& place);

}  // namespace lucerna::scene
