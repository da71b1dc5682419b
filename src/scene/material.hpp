// Surface materials: one struct for both models; fields of the other model are ignored.
#pragma once

#include <cstdint>
#include <string>

#include "core/math/math.hpp"

namespace lucerna::scene {

enum class MaterialModel { Phong, MetallicRoughness };
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

  vec4 albedo{1.f};  // linear; diffuse of Phong, base colour of metallic-roughness; a: opacity
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

  // Phong
  vec3 specular{0.f};      // linear
  float shininess = 32.f;  // exponent h, 0 to 255 in the G-buffer
};

// THE formula for light passing straight through a translucent surface of opacity `alpha`:
//   T = (1 - alpha) * transmission
// Blending computes color = shaded * alpha + T * behind; coloured shadows multiply T.
inline vec3 transmittance(float alpha, vec3 transmission) {
  return (1.f - alpha) * transmission;
}

}  // namespace lucerna::scene
