// Lights, and the numbers that everyone derives from them in one place: shading, culling, tiles,
// shadow faces, the reference and the baker.
#pragma once

#include <string>

#include "core/math/math.hpp"

namespace lucerna::scene {

inline constexpr std::uint32_t kNone = ~0u;

enum class LightKind { Directional, Point, Spot };

// Placed by its node: at the node's origin, shining along -z of the node.
//
// Irradiance E at a surface (per colour channel, W/m^2-like photometric units of glTF):
//   point, spot:  E = color * intensity * attenuation(d) * cone * max(n.l, 0)
//   directional:  E = color * intensity * max(n.l, 0)
// A Lambert surface then sends out albedo * E / pi. A light of system A (VRML: intensity 1 gives a
// white surface brightness 1) has intensity pi here.
struct Light {
  std::string name;
  LightKind kind = LightKind::Point;
  vec3 color{1.f};               // linear
  float intensity = 1.f;         // cd (point, spot) or lux (directional)
  float ambientIntensity = 0.f;  // VRML: this share of color*intensity/pi adds to the ambient light
  vec3 attenuation{0.f, 0.f, 1.f};  // constant, linear (1/m), quadratic (1/m^2); glTF is (0, 0, 1)
  float range = 0.f;                // m; 0: derived, see reach()
  float radius = 0.f;               // m; sphere (point) or disc across the axis (spot)
  float angle = 0.f;            // rad; full angle of a directional light's cone (the sun 0.0093)
  float innerCone = 0.f;        // rad, half-angle of full strength (spot)
  float outerCone = 0.785398f;  // rad, half-angle where it ends (spot)
  float exponent = 0.f;         // of cos(angle to the axis) inside the cone (spot); 0: none
  std::string group;            // lights of a group switch together; "" is always on
  bool on = true;
  std::uint32_t node = kNone;
};

// A light where it stands, ready for shading.
struct PlacedLight {
  LightKind kind = LightKind::Point;
  vec3 positionW{0.f};
  vec3 directionW{0.f, 0.f, -1.f};  // unit, from the light into the scene
  vec3 intensity{0.f};              // color * intensity
  vec3 ambient{0.f};                // color * ambientIntensity * intensity / pi
  vec3 attenuation{0.f, 0.f, 1.f};
  float reach = 0.f;  // m; infinity for directional lights
  float radius = 0.f, angle = 0.f;
  float cosInner = 1.f, cosOuter = -1.f, exponent = 0.f;
  std::uint32_t light = kNone;  // index in Scene::lights
};

// The distance beyond which the light gives nothing: `range` if stated; else where a white surface
// facing it would have brightness color*intensity/pi * 1/(c + l d + q d^2) = 1/256, which is where
// the attenuation itself falls to 1/256 for a light of system A's intensity 1. Infinite for
// directional lights and for attenuation that never falls that far.
float reach(const Light& light);

// 1 / (c + l d + q d^2), with d held at 1 cm or more, times the window (1 - (d/reach)^4)^2 that
// fades to zero at the reach. GLSL: render/lights.glsl.
float attenuationAt(const PlacedLight& light, float distance);

// Strength of a spot light at an angle of the given cosine to its axis: 0 outside the outer cone,
// glTF's squared ramp between outer and inner, times cos^exponent. 1 for other kinds.
float coneFactor(const PlacedLight& light, float cosAngle);

PlacedLight place(const Light& light, const mat4& worldFromLight);

}  // namespace lucerna::scene
