// How loadScene() and the scene JSON call each other: a scene JSON includes scenes, and a scene
// file brings the scene JSON beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// The files being read, outermost first: one that includes itself is refused.
struct IncludeChain {
  std::vector<std::filesystem::path> open;
  int total = 0;  // scenes included so far
};

// loadScene() without complete().
Result<Scene> readScene(const std::string& pathOrName, IncludeChain& chain);

}  // namespace lucerna::scene
