// The one way in: a path or a built-in scene's name becomes a Scene.
#pragma once

#include <string>

#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// "builtin:NAME?key=value&..." or a file: .gltf .glb, .obj .ac .acc .dae .fbx .ply .3ds (those
// through assimp in a child process), or .json (a scene JSON that includes others). If
// NAME.lucerna.json stands beside the file, what it says is added. complete() has been called.
// Errors (ErrorKind::Input) name the file, what was found, what was wanted and the next step.
Result<Scene> loadScene(const std::string& pathOrName);

}  // namespace lucerna::scene
