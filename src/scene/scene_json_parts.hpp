// The sections of a scene JSON. Faults go to the JsonFaults of the value; what is wrong is left as
// it was.
#pragma once

#include <filesystem>

#include "core/json_value.hpp"
#include "scene/load_parts.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

void readMaterials(const JsonValue& materials, Scene& scene);
void readLights(const JsonValue& lights, Scene& scene);
void readLightSettings(const JsonValue& settings, Scene& scene);
void readCameras(const JsonValue& cameras, Scene& scene);
// Pictures go to the textures of `load`, which the background's indices mean.
void readBackground(const JsonValue& from, const std::filesystem::path& folder, SceneLoad& load,
                    Background& background);

}  // namespace lucerna::scene
