// Points on lights of the size that they state (scene/light.hpp): a point light is a sphere, a spot
// light a disc across its axis, a directional light a cone of directions.
#pragma once

#include "scene/light.hpp"

namespace lucerna::trace {

struct LightSample {
  vec3 toLightW{0.f, 1.f, 0.f};  // unit
  float distance = 0.f;          // m, to the light's surface; infinity for directional lights
  // What one sample stands for: the mean over samples, times the cosine at the surface, is the
  // irradiance of the whole light where nothing is in the way. 0: not from there.
  vec3 irradiance{0.f};
};

// u: a point of the unit square.
//
// A sphere's radiance is uniform, and such that a surface that faces its centre gets what
// scene/light.hpp says; samples are uniform in the solid angle that it fills. A disc consists of
// spot lights that share the intensity; samples are uniform on it. A cone's radiance is uniform.
LightSample sampleLight(const scene::PlacedLight& light, vec3 positionW, vec2 u);

// The light as if it had no size, from its centre.
LightSample lightCentre(const scene::PlacedLight& light, vec3 positionW);

// False only if no part of the light gives anything to the surface: out of reach, behind it, or
// outside its cone. Much cheaper than a sample.
bool mayLight(const scene::PlacedLight& light, vec3 positionW, vec3 normalW);

// A unit vector and two that are square to it and to each other.
struct Frame {
  explicit Frame(vec3 axis);
  vec3 x, y, z;  // z is the axis
  vec3 toWorld(vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

// Uniform on the unit disc (Shirley and Chiu, "A Low Distortion Map between Disk and Square",
// 1997).
vec2 discPoint(vec2 u);
// Cosine-weighted on the hemisphere around +z.
vec3 cosineDirection(vec2 u);

}  // namespace lucerna::trace
