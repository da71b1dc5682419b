#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <tuple>

#include "scene/import/assimp_parts.hpp"

namespace lucerna::scene {
namespace {

float numberOr(const aiMaterial& material, const char* key, float fallback) {
  float value = fallback;
  if (material.Get(key, 0, 0, value) != aiReturn_SUCCESS || !std::isfinite(value)) return fallback;
  return value;
}

vec3 colorOr(const aiMaterial& material, const char* key, vec3 fallback) {
  aiColor3D c;
  if (material.Get(key, 0, 0, c) != aiReturn_SUCCESS) return fallback;
  const vec3 color(c.r, c.g, c.b);
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(color[i]) || color[i] < 0.f) return fallback;
  return color;
}

Wrap wrapOf(aiTextureMapMode mode) {
  if (mode == aiTextureMapMode_Mirror) return Wrap::MirroredRepeat;
  return mode == aiTextureMapMode_Wrap ? Wrap::Repeat : Wrap::ClampToEdge;
}

bool sameImage(const ImportedTexture& a, const ImportedTexture& b) {
  return std::tie(a.path, a.alphaPath, a.wrapS, a.wrapT, a.bump) ==
         std::tie(b.path, b.alphaPath, b.wrapS, b.wrapT, b.bump);
}

bool same(const TextureSlot& a, const TextureSlot& b) {
  return a.texture == b.texture && a.texCoord == b.texCoord && a.offset == b.offset &&
         a.scale == b.scale && a.rotation == b.rotation;
}

// Of the fields that this importer sets.
bool same(const Material& a, const Material& b) {
  return std::tie(a.name, a.model, a.alphaMode, a.doubleSided, a.metallic, a.roughness,
                  a.shininess) == std::tie(b.name, b.model, b.alphaMode, b.doubleSided, b.metallic,
                                           b.roughness, b.shininess) &&
         a.albedo == b.albedo && a.emissive == b.emissive && a.transmission == b.transmission &&
         a.specular == b.specular && same(a.albedoTexture, b.albedoTexture) &&
         same(a.emissiveTexture, b.emissiveTexture) && same(a.normalTexture, b.normalTexture);
}

class MaterialConversion {
 public:
  MaterialConversion(const aiScene& source, const FileConventions& file, ImportedScene& result)
      : source_(source), file_(file), result_(result) {}

