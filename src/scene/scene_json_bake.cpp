// What a scene JSON says about baking.
#include "scene/scene_json_parts.hpp"

namespace lucerna::scene {

void readBake(const JsonValue& from, BakeHints& bake) {
  if (!from.object({"maps", "patches", "areaLights", "areaCut", "areaAttenuation", "areaIntensity",
                    "patchTolerance", "mapSize"}))
    return;
  from.read("maps", bake.maps);
  from.read("patches", bake.patches);
  from.read("areaLights", bake.areaLights);
  AreaLightRule area = bake.area.value_or(AreaLightRule{});
  const bool cut = from.readDegrees("areaCut", area.cut, {1e-3f, 90.f});
  const bool attenuation = from.read("areaAttenuation", area.attenuation, {1e-6f, 1e6f, "1/m^2"});
  const bool intensity = from.read("areaIntensity", area.intensity, {0.f, 1e6f, "1/m^2"});
  if (cut || attenuation || intensity) bake.area = area;
  float tolerance = 0.f;
  if (from.read("patchTolerance", tolerance, {0.f, 8.f})) bake.patchTolerance = tolerance;
  int size = 0;
  if (from.readInteger("mapSize", size, 16, 16384)) bake.mapSize = size;
}

}  // namespace lucerna::scene
