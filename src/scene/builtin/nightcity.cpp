// The order in which the night city is put together, its cameras and its sun.
#include "scene/builtin/nightcity.hpp"

#include <cmath>

#include "scene/builtin/assembly.hpp"

namespace lucerna::scene::builtin {
namespace {

using namespace city;

// Lamps have intensity pi, as in system A; this brings a lit street to a pleasant brightness.
constexpr float kExposure = 3.9f;

void addSun(Scene& scene, vec2 degrees) {
  const float elevation = glm::radians(degrees.x), azimuth = glm::radians(degrees.y);
  const vec3 towardsSun(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                        -std::cos(elevation) * std::cos(azimuth));
  Node node;
  node.name = "sun";
  node.rotation = lookAlong(-towardsSun);
  Light sun;
  sun.name = "sun";
  sun.kind = LightKind::Directional;
  sun.color = glm::mix(vec3(1, 0.6f, 0.3f), vec3(1, 0.95f, 0.86f), std::sin(elevation));
  // At this exposure a white surface facing it is just below white.
  sun.intensity = kPi * 1.1f * std::exp2(-kExposure);
  sun.angle = 0.0093f;
  sun.node = addNode(scene, std::move(node));
  scene.lights.push_back(std::move(sun));
}

void addCameras(City& city) {
  const auto camera = [&](const char* name, vec3 position, vec3 target, float fovY) {
    addCamera(city.scene, city.root, name, position, target, fovY);
    city.scene.cameras.back().near = 0.2f;
    city.scene.cameras.back().far = std::numeric_limits<float>::infinity();
  };
  camera("street", {4.2f, 1.7f, -184.f}, {-1.2f, 6.6f, -246.f}, 60);
  camera("highway", {-70.f, kHighwayTop + 2.2f, kHighwayZ + 4.f},
         {60.f, kHighwayTop + 3.f, kHighwayZ - 3.f}, 55);
  camera("tunnel", {-3.6f, 1.8f, kTunnelFrom + 45}, {0.6f, 4.6f, kTunnelFrom - 60}, 45);
  camera("aerial", {75.f, 140.f, 70.f}, {-15.f, 62.f, -230.f}, 55);
}

}  // namespace

Scene makeNightCity(const NightCityOptions& options) {
  Scene scene;
  scene.name = "builtin:nightcity";
  Node root;
  root.name = "city";
  root.rotation = glm::angleAxis(glm::radians(options.rotate), vec3(0, 1, 0));
  const std::uint32_t rootIndex = addNode(scene, std::move(root));
  const int half = static_cast<int>(options.blocks / 2);
  City city{scene, options, addMaterials(scene),
            Extent{-half, static_cast<int>(options.blocks) - half}, rootIndex};
  addBlocks(city);
  addRoads(city);
  addHighway(city);
  addTunnel(city);
  addLamps(city);
  addCars(city);
  addSigns(city);
  addTextures(scene, city.materials, options.seed);
  lightWindows(scene, city.materials, options.seed);
  addCameras(city);

  scene.exposure = kExposure;
  scene.ambient = vec3(0.0052f, 0.0056f, 0.0082f);
  addSky(scene, options.sun.has_value(), options.seed);
  scene.background.intensity = std::exp2(-kExposure);
  if (options.sun) {
    addSun(scene, *options.sun);
    scene.ambient *= 8.f;
  }
  return scene;
}

}  // namespace lucerna::scene::builtin
