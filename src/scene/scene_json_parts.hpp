// The sections of a scene JSON. Faults go to the JsonFaults of the value; what is wrong is left as
// it was.
#pragma once

#include <filesystem>

#include "scene/json_reader.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

void readMaterials(const JsonValue& materials, Scene& scene);
void readLights(const JsonValue& lights, Scene& scene);
void readLightSettings(const JsonValue& settings, Scene& scene);
void readCameras(const JsonValue& cameras, Scene& scene);
void readBackground(const JsonValue& background, const std::filesystem::path& folder, Scene& scene);

}  // namespace lucerna::scene
