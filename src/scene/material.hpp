// Surface materials: one struct for all models; fields of other models are ignored.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

// Where a slot's texture coordinates come from: the mesh, or generated for each fragment as OpenGL
// 2.1 (section 2.11.4) does. Formulas: docs/dev/materials-and-light.md.
enum class Coordinates { Mesh, ObjectLinear, EyeLinear, SphereMap, Reflection };

// How the albedo texture joins the material's colour: the texture environment of OpenGL 2.1
// (section 3.8.13). Formulas: docs/dev/materials-and-light.md.
enum class Combine { Modulate, Decal, Blend, Add, Replace };

// A texture in a material's slot. uv' = offset + rotate(rotation) * (scale * uv), as
// KHR_texture_transform says.
struct TextureSlot {
  std::uint32_t texture = kNoTexture;  // index in Scene::textures; of a cube map for Reflection
  int texCoord = 0;                    // 0 or 1
  vec2 offset{0.f}, scale{1.f};
  float rotation = 0.f;  // rad, counter-clockwise
  // Of the albedo and emissive slots; the others are read at the mesh's coordinates.
  Coordinates coordinates = Coordinates::Mesh;
  vec4 planeS{1.f, 0.f, 0.f, 0.f}, planeT{0.f, 1.f, 0.f, 0.f};  // of the linear ones, in 1/m
  bool used() const { return texture != kNoTexture; }
};

// A fragment shader that draws the material instead of the shading that is built in. What it gets
// and gives is said in render/custom_shader.glsl.
struct CustomShader {
  struct Parameter {
    std::string name{};  // of a uniform float, vec2, vec3 or vec4
    int size = 1;
    vec4 value{0.f};
  };
  struct Picture {
    std::string name{};                  // of a uniform sampler2D, or samplerCube for a cube map
    std::uint32_t texture = kNoTexture;  // index in Scene::textures
    bool data = false;                   // read as stored, not as sRGB colour
  };
  std::string file{};  // absolute path, or that of one that ships; empty: none
  std::vector<Parameter> parameters{};
  std::vector<Picture> textures{};
  bool used() const { return !file.empty(); }
};

struct Material {
  std::string name;
  MaterialModel model = MaterialModel::MetallicRoughness;
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;

  // Linear; base colour of metallic-roughness, colour of unlit, else diffuse; a: opacity.
  vec4 albedo{1.f};
  TextureSlot albedoTexture;  // sRGB, times albedo unless `combine` says otherwise
  Combine combine = Combine::Modulate;
  vec3 blendColor{0.f};         // linear, of Combine::Blend
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

  // Share of a mirror's colour that is the reflected picture, 0 to 1; see isMirror().
  float reflectivity = 0.f;

  CustomShader shader;
};

// Whether it needs the shaders' TEXTURE_ENVIRONMENT variant.
inline bool usesTextureEnvironment(const Material& material) {
  const auto generated = [](const TextureSlot& slot) {
    return slot.used() && slot.coordinates != Coordinates::Mesh;
  };
  return (material.albedoTexture.used() && material.combine != Combine::Modulate) ||
         generated(material.albedoTexture) || generated(material.emissiveTexture);
}

// A planar mirror: the faces of its object's mesh are flat. Translucent surfaces are none.
inline bool isMirror(const Material& material) {
  return material.reflectivity > 0.f && material.alphaMode != AlphaMode::Blend;
}

// THE formula for light passing straight through a translucent surface of opacity `alpha`:
//   T = (1 - alpha) * transmission
// Blending computes color = shaded * alpha + T * behind; coloured shadows multiply T.
inline vec3 transmittance(float alpha, vec3 transmission) {
  return (1.f - alpha) * transmission;
}

}  // namespace lucerna::scene
