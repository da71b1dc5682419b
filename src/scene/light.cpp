#include "scene/light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lucerna::scene {
namespace {

constexpr float kFaintestBrightness = 1.f / 256.f;
constexpr float kNearestDistance = 0.01f;  // m; keeps 1/d^2 finite at the light itself

}  // namespace

float reach(const Light& light) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (light.kind == LightKind::Directional) return kInfinity;
  if (light.range > 0.f) return light.range;
  // c + l d + q d^2 = brightest channel / (pi * faintest), solved for d without cancellation.
  const double brightest = std::max({light.color.x, light.color.y, light.color.z}) *
                           static_cast<double>(light.intensity) / glm::pi<double>();
  const double c = light.attenuation.x - brightest / kFaintestBrightness;
  const double l = light.attenuation.y;
  const double q = light.attenuation.z;
  if (c >= 0.) return 0.f;
  if (q <= 0. && l <= 0.) return kInfinity;
  return static_cast<float>(-2. * c / (l + std::sqrt(l * l - 4. * q * c)));
}

float attenuationAt(const PlacedLight& light, float distance) {
  if (light.kind == LightKind::Directional) return 1.f;
  if (distance >= light.reach) return 0.f;
  const float d = std::max(distance, kNearestDistance);
  const vec3& a = light.attenuation;
  const float ratio = distance / light.reach;  // 0 for an infinite reach
  const float window = 1.f - ratio * ratio * ratio * ratio;
  return window * window / (a.x + a.y * d + a.z * d * d);
}

float coneFactor(const PlacedLight& light, float cosAngle) {
  if (light.kind != LightKind::Spot) return 1.f;
  if (cosAngle <= light.cosOuter) return 0.f;
  // glTF's ramp; the floor keeps a cone without a soft edge finite.
  const float ramp =
      std::min((cosAngle - light.cosOuter) / std::max(light.cosInner - light.cosOuter, 1e-3f), 1.f);
  const float power =
      light.exponent > 0.f ? std::pow(std::max(cosAngle, 0.f), light.exponent) : 1.f;
  return ramp * ramp * power;
}

PlacedLight place(const Light& light, const mat4& worldFromLight) {
  PlacedLight placed;
  placed.kind = light.kind;
  placed.positionW = vec3(worldFromLight[3]);
  const vec3 forward = -vec3(worldFromLight[2]);
  const float length = glm::length(forward);
  if (length > 0.f) placed.directionW = forward / length;
  placed.intensity = light.color * light.intensity;
  placed.ambient = placed.intensity * (light.ambientIntensity / kPi);
  placed.attenuation = light.attenuation;
  placed.reach = reach(light);
  placed.radius = light.radius;
  placed.angle = light.angle;
  if (light.kind == LightKind::Spot) {
    placed.cosOuter = std::cos(light.outerCone);
    placed.cosInner = std::cos(std::min(light.innerCone, light.outerCone));
    placed.exponent = light.exponent;
  }
  return placed;
}

}  // namespace lucerna::scene
