// Surface materials: one struct for all models; fields of other models are ignored.
#pragma once

#include <cstdint>
#include <string>

#include "core/math/math.hpp"

namespace lucerna::scene {

enum class MaterialModel {
  Phong,
  MetallicRoughness,
  Unlit,               // shows its albedo in any light, and gives and takes none
  SpecularGlossiness,  // KHR_materials_pbrSpecularGlossiness
};
enum class AlphaMode { Opaque, Mask, Blend };

inline constexpr std::uint32_t kNoTexture = ~0u;

// A texture in a material's slot. uv' = offset + rotate(rotation) * (scale * uv), as
// KHR_texture_transform says.
struct TextureSlot {
  std::uint32_t texture = kNoTexture;  // index in Scene::textures
  int texCoord = 0;                    // 0 or 1
  vec2 offset{0.f}, scale{1.f};
  float rotation = 0.f;  // rad, counter-clockwise
  bool used() const { return texture != kNoTexture; }
};

struct Material {
  std::string name;
  MaterialModel model = MaterialModel::MetallicRoughness;
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;

  // Linear; base colour of metallic-roughness, colour of unlit, else diffuse; a: opacity.
  vec4 albedo{1.f};
  TextureSlot albedoTexture;    // sRGB, times albedo
  vec3 emissive{0.f};           // linear radiance
  TextureSlot emissiveTexture;  // sRGB, times emissive
  TextureSlot normalTexture;    // tangent space
  float normalScale = 1.f;
  // What a translucent surface lets through where it does not cover, see transmittance().
  vec3 transmission{1.f};

  // Metallic-roughness
  float metallic = 1.f, roughness = 1.f;
  TextureSlot metallicRoughnessTexture;  // g: roughness, b: metallic
  TextureSlot occlusionTexture;          // r, dims ambient light only
  float occlusionStrength = 1.f;

  // Phong: reflectance of the highlight. Specular-glossiness: reflectance at normal incidence; the
  // roughness is above, and the diffuse albedo counts times 1 - the largest of these three.
  vec3 specular{0.f};           // linear
  TextureSlot specularTexture;  // sRGB, times specular; a of specular-glossiness: times glossiness,
                                // which is 1 - roughness
  float shininess = 32.f;       // Phong's exponent h, 0 to 255 in the G-buffer
};

// THE formula for light passing straight through a translucent surface of opacity `alpha`:
//   T = (1 - alpha) * transmission
// Blending computes color = shaded * alpha + T * behind; coloured shadows multiply T.
inline vec3 transmittance(float alpha, vec3 transmission) {
  return (1.f - alpha) * transmission;
}

}  // namespace lucerna::scene
