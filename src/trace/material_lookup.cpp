#include "trace/material_lookup.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/transform.hpp"
#include "trace/texture_reader.hpp"

namespace lucerna::trace {

using scene::Combine;
using scene::Coordinates;
using scene::Material;
using scene::MaterialModel;
using scene::TextureSlot;

// A triangle's corners in the streams of its mesh, and their weights at the spot.
struct MaterialLookup::Corners {
  const scene::Mesh& mesh;
  std::array<std::uint32_t, 3> index;
  vec3 weight;

  template <typename T>
  T mean(const std::vector<T>& stream) const {
    return stream[index[0]] * weight.x + stream[index[1]] * weight.y + stream[index[2]] * weight.z;
  }
  vec4 meanColor() const {
    const auto& colors = mesh.colors;
    return (vec4(colors[index[0]]) * weight.x + vec4(colors[index[1]]) * weight.y +
            vec4(colors[index[2]]) * weight.z) /
           255.f;
  }
};

namespace {

vec3 unitOr(vec3 v, vec3 otherwise) {
  const float length = glm::length(v);
  return length > 1e-30f ? v / length : otherwise;
}

bool hasAlpha(const scene::Texture& texture) {
  return texture.image->channels() == 2 || texture.image->channels() == 4;
}

// OpenGL 2.1, table 3.22; f the material's colour, s the texture's.
vec4 combine(const Material& material, vec4 f, vec4 s, bool alpha) {
  const vec3 cf(f), cs(s);
  switch (material.combine) {
    case Combine::Modulate:
      return f * s;
    case Combine::Decal:
      return {cf * (1.f - s.w) + cs * s.w, f.w};
    case Combine::Blend:
      return {cf * (1.f - cs) + material.blendColor * cs, f.w * s.w};
    case Combine::Add:
      return {glm::min(cf + cs, vec3(1.f)), f.w * s.w};
    case Combine::Replace:
      return {cs, alpha ? s.w : f.w};
  }
  return f;
}

}  // namespace

MaterialLookup::MaterialLookup(const scene::Scene& scene, const mat4& viewFromWorld)
    : scene_(scene), viewFromWorld_(viewFromWorld), eyeW_(glm::inverse(viewFromWorld)[3]) {
  normalMatrices_.reserve(scene.objects.size());
  for (const scene::Object& object : scene.objects)
    normalMatrices_.push_back(normalMatrix(mat3(scene.nodes[object.node].worldFromNode)));
}

const Material& MaterialLookup::materialOf(std::uint32_t object) const {
  return scene_.materials[scene_.objects[object].material];
}

MaterialLookup::Corners MaterialLookup::cornersOf(const Spot& spot) const {
  const scene::Mesh& mesh = scene_.meshes[scene_.objects[spot.object].mesh];
  const std::size_t first = 3 * static_cast<std::size_t>(spot.triangle);
  const vec2 b = spot.barycentric;
  return {.mesh = mesh,
          .index = {mesh.indices[first], mesh.indices[first + 1], mesh.indices[first + 2]},
          .weight = {1.f - b.x - b.y, b.x, b.y}};
}

bool MaterialLookup::frontFacing(const Spot& spot, vec3 directionW) const {
  const Corners c = cornersOf(spot);
  const auto& p = c.mesh.positions;
  const vec3 normal = glm::cross(p[c.index[1]] - p[c.index[0]], p[c.index[2]] - p[c.index[0]]);
  return glm::dot(normalMatrices_[spot.object] * normal, directionW) < 0.f;
}

vec2 MaterialLookup::texCoords(const TextureSlot& slot, const Spot& spot,
                               const Corners& corners) const {
  if (slot.coordinates == Coordinates::ObjectLinear) {
    const vec4 p(corners.mean(corners.mesh.positions), 1.f);
    return transformed(slot, {glm::dot(slot.planeS, p), 1.f - glm::dot(slot.planeT, p)});
  }
  if (slot.coordinates == Coordinates::EyeLinear) {
    const mat4& worldFromObject = scene_.nodes[scene_.objects[spot.object].node].worldFromNode;
    const vec4 p =
        viewFromWorld_ * (worldFromObject * vec4(corners.mean(corners.mesh.positions), 1.f));
    return transformed(slot, {glm::dot(slot.planeS, p), 1.f - glm::dot(slot.planeT, p)});
  }
  const auto& stream = corners.mesh.texCoords[static_cast<std::size_t>(slot.texCoord)];
  return transformed(slot, stream.empty() ? vec2(0.f) : corners.mean(stream));
}

// Colour of a slot that may have generated coordinates.
vec4 MaterialLookup::generated(const TextureSlot& slot, const Spot& spot, const Corners& corners,
                               vec3 normalW, vec3 toEyeW) const {
  if (!slot.used()) return vec4(1.f);
  const scene::Texture& texture = scene_.textures[slot.texture];
  if (slot.coordinates == Coordinates::Reflection || slot.coordinates == Coordinates::SphereMap) {
    const vec3 rayW = 2.f * glm::dot(normalW, toEyeW) * normalW - toEyeW;
    if (slot.coordinates == Coordinates::Reflection) return cubeColorAt(texture, rayW);
    const vec3 r = mat3(viewFromWorld_) * rayW;
    const float m = std::max(2.f * glm::length(r + vec3(0, 0, 1)), 1e-6f);
    return colorAt(texture, transformed(slot, {r.x / m + 0.5f, 0.5f - r.y / m}));
  }
  return colorAt(texture, texCoords(slot, spot, corners));
}

vec4 MaterialLookup::data(const TextureSlot& slot, const Spot& spot, const Corners& corners) const {
  return slot.used() ? dataAt(scene_.textures[slot.texture], texCoords(slot, spot, corners))
                     : vec4(1.f);
}

vec4 MaterialLookup::baseColor(const Spot& spot, const Corners& corners, vec3 normalW,
                               vec3 toEyeW) const {
  const Material& material = materialOf(spot.object);
  vec4 color = material.albedo;
  if (!corners.mesh.colors.empty()) color *= corners.meanColor();
  if (!material.albedoTexture.used()) return color;
  return combine(material, color, generated(material.albedoTexture, spot, corners, normalW, toEyeW),
                 hasAlpha(scene_.textures[material.albedoTexture.texture]));
}

// As baseColor(), without the colour: alpha tests ask for it at every surface that a ray crosses.
float MaterialLookup::opacity(const Spot& spot) const {
  const Corners corners = cornersOf(spot);
  const Material& material = materialOf(spot.object);
  const TextureSlot& slot = material.albedoTexture;
  if (slot.coordinates == Coordinates::SphereMap || slot.coordinates == Coordinates::Reflection) {
    const mat4& worldFromObject = scene_.nodes[scene_.objects[spot.object].node].worldFromNode;
    const vec3 positionW(worldFromObject * vec4(corners.mean(corners.mesh.positions), 1.f));
    const SurfacePoint point = at(spot, positionW - eyeW_);
    return baseColor(spot, corners, point.normalW, point.toEyeW).w;
  }
  float own = material.albedo.w;
  if (!corners.mesh.colors.empty()) own *= corners.meanColor().w;
  if (!slot.used() || material.combine == Combine::Decal) return own;
  const scene::Texture& texture = scene_.textures[slot.texture];
  if (!hasAlpha(texture)) return own;
  const float alpha = alphaAt(texture, texCoords(slot, spot, corners));
  return material.combine == Combine::Replace ? alpha : own * alpha;
}

// n' = t x + b y + n z, t made square to n, b = cross(n, t) times the handedness.
vec3 MaterialLookup::shadingNormal(const Spot& spot, const Corners& corners, vec3 normalW) const {
  const Material& material = materialOf(spot.object);
  if (!material.normalTexture.used() || corners.mesh.tangents.empty()) return normalW;
  const vec4 tangentO = corners.mean(corners.mesh.tangents);
  const mat3 worldFromObject(scene_.nodes[scene_.objects[spot.object].node].worldFromNode);
  const vec3 alongW = worldFromObject * vec3(tangentO);
  const vec3 squareW = alongW - normalW * glm::dot(normalW, alongW);
  if (!(glm::dot(squareW, squareW) > 1e-8f * glm::dot(alongW, alongW))) return normalW;
  const vec3 tangentW = glm::normalize(squareW);
  const float mirrored = glm::determinant(worldFromObject) < 0.f ? -1.f : 1.f;
  const vec3 bitangentW = glm::cross(normalW, tangentW) * (tangentO.w * mirrored);
  vec3 n = 2.f * vec3(data(material.normalTexture, spot, corners)) - 1.f;
  n.x *= material.normalScale;
  n.y *= material.normalScale;
  return unitOr(tangentW * n.x + bitangentW * n.y + normalW * n.z, normalW);
}

SurfacePoint MaterialLookup::at(const Spot& spot, vec3 directionW) const {
  const Corners corners = cornersOf(spot);
  const scene::Mesh& mesh = corners.mesh;
  const Material& material = materialOf(spot.object);
  const mat4& worldFromObject = scene_.nodes[scene_.objects[spot.object].node].worldFromNode;

  SurfacePoint point;
  point.material = &material;
  point.positionW = vec3(worldFromObject * vec4(corners.mean(mesh.positions), 1.f));
  point.toEyeW = -unitOr(directionW, vec3(0, 0, -1));
  const auto& p = mesh.positions;
  const vec3 acrossO = glm::cross(p[corners.index[1]] - p[corners.index[0]],
                                  p[corners.index[2]] - p[corners.index[0]]);
  const vec3 frontW = unitOr(normalMatrices_[spot.object] * acrossO, point.toEyeW);
  const float side = glm::dot(frontW, point.toEyeW) < 0.f ? -1.f : 1.f;
  point.geometricNormalW = side * frontW;

  vec3 normalW = frontW;
  if (!mesh.normals.empty()) {
    vec3 sum(0.f);  // each corner's of length 1, whatever the scale did to it
    for (std::size_t i = 0; i < 3; ++i)
      sum += unitOr(normalMatrices_[spot.object] * mesh.normals[corners.index[i]], vec3(0.f)) *
             corners.weight[static_cast<int>(i)];
    normalW = unitOr(sum, frontW);
  }
  point.normalW = side * shadingNormal(spot, corners, normalW);

  const vec4 color = baseColor(spot, corners, point.normalW, point.toEyeW);
  point.albedo = vec3(color);
  if (material.alphaMode == scene::AlphaMode::Blend) point.opacity = std::clamp(color.w, 0.f, 1.f);
  point.emissive = material.emissive * vec3(generated(material.emissiveTexture, spot, corners,
                                                      point.normalW, point.toEyeW));
  point.unlit = material.model == MaterialModel::Unlit;
  point.occlusion =
      1.f + material.occlusionStrength * (data(material.occlusionTexture, spot, corners).x - 1.f);
  const vec4 reflected =
      generated(material.specularTexture, spot, corners, point.normalW, point.toEyeW);
  point.specular = material.specular * vec3(reflected);
  point.shininess = material.shininess;
  const vec4 surface = data(material.metallicRoughnessTexture, spot, corners);
  point.metallic = material.metallic * surface.z;
  point.roughness = material.roughness * surface.y;
  if (material.model == MaterialModel::SpecularGlossiness) {
    point.roughness = 1.f - (1.f - material.roughness) * reflected.w;
    point.albedo *=
        std::max(1.f - std::max({point.specular.x, point.specular.y, point.specular.z}), 0.f);
  }
  return point;
}

vec2 transformed(const TextureSlot& slot, vec2 uv) {
  const vec2 scaled = slot.scale * uv;
  if (slot.rotation == 0.f) return slot.offset + scaled;
  const float c = std::cos(slot.rotation), s = std::sin(slot.rotation);
  return slot.offset + vec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

bool isHole(const MaterialLookup& lookup, const Spot& spot) {
  const scene::Material& material = lookup.materialOf(spot.object);
  return material.alphaMode == scene::AlphaMode::Mask &&
         lookup.opacity(spot) < material.alphaCutoff;
}

vec3 shareThrough(const MaterialLookup& lookup, const Spot& spot, vec3 toLightW) {
  const scene::Material& material = lookup.materialOf(spot.object);
  if (material.alphaMode != scene::AlphaMode::Blend) return vec3(isHole(lookup, spot) ? 1.f : 0.f);
  if (!material.doubleSided && !lookup.frontFacing(spot, -toLightW)) return vec3(1.f);
  return scene::transmittance(lookup.opacity(spot), material.transmission);
}

}  // namespace lucerna::trace
