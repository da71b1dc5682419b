// The scene JSON: what scene files cannot say, and scenes put together from others. Documented in
// docs/user/scene-json.md, with a schema in docs/user/scene.schema.json.
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "scene/load_parts.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// Applies the JSON to `scene`: includes, then materials and light settings by name, then new
// lights, cameras and settings. The error lists every fault, one a line.
Status addSceneJson(Scene& scene, const std::filesystem::path& path, IncludeChain& chain);

}  // namespace lucerna::scene
