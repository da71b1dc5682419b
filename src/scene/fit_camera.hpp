// A camera for a scene that brings none.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::scene {

// Adds a camera that shows the scene: from outside, seen from the front, above and a little to the
// right, as near as its box allows, whole in outputs of any shape; or from inside, along the
// longest free line, if the walls face the middle of the scene. Transforms must be up to date.
void addFittingCamera(Scene& scene);

}  // namespace lucerna::scene
