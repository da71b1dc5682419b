#include "bake/light_points.hpp"

#include <cmath>
#include <limits>

#include "bake/samples.hpp"
#include "trace/low_discrepancy.hpp"

namespace lucerna::bake {
namespace {

// A unit vector around z, within the cone of whose half angle's cosine 1 lacks `most`; at p of the
// unit disc, uniform in solid angle.
vec3 inCone(vec2 p, float most) {
  const float below = std::min(glm::dot(p, p), 1.f) * most;
  const float scale = std::sqrt(most * (2.f - below));  // sine / |p|
  return {scale * p.x, scale * p.y, 1.f - below};
}

using scene::LightKind;
using scene::PlacedLight;

vec3 axisOf(const PlacedLight& light, vec3 placeW) {
  if (light.kind == LightKind::Spot) return light.directionW;
  if (light.kind == LightKind::Directional) return -light.directionW;
  const vec3 to = placeW - light.positionW;
  const float distance = glm::length(to);
  return distance > 0.f ? to / distance : vec3(0.f, 1.f, 0.f);
}

}  // namespace

bool hasSize(const PlacedLight& light) {
  return light.kind == LightKind::Directional ? light.angle > 0.f : light.radius > 0.f;
}

LightPoint middleOf(const PlacedLight& light) {
  return {.light = light,
          .centreW = light.positionW,
          .ahead = light.kind == LightKind::Point ? light.radius : 0.f};
}

float wayOut(const Aabb& boxW, vec3 placeW, vec3 directionW) {
  float way = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (const float d = directionW[axis]; d != 0.f)
      way = std::min(way, ((d > 0.f ? boxW.max : boxW.min)[axis] - placeW[axis]) / d);
  // 2^-4 of the largest coordinate, so that rounding turns the ray by no more than 2^-20.
  return 1.001f * std::max(way, 0.f) + 0x1p12f * liftAt(placeW);
}

Disc::Disc(const PlacedLight& light, vec3 placeW) : light_(light), frame_(axisOf(light, placeW)) {}

LightPoint Disc::at(vec2 p) const {
  LightPoint point{.light = light_, .centreW = light_.positionW};
  point.light.radius = point.light.angle = 0.f;
  const float squared = std::min(glm::dot(p, p), 1.f);
  if (light_.kind == LightKind::Directional) {
    // Uniform in solid angle, and as bright as trace/light_sampling.hpp.
    const float cosHalf = std::cos(0.5f * std::min(light_.angle, kPi));
    const float sinHalf = std::sin(0.5f * std::min(light_.angle, kPi));
    const float most = sinHalf * sinHalf / (1.f + cosHalf);  // 1 - cosHalf, also of small angles
    point.light.directionW = -frame_.toWorld(inCone(p, most));
    point.light.intensity *= 2.f / (1.f + cosHalf);
    return point;
  }
  point.light.positionW += light_.radius * (frame_.x * p.x + frame_.y * p.y);
  if (light_.kind == LightKind::Point) {
    point.ahead = light_.radius * std::sqrt(1.f - squared);
  } else {
    point.centreW = point.light.positionW;
  }
  return point;
}

vec2 onCircle(float radius, float turn) {
  return radius * vec2(std::cos(2.f * kPi * turn), std::sin(2.f * kPi * turn));
}

vec2 spiralPoint(int i, int n, vec2 shift) {
  constexpr float kGolden = 0.381966f;  // of a turn
  return onCircle(std::sqrt((static_cast<float>(i) + shift.x) / static_cast<float>(n)),
                  kGolden * static_cast<float>(i) + shift.y);
}

vec2 shiftOf(std::uint16_t place, std::uint32_t perTexel) {
  return perTexel == 1 ? vec2(0.5f, 0.f) : trace::lowDiscrepancyPoint(place, perTexel);
}

WayToSphere wayToSphere(const PlacedLight& sphere, vec3 placeW, vec2 p) {
  const vec3 to = sphere.positionW - placeW;
  const float distance = std::max(glm::length(to), 1e-6f);
  const float radius = std::min(sphere.radius, 0.999f * distance);
  const float ratio = radius / distance;
  const float cosHalf = std::sqrt(1.f - ratio * ratio);
  const float most = ratio * ratio / (1.f + cosHalf);  // 1 - cosHalf, also of small spheres
  const vec3 way = inCone(p, most);
  const float along = distance * way.z, miss = distance * glm::length(vec2(way));
  return {.wayW = trace::Frame(to / distance).toWorld(way),
          .length = along - std::sqrt(std::max(radius * radius - miss * miss, 0.f)),
          .brightness = 2.f / (1.f + cosHalf)};
}

bool isNearSphere(const scene::PlacedLight& light, const Aabb& boxW) {
  constexpr float kWide = 0.1f;  // radians, about, from the middle of the box to its ends
  return light.kind == scene::LightKind::Point && light.radius > 0.f &&
         0.5f * boxW.diagonal() > kWide * glm::distance(boxW.center(), light.positionW);
}

}  // namespace lucerna::bake
