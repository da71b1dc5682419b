// The scene as the settings want it seen: what a loaded scene needs before it is drawn or traced.
#pragma once

#include "app/camera.hpp"
#include "app/settings.hpp"
#include "scene/scene.hpp"

namespace lucerna::app {

// Says the scene's warnings, chooses animation and exposure, and gives the headlight to the camera.
// Returns the camera's index: the one of settings.camera, or one that follows `path` if there is
// one. Errors (ErrorKind::Usage) name the option.
Result<std::uint32_t> prepareScene(scene::Scene& scene, const RenderSettings& settings,
                                   const CameraPath* path = nullptr);

}  // namespace lucerna::app
