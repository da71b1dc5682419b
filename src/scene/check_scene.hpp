// Whether a scene from an untrusted source keeps the promises of scene.hpp.
#pragma once

#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// Every index in range, streams as long as positions, parents before children, numbers finite where
// a number is needed. `textureCount`: how many textures slots may refer to. The error names the
// first fault: it is no sentence for the user on its own.
Status checkScene(const Scene& scene, std::size_t textureCount);

}  // namespace lucerna::scene
