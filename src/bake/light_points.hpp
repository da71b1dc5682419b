// Lights that have a size as points that stand for them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/math/bounds.hpp"
#include "scene/light.hpp"
#include "trace/light_sampling.hpp"

namespace lucerna::bake {

// A point of a light.
struct LightPoint {
  scene::PlacedLight light;  // as if it had no size and stood there
  vec3 centreW{0.f};         // of the light: distances count from there
  float ahead = 0.f;         // m from the point to the light's surface, towards what is lit
};

// m from a place in the box along the unit direction until nothing of the box is ahead, and a bit
// farther: what is near the start of a ray from there is not in the way (kClearOfLight), and the
// place that far off is a float's.
float wayOut(const Aabb& boxW, vec3 placeW, vec3 directionW);

// Where a ray of the point to a sample begins. boxW: of all that may be in the way.
inline vec3 startOf(const LightPoint& point, vec3 to, const Aabb& boxW) {
  if (point.light.kind == scene::LightKind::Directional)
    return to - point.light.directionW * wayOut(boxW, to, -point.light.directionW);
  const vec3 from = point.light.positionW;
  if (point.ahead <= 0.f) return from;
  const float distance = std::max(glm::distance(to, from), 1e-6f);
  return from + (to - from) * std::min(point.ahead / distance, 0.999f);
}

bool hasSize(const scene::PlacedLight& light);
// The middle, for all of the light.
LightPoint middleOf(const scene::PlacedLight& light);

// A light as a disc: of a spot light; of a sphere, the one that faces the place; of a directional
// light, a cone of directions. The light outlives it.
class Disc {
 public:
  Disc(const scene::PlacedLight& light, vec3 placeW);
  LightPoint at(vec2 p) const;  // of the unit disc

 private:
  const scene::PlacedLight& light_;
  trace::Frame frame_;
};

vec2 onCircle(float radius, float turn);
// The i-th of n points that fill the unit disc evenly, seen along any edge too (Vogel, "A Better
// Way to Construct the Sunflower Head", 1979). shift: within 0 and 1, outwards by points, and
// turns.
vec2 spiralPoint(int i, int n, vec2 shift);
// Of each place of a texel's pattern: all points of all places fill the disc evenly too.
vec2 shiftOf(std::uint16_t place, std::uint32_t perTexel);

// From a place to a sphere: a unit vector, and m along it to the surface.
struct WayToSphere {
  vec3 wayW{0.f};
  float length = 0.f;
  float brightness = 1.f;  // of the sphere's, so that all ways together give what its middle gives
};

// To what the place sees at p of the unit disc, uniform in solid angle.
WayToSphere wayToSphere(const scene::PlacedLight& sphere, vec3 placeW, vec2 p);

// Whether a sphere is so near to the box that places in it see different sides of it: the disc that
// faces the middle of the box will not do for all of them.
bool isNearSphere(const scene::PlacedLight& light, const Aabb& boxW);

}  // namespace lucerna::bake
