#include "render/light_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "render/blocks.hpp"

namespace lucerna::render {
namespace {

constexpr float kNoCone = -2.f;         // no cosine is below it
constexpr float kSharpestRamp = 1e-3f;  // as scene::coneFactor() has it

blocks::LightValues lightValues(const scene::PlacedLight& light) {
  const bool directional = light.kind == scene::LightKind::Directional;
  const bool spot = light.kind == scene::LightKind::Spot;
  // No reach at all: a tiny one, which gives nothing beyond a nanometre.
  const float inverseReach =
      directional || std::isinf(light.reach) ? 0.f : 1.f / std::max(light.reach, 1e-9f);
  blocks::LightValues values{};
  values.position = directional ? vec4(-light.directionW, 0.f) : vec4(light.positionW, 1.f);
  values.axis = vec4(light.directionW, spot ? light.exponent : 0.f);
  values.intensity = vec4(light.intensity, inverseReach);
  values.attenuation =
      vec4(directional ? vec3(1.f, 0.f, 0.f) : light.attenuation, spot ? light.cosOuter : kNoCone);
  const float ramp = std::max(light.cosInner - light.cosOuter, kSharpestRamp);
  values.shape = vec4(spot ? 1.f / ramp : 1.f, light.radius, light.angle, 0.f);
  return values;
}

}  // namespace

void updateLights(gpu::Device& device, LightList& list, const scene::Scene& scene) {
  list.lights = scene::placeLights(scene);
  list.ambient = scene.ambient;
  for (const scene::PlacedLight& light : list.lights) list.ambient += light.ambient;

  const blocks::LightHeader header{vec4(list.ambient, 0.f),
                                   uvec4(static_cast<std::uint32_t>(list.lights.size()), 0, 0, 0)};
  std::vector<blocks::LightValues> values;
  for (const scene::PlacedLight& light : list.lights) values.push_back(lightValues(light));
  values.resize(std::max<std::size_t>(values.size(), 1));  // a block of no elements cannot be bound

  std::vector<std::byte> bytes(sizeof header + values.size() * sizeof(blocks::LightValues));
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, values.data(), bytes.size() - sizeof header);
  device.write(list.block, bytes, "LightBlock");
}

}  // namespace lucerna::render