  std::uint32_t convert(const aiMaterial& source) {
    if (isStandIn(source)) return kNone;
    Material material = read(source);
    auto& materials = result_.scene.materials;
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material& other) { return same(material, other); });
    if (found != materials.end()) return static_cast<std::uint32_t>(found - materials.begin());
    materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(materials.size() - 1);
  }

 private:
  static bool isStandIn(const aiMaterial& source) {
    aiString name;
    source.Get(AI_MATKEY_NAME, name);
    return std::strcmp(name.C_Str(), AI_DEFAULT_MATERIAL_NAME) == 0 &&
           source.GetTextureCount(aiTextureType_DIFFUSE) == 0;
  }

  // A description of the first texture of a kind; false if there is none.
  bool describe(const aiMaterial& source, aiTextureType type, ImportedTexture& texture,
                TextureSlot& slot) const {
    aiString path;
    unsigned texCoord = 0;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap,
                                 aiTextureMapMode_Wrap};
    if (source.GetTexture(type, 0, &path, nullptr, &texCoord, nullptr, nullptr, modes) !=
            aiReturn_SUCCESS ||
        path.length == 0)
      return false;
    texture.path = path.C_Str();
    texture.wrapS = wrapOf(modes[0]);
    texture.wrapT = wrapOf(modes[1]);
    slot.texCoord = texCoord == 1 ? 1 : 0;
    aiUVTransform transform;
    if (aiGetMaterialUVTransform(&source, AI_MATKEY_UVTRANSFORM(type, 0), &transform) ==
        aiReturn_SUCCESS)
      place(transform, slot);
    if (const aiTexture* embedded = source_.GetEmbeddedTexture(path.C_Str()))
      texture.bytes = encodedBytes(*embedded);
    return true;
  }

  // assimp: uv' = scale * uv + offset with v upwards; ours runs downwards. Rotations are left out.
  static void place(const aiUVTransform& t, TextureSlot& slot) {
    slot.scale = {t.mScaling.x, t.mScaling.y};
    slot.offset = {t.mTranslation.x, 1.f - t.mScaling.y - t.mTranslation.y};
  }

  static Bytes encodedBytes(const aiTexture& texture) {
    if (texture.mHeight != 0) return {};  // raw texels: no file format of ours writes them
    const auto* data = reinterpret_cast<const std::byte*>(texture.pcData);
    return Bytes(data, data + texture.mWidth);
  }

  TextureSlot add(ImportedTexture texture, TextureSlot slot) {
    auto& textures = result_.textures;
    const auto found = std::find_if(textures.begin(), textures.end(),
                                    [&](const auto& other) { return sameImage(texture, other); });
    slot.texture = static_cast<std::uint32_t>(found - textures.begin());
    if (found == textures.end()) textures.push_back(std::move(texture));
    return slot;
  }

  void readAlbedo(const aiMaterial& source, Material& material) {
    ImportedTexture albedo, opacity;
    TextureSlot slot, opacitySlot;
    const bool hasOpacity = describe(source, aiTextureType_OPACITY, opacity, opacitySlot);
    const bool hasAlbedo = describe(source, aiTextureType_DIFFUSE, albedo, slot) ||
                           describe(source, aiTextureType_BASE_COLOR, albedo, slot);
    if (!hasAlbedo) return;
    if (hasOpacity) {
      albedo.alphaPath = opacity.path;
      material.alphaMode = AlphaMode::Mask;
    } else if (file_.ac3d && material.alphaMode == AlphaMode::Opaque) {
      material.alphaMode = AlphaMode::Mask;  // AC3D cuts out by the texture's own alpha, if any
    }
    material.albedoTexture = add(std::move(albedo), slot);
  }

  void readOtherTextures(const aiMaterial& source, Material& material) {
    ImportedTexture texture;
    TextureSlot slot;
    if (describe(source, aiTextureType_EMISSIVE, texture, slot)) {
      material.emissiveTexture = add(std::move(texture), slot);
      if (material.emissive == vec3(0.f)) material.emissive = vec3(1.f);
    } else if (file_.ac3d) {
      // AC3D modulates the whole shading by the texture, emission included.
      material.emissiveTexture = material.albedoTexture;
    }
    texture = {};
    slot = {};
    if (describe(source, aiTextureType_NORMALS, texture, slot) ||
        describe(source, aiTextureType_NORMAL_CAMERA, texture, slot)) {
      material.normalTexture = add(std::move(texture), slot);
    } else if (describe(source, aiTextureType_HEIGHT, texture, slot)) {
      texture.bump = true;
      material.normalTexture = add(std::move(texture), slot);
    }
  }

  Material read(const aiMaterial& source) {
    Material material;
    aiString name;
    source.Get(AI_MATKEY_NAME, name);
    material.name = name.C_Str();
    const float opacity = std::clamp(numberOr(source, "$mat.opacity", 1.f), 0.f, 1.f);
    material.albedo = vec4(colorOr(source, "$clr.diffuse", vec3(0.8f)), opacity);
    if (opacity < 1.f) material.alphaMode = AlphaMode::Blend;
    material.emissive = colorOr(source, "$clr.emissive", vec3(0.f));
    if (file_.obj) material.transmission = colorOr(source, "$clr.transparent", vec3(1.f));
    // Files that are silent about sides are made for viewers that show both; assimp is silent about
    // the sides of AC3D's surfaces.
    material.doubleSided = true;

    const float metallic = numberOr(source, "$mat.metallicFactor", -1.f);
    const float roughness = numberOr(source, "$mat.roughnessFactor", -1.f);
    if (metallic >= 0.f || roughness >= 0.f) {
      material.model = MaterialModel::MetallicRoughness;
      material.metallic = std::clamp(metallic, 0.f, 1.f);
      material.roughness = roughness >= 0.f ? std::clamp(roughness, 0.f, 1.f) : 1.f;
    } else {
      material.model = MaterialModel::Phong;
      material.specular = colorOr(source, "$clr.specular", vec3(0.f)) *
                          std::max(numberOr(source, "$mat.shinpercent", 1.f), 0.f);
      const float shininess = numberOr(source, "$mat.shininess", 0.f);
      // Without an exponent the highlight would cover everything: such files mean none.
      if (shininess <= 0.f)
        material.specular = vec3(0.f);
      else
        material.shininess = std::clamp(shininess, 1.f, 255.f);
    }
    readAlbedo(source, material);
    readOtherTextures(source, material);
    // AC3D gives all materials of a file one name: the texture tells them apart.
    if (file_.ac3d && material.albedoTexture.used()) {
      const std::string& path = result_.textures[material.albedoTexture.texture].path;
      material.name = std::filesystem::path(path).stem().string();
    }
    return material;
  }

  const aiScene& source_;
  const FileConventions& file_;
  ImportedScene& result_;
};

}  // namespace

std::vector<std::uint32_t> convertMaterials(const aiScene& source, const FileConventions& file,
                                            ImportedScene& result) {
  MaterialConversion conversion(source, file, result);
  std::vector<std::uint32_t> materials;
  for (unsigned i = 0; i < source.mNumMaterials; ++i)
    materials.push_back(conversion.convert(*source.mMaterials[i]));
  return materials;
}

}  // namespace lucerna::scene
