// Lights and cameras of a scene JSON.
#include <algorithm>

#include "core/text.hpp"
#include "scene/scene_json.hpp"
#include "scene/scene_json_parts.hpp"

namespace lucerna::scene {
namespace {

constexpr NumberRange kHalfAngle{0.f, 180.f};
constexpr NumberRange kMetres{0.f, 1e30f, "m"};

// A light whose colour is relative, as in VRML: intensity 1 gives a white surface brightness 1.
constexpr float kRelativeUnit = kPi;

// The keys that lights and lightSettings share.
void readStrength(const JsonValue& from, Light& light) {
  from.read("color", light.color, kNotNegative);
  int units = 0;
  from.readChoice("units", {"photometric", "relative"}, units);
  if (from.read("intensity", light.intensity, kNotNegative)) {
    if (units == 1) light.intensity *= kRelativeUnit;
  } else if (units == 1 && !from.has("intensity")) {
    light.intensity = kRelativeUnit;
  }
  from.read("ambientIntensity", light.ambientIntensity, kUnitRange);
  vec3 attenuation = light.attenuation;
  if (from.read("attenuation", attenuation, kNotNegative)) {
    if (attenuation == vec3(0.f))
      from.at("attenuation").wrong("at least one factor above 0");
    else
      light.attenuation = attenuation;
  }
  from.read("range", light.range, kMetres);
}

void readShape(const JsonValue& from, Light& light) {
  from.read("radius", light.radius, kMetres);
  from.readDegrees("angle", light.angle, kHalfAngle);
  from.readDegrees("outerCone", light.outerCone, {0.f, 90.f});
  from.readDegrees("innerCone", light.innerCone, {0.f, 90.f});
  if (light.innerCone > light.outerCone) {
    if (from.has("innerCone"))
      from.at("innerCone")
          .wrong(
              fmt::format("at most the outer cone, {:g} degrees", glm::degrees(light.outerCone)));
    light.innerCone = light.outerCone;
  }
  from.read("exponent", light.exponent, {0.f, 1000.f});
  from.read("group", light.group);
  from.read("on", light.on);
}

// Reads "position" and either "direction" or "target"; adds the node. False if something is wrong.
bool addPlacedNode(const JsonValue& from, const std::string& name, bool needsPosition,
                   bool needsDirection, Scene& scene, std::uint32_t& node) {
  vec3 position(0.f), target(0.f), direction(0.f, 0.f, -1.f), up(0.f, 1.f, 0.f);
  if (needsPosition && !from.has("position")) {
    from.wrong("no \"position\"", "[x, y, z] in metres");
    return false;
  }
  from.read("position", position);
  const bool hasTarget = from.read("target", target);
  const bool hasDirection = from.read("direction", direction);
  if (needsDirection && !from.has("target") && !from.has("direction")) {
    from.wrong("neither \"target\" nor \"direction\"", "one of them");
    return false;
  }
  if (hasTarget && hasDirection) {
    from.wrong("both \"target\" and \"direction\"", "one of them");
    return false;
  }
  if (hasTarget) direction = target - position;
  if (glm::length(direction) < 1e-6f) {
    from.at(hasTarget ? "target" : "direction").wrong("a direction of some length");
    return false;
  }
  direction = glm::normalize(direction);
  from.read("up", up);
  if (glm::length(glm::cross(direction, up)) < 1e-4f)
    up = std::abs(direction.y) < 0.9f ? vec3(0.f, 1.f, 0.f) : vec3(0.f, 0.f, -1.f);
  Node placed;
  placed.name = name;
  placed.translation = position;
  placed.rotation = glm::quatLookAt(direction, glm::normalize(up));
  node = addNode(scene, placed);
  return true;
}

}  // namespace

void readLights(const JsonValue& lights, Scene& scene) {
  for (const JsonValue& from : lights.elements()) {
    if (!from.object({"name", "kind", "position", "direction", "target", "color", "intensity",
                      "units", "ambientIntensity", "attenuation", "range", "radius", "angle",
                      "innerCone", "outerCone", "exponent", "group", "on"}))
      continue;
    Light light;
    light.name = fmt::format("light {}", scene.lights.size());
    from.read("name", light.name);
    int kind = -1;
    if (!from.has("kind"))
      from.wrong("no \"kind\"", "directional, point or spot");
    else
      from.readChoice("kind", {"directional", "point", "spot"}, kind);
    if (kind < 0) continue;
    light.kind = static_cast<LightKind>(kind);
    readStrength(from, light);
    readShape(from, light);
    if (addPlacedNode(from, light.name, light.kind != LightKind::Directional,
                      light.kind != LightKind::Point, scene, light.node))
      scene.lights.push_back(light);
  }
}

void readLightSettings(const JsonValue& settings, Scene& scene) {
  std::vector<std::string> names;
  for (const Light& light : scene.lights) names.push_back(light.name);
  for (const auto& [name, from] : settings.members()) {
    if (!from.object({"color", "intensity", "units", "ambientIntensity", "attenuation", "range",
                      "radius", "angle", "innerCone", "outerCone", "exponent", "group", "on"}))
      continue;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      from.fault(fmt::format("the scene has no light '{}'{}; wanted one of its {} lights", name,
                             didYouMean(name, names), names.size()));
      continue;
    }
    for (Light& light : scene.lights) {
      if (light.name != name) continue;
      readStrength(from, light);
      readShape(from, light);
    }
  }
}

bool readDepthRange(const JsonValue& from, float& near, float& far) {
  constexpr NumberRange kDepth{0.f, 1e9f, "m"};  // beyond it, floats lose the centimetres anyway
  from.read("near", near, kDepth);
  from.read("far", far, kDepth);
  if (far == 0.f || far > near) return true;
  from.at("far").wrong(fmt::format("more than near, {:g} m; or 0, to have it chosen", near));
  return false;
}

// Cameras given here stand before those of the scene's files: the first is the default.
void readCameras(const JsonValue& cameras, Scene& scene) {
  std::vector<Camera> added;
  for (const JsonValue& from : cameras.elements()) {
    if (!from.object({"name", "position", "target", "direction", "up", "fovY", "height", "aspect",
                      "near", "far"}))
      continue;
    Camera camera;
    camera.name = fmt::format("camera {}", added.size());
    from.read("name", camera.name);
    from.readDegrees("fovY", camera.fovY, {1.f, 170.f});
    camera.orthographic = from.read("height", camera.height, {1e-6f, 1e9f, "m"});
    if (camera.orthographic && from.has("fovY"))
      from.wrong("both \"fovY\" (perspective) and \"height\" (orthographic)", "one of them");
    from.read("aspect", camera.aspect, {0.01f, 100.f});
    if (!readDepthRange(from, camera.near, camera.far)) continue;
    if (addPlacedNode(from, camera.name, true, true, scene, camera.node)) added.push_back(camera);
  }
  scene.cameras.insert(scene.cameras.begin(), added.begin(), added.end());
}

}  // namespace lucerna::scene
