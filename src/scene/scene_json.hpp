// The scene JSON: what scene files cannot say, and scenes put together from others. Documented in
// docs/user/scene-json.md, with a schema in docs/user/scene.schema.json.
#pragma once

#include <filesystem>

#include "core/json_value.hpp"
#include "scene/load_parts.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// Applies the JSON to `scene`, whose meshes and textures are in `load`: includes, then materials
// and light settings by name, then new lights, cameras and settings. The error lists every fault,
// one a line; or it says why reading an included scene ended, where no file is to blame.
Status addSceneJson(Scene& scene, const std::filesystem::path& path, SceneLoad& load);
// The same for the file's text. `path` stands for it in messages and says where the files lie that
// it names.
Status addSceneJson(Scene& scene, const std::filesystem::path& path, const std::string& text,
                    SceneLoad& load);

// "near" and "far" of a camera, m; 0 or absent: chosen from the scene. Reports and returns false if
// far does not lie behind near.
bool readDepthRange(const JsonValue& camera, float& near, float& far);

}  // namespace lucerna::scene
