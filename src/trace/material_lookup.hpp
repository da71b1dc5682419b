// What a surface is like at a spot: interpolated vertices, the material and its textures. Written
// from docs/dev/materials-and-light.md and glTF, not from the shaders, which it checks.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace lucerna::trace {

// A place on a triangle of an object.
struct Spot {
  std::uint32_t object = scene::kNone, triangle = 0;
  vec2 barycentric{0.f};  // weights of the triangle's second and third corner
};

struct SurfacePoint {
  vec3 positionW{0.f};
  vec3 geometricNormalW{0.f, 1.f, 0.f};  // of the triangle, unit, towards the side that is seen
  vec3 normalW{0.f, 1.f, 0.f};           // shading normal, unit, of the same side
  vec3 toEyeW{0.f, 1.f, 0.f};            // unit, where the ray came from
  const scene::Material* material = nullptr;
  bool unlit = false;
  vec3 albedo{0.f};     // base colour, or diffuse albedo (Phong, specular-glossiness)
  float opacity = 1.f;  // of blended materials; else 1
  vec3 emissive{0.f};   // radiance
  float occlusion = 1.f;
  vec3 specular{0.f};
  float shininess = 0.f, metallic = 0.f, roughness = 1.f;
};

class MaterialLookup {
 public:
  MaterialLookup(const scene::Scene& scene, const mat4& viewFromWorld);

  const scene::Material& materialOf(std::uint32_t object) const;
  // Whether a ray of this direction meets the triangle's front.
  bool frontFacing(const Spot& spot, vec3 directionW) const;
  SurfacePoint at(const Spot& spot, vec3 directionW) const;
  // The alpha that alpha test and blending go by.
  float opacity(const Spot& spot) const;

 private:
  struct Corners;
  Corners cornersOf(const Spot& spot) const;
  vec3 shadingNormal(const Spot& spot, const Corners& corners, vec3 normalW) const;
  vec4 baseColor(const Spot& spot, const Corners& corners, vec3 normalW, vec3 toEyeW) const;
  vec4 generated(const scene::TextureSlot& slot, const Spot& spot, const Corners& corners,
                 vec3 normalW, vec3 toEyeW) const;
  vec2 texCoords(const scene::TextureSlot& slot, const Spot& spot, const Corners& corners) const;
  vec4 data(const scene::TextureSlot& slot, const Spot& spot, const Corners& corners) const;

  const scene::Scene& scene_;
  mat4 viewFromWorld_;
  vec3 eyeW_;
  std::vector<mat3> normalMatrices_;  // of each object
};

// KHR_texture_transform of the slot: offset + rotate(scale * uv), counter-clockwise with v pointing
// down.
vec2 transformed(const scene::TextureSlot& slot, vec2 uv);

// Whether an alpha test leaves nothing there.
bool isHole(const MaterialLookup& lookup, const Spot& spot);

// What goes through a surface towards the light, per colour: 0 of what is opaque there, 1 of holes
// and of one-sided translucent surfaces whose back faces the light. toLightW may have any length.
vec3 shareThrough(const MaterialLookup& lookup, const Spot& spot, vec3 toLightW);

}  // namespace lucerna::trace
