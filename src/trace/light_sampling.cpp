#include "trace/light_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lucerna::trace {
namespace {

using scene::LightKind;
using scene::PlacedLight;

// A direction of the cone around +z, uniform in solid angle.
vec3 coneDirection(vec2 u, float cosHalfAngle) {
  // 1 - cos by what is left of 1, which keeps the digits of a narrow cone.
  const float below = u.x * (1.f - cosHalfAngle);
  const float sine = std::sqrt(std::max(below * (2.f - below), 0.f));
  const float phi = 2.f * kPi * u.y;
  return {sine * std::cos(phi), sine * std::sin(phi), 1.f - below};
}

// Uniform radiance over a cone of half-angle a that gives irradiance E to a surface facing its axis
// is E / (pi sin^2 a); a uniform sample stands for 2 pi (1 - cos a) of it.
float coneWeight(float cosHalfAngle) {
  return 2.f / (1.f + cosHalfAngle);
}

LightSample sampleCone(const PlacedLight& light, vec2 u) {
  const float cosHalf = std::cos(0.5f * std::min(light.angle, kPi));
  return {.toLightW = Frame(-light.directionW).toWorld(coneDirection(u, cosHalf)),
          .distance = std::numeric_limits<float>::infinity(),
          .irradiance = light.intensity * coneWeight(cosHalf)};
}

LightSample sampleSphere(const PlacedLight& light, vec3 positionW, vec2 u) {
  const vec3 toCentre = light.positionW - positionW;
  const float centre = glm::length(toCentre);
  const float radius = std::min(light.radius, 0.999f * centre);  // outside, however close
  const float ratio = radius / std::max(centre, 1e-30f);
  const float cosHalf = std::sqrt(std::max(1.f - ratio * ratio, 0.f));
  const vec3 d = coneDirection(u, cosHalf);
  // Where the direction meets the sphere.
  const float along = centre * d.z;
  const float miss = centre * centre * (1.f - d.z * d.z);
  const float inside = std::sqrt(std::max(radius * radius - miss, 0.f));
  return {.toLightW = Frame(toCentre / std::max(centre, 1e-30f)).toWorld(d),
          .distance = std::max(along - inside, 0.f),
          .irradiance = light.intensity * (attenuationAt(light, centre) * coneWeight(cosHalf))};
}

LightSample samplePoint(const PlacedLight& light, vec3 lightW, vec3 positionW) {
  const vec3 toLight = lightW - positionW;
  const float distance = glm::length(toLight);
  const vec3 direction = toLight / std::max(distance, 1e-6f);
  return {
      .toLightW = direction,
      .distance = distance,
      .irradiance = light.intensity * (attenuationAt(light, distance) *
                                       coneFactor(light, -glm::dot(direction, light.directionW)))};
}

}  // namespace

Frame::Frame(vec3 axis) : z(axis) {
  const vec3 other = std::abs(axis.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0);
  x = glm::normalize(glm::cross(other, axis));
  y = glm::cross(axis, x);
}

vec2 discPoint(vec2 u) {
  const vec2 p = 2.f * u - 1.f;
  if (p.x == 0.f && p.y == 0.f) return vec2(0.f);
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float radius = wide ? p.x : p.y;
  const float angle = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
  return radius * vec2(std::cos(angle), std::sin(angle));
}

vec3 cosineDirection(vec2 u) {
  const vec2 p = discPoint(u);
  return {p, std::sqrt(std::max(1.f - glm::dot(p, p), 0.f))};
}

LightSample sampleLight(const PlacedLight& light, vec3 positionW, vec2 u) {
  switch (light.kind) {
    case LightKind::Directional:
      if (light.angle > 0.f) return sampleCone(light, u);
      break;
    case LightKind::Point:
      if (light.radius > 0.f) return sampleSphere(light, positionW, u);
      break;
    case LightKind::Spot:
      if (light.radius > 0.f) {
        const Frame frame(light.directionW);
        const vec2 p = light.radius * discPoint(u);
        return samplePoint(light, light.positionW + frame.x * p.x + frame.y * p.y, positionW);
      }
      break;
  }
  return lightCentre(light, positionW);
}

bool mayLight(const PlacedLight& light, vec3 positionW, vec3 normalW) {
  if (light.kind == LightKind::Directional)
    return glm::dot(normalW, -light.directionW) > -std::sin(0.5f * std::min(light.angle, kPi));
  const vec3 toLight = light.positionW - positionW;
  const float squared = glm::dot(toLight, toLight), farthest = light.reach + light.radius;
  if (squared >= farthest * farthest || glm::dot(toLight, normalW) <= -light.radius) return false;
  if (light.kind != LightKind::Spot || light.cosOuter < 0.f) return true;
  // All of the disc is as far along the axis as its centre.
  const float nearest = std::max(std::sqrt(squared) - light.radius, 0.f);
  return -glm::dot(toLight, light.directionW) >= light.cosOuter * nearest;
}

LightSample lightCentre(const PlacedLight& light, vec3 positionW) {
  if (light.kind == LightKind::Directional)
    return {.toLightW = -light.directionW,
            .distance = std::numeric_limits<float>::infinity(),
            .irradiance = light.intensity};
  return samplePoint(light, light.positionW, positionW);
}

}  // namespace lucerna::trace
