// Materials.
#include <algorithm>
#include <cmath>

#include "scene/gltf/writer_parts.hpp"

namespace lucerna::scene::gltf {
namespace {

float largestOf(vec3 v) {
  return std::max({v.x, v.y, v.z});
}

// Of an isotropic microfacet surface with as wide a highlight: its normals lie about n as
// (n.h)^e with e = 2/a^2 - 2, a = roughness^2 (Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces", 2007, section 5.2). Phong's angle is that of v to r, twice that of n to
// h, so near its middle e = 4 * shininess.
float roughnessOf(const Material& phong) {
  if (largestOf(phong.specular) <= 0.f) return 1.f;
  return std::pow(1.f / (2.f * phong.shininess + 1.f), 0.25f);
}

}  // namespace

int coordinateSets(const Material& material) {
  int sets = 0;
  for (const TextureSlot* slot :
       {&material.albedoTexture, &material.emissiveTexture, &material.normalTexture,
        &material.metallicRoughnessTexture, &material.occlusionTexture, &material.specularTexture})
    if (slot->used() && slot->coordinates == Coordinates::Mesh)
      sets = std::max(sets, slot->texCoord + 1);
  return sets;
}

int lightmapSet(const Material& material) {
  return std::max(coordinateSets(material), 1);
}

std::optional<Json> MaterialWriter::slot(const TextureSlot& slot, bool color) {
  if (!slot.used()) return std::nullopt;
  if (slot.coordinates != Coordinates::Mesh || out_.scene.textures[slot.texture].isCube()) {
    out_.notes.add("a texture with generated coordinates is left out");
    return std::nullopt;
  }
  Json json{{"index", textures_.texture(slot.texture, color)}};
  if (slot.texCoord != 0) json["texCoord"] = slot.texCoord;
  if (slot.offset == vec2(0.f) && slot.scale == vec2(1.f) && slot.rotation == 0.f) return json;
  Json& transform = out_.extend(json, "KHR_texture_transform");
  if (slot.offset != vec2(0.f)) transform["offset"] = jsonOf(slot.offset);
  if (slot.rotation != 0.f) transform["rotation"] = slot.rotation;
  if (slot.scale != vec2(1.f)) transform["scale"] = jsonOf(slot.scale);
  return json;
}

void MaterialWriter::writeBase(const Material& material, Json& json) {
  vec4 color = material.albedo;
  float metallic = 0.f, roughness = material.roughness;
  if (material.model == MaterialModel::MetallicRoughness) metallic = material.metallic;
  if (material.model == MaterialModel::Phong) roughness = roughnessOf(material);
  if (material.model == MaterialModel::Unlit) roughness = 1.f;
  if (material.model == MaterialModel::SpecularGlossiness)
    color = vec4(vec3(color) * (1.f - largestOf(material.specular)), color.w);
  Json& pbr = json["pbrMetallicRoughness"];
  pbr["baseColorFactor"] = jsonOf(color);
  if (auto texture = slot(material.albedoTexture, true))
    pbr["baseColorTexture"] = std::move(*texture);
  pbr["metallicFactor"] = metallic;
  pbr["roughnessFactor"] = roughness;
  if (material.model != MaterialModel::MetallicRoughness) return;
  if (auto texture = slot(material.metallicRoughnessTexture, false))
    pbr["metallicRoughnessTexture"] = std::move(*texture);
}

void MaterialWriter::writeSpecularGlossiness(const Material& material, Json& json) {
  Json& glossy = out_.extend(json, "KHR_materials_pbrSpecularGlossiness");
  glossy["diffuseFactor"] = jsonOf(material.albedo);
  if (auto texture = slot(material.albedoTexture, true))
    glossy["diffuseTexture"] = std::move(*texture);
  glossy["specularFactor"] = jsonOf(material.specular);
  glossy["glossinessFactor"] = 1.f - material.roughness;
  if (auto texture = slot(material.specularTexture, true))
    glossy["specularGlossinessTexture"] = std::move(*texture);
}

// Factors above 1 are an extension's.
void MaterialWriter::writeEmission(const Material& material, Json& json) {
  const float strength = std::max(largestOf(material.emissive), 1.f);
  if (material.emissive != vec3(0.f))
    json["emissiveFactor"] = jsonOf(glm::min(material.emissive / strength, vec3(1.f)));
  if (auto texture = slot(material.emissiveTexture, true))
    json["emissiveTexture"] = std::move(*texture);
  if (strength > 1.f)
    out_.extend(json, "KHR_materials_emissive_strength")["emissiveStrength"] = strength;
}

void MaterialWriter::noteWhatIsLost(const Material& material) {
  const auto note = [&](bool lost, const char* what) {
    if (lost) out_.notes.add(what);
  };
  note(material.model == MaterialModel::Phong && largestOf(material.specular) > 0.f,
       "a Phong material has its highlight as roughness");
  note(material.model == MaterialModel::Phong && material.specularTexture.used(),
       "a picture of Phong highlights is left out");
  note(material.albedoTexture.used() && material.combine != Combine::Modulate,
       "a texture that does not multiply its material's colour is written as if it did");
  note(material.alphaMode == AlphaMode::Blend && material.transmission != vec3(1.f),
       "the colour that a translucent material lets through is left out");
  note(material.reflectivity > 0.f, "a mirror is written without its reflection");
  note(material.shader.used(), "a material's own shader is left out");
}

Json MaterialWriter::write(const Material& material) {
  Json json = Json::object();
  if (!material.name.empty()) json["name"] = material.name;
  writeBase(material, json);
  if (material.model == MaterialModel::SpecularGlossiness) writeSpecularGlossiness(material, json);
  if (material.model == MaterialModel::Unlit) out_.extend(json, "KHR_materials_unlit");
  if (auto texture = slot(material.normalTexture, false)) {
    json["normalTexture"] = std::move(*texture);
    if (material.normalScale != 1.f) json["normalTexture"]["scale"] = material.normalScale;
  }
  if (auto texture = slot(material.occlusionTexture, false)) {
    json["occlusionTexture"] = std::move(*texture);
    if (material.occlusionStrength != 1.f)
      json["occlusionTexture"]["strength"] = material.occlusionStrength;
  }
  writeEmission(material, json);
  if (material.alphaMode == AlphaMode::Mask) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = material.alphaCutoff;
  }
  if (material.alphaMode == AlphaMode::Blend) json["alphaMode"] = "BLEND";
  if (material.doubleSided) json["doubleSided"] = true;
  return json;
}

std::size_t MaterialWriter::material(std::uint32_t index, int map) {
  const auto [known, isNew] = materials_.emplace(std::pair(index, map), 0);
  if (!isNew) return known->second;
  const Material& material = out_.scene.materials[index];
  if (noted_.insert(index).second) noteWhatIsLost(material);
  Json json = write(material);
  if (map >= 0) {
    Json& light = out_.extend(json, "MOZ_lightmap");
    light["index"] = textures_.lightmap(static_cast<std::size_t>(map));
    light["texCoord"] = lightmapSet(material);
    light["intensity"] = out_.settings.lightmaps[static_cast<std::size_t>(map)].intensity;
  }
  known->second = out_.append("materials", std::move(json));
  return known->second;
}

}  // namespace lucerna::scene::gltf
