// For tests: whether two scenes show the same, however they are put together.
#pragma once

#include <gmock/gmock.h>

#include <map>
#include <vector>

#include "scene/scene.hpp"

namespace lucerna::scene {

// A corner of a triangle as drawn.
struct Corner {
  vec3 positionW, normal;
  vec2 uv0, uv1;
  u8vec4 color;
  const Material* material;
};

template <typename T>
inline T at(const std::vector<T>& stream, std::uint32_t vertex, T otherwise) {
  return stream.empty() ? otherwise : stream[vertex];
}

// By node and then by object, as a file orders them.
inline std::vector<Corner> cornersOf(const Scene& scene) {
  std::vector<Corner> corners;
  std::vector<const Object*> objects;
  for (const Object& object : scene.objects) objects.push_back(&object);
  std::ranges::stable_sort(objects, {}, [](const Object* object) { return object->node; });
  for (const Object* object : objects) {
    const Mesh& mesh = scene.meshes[object->mesh];
    const mat4& world = scene.nodes[object->node].worldFromNode;
    for (const std::uint32_t v : mesh.elements())
      corners.push_back({vec3(world * vec4(mesh.positions[v], 1.f)), at(mesh.normals, v, vec3(0.f)),
                         at(mesh.texCoords[0], v, vec2(0.f)), at(mesh.texCoords[1], v, vec2(0.f)),
                         at(mesh.colors, v, u8vec4(255)), &scene.materials[object->material]});
  }
  return corners;
}

inline void expectSamePicture(const Scene& a, const TextureSlot& slotA, const Scene& b,
                              const TextureSlot& slotB) {
  ASSERT_EQ(slotA.used(), slotB.used());
  if (!slotA.used()) return;
  EXPECT_EQ(slotA.texCoord, slotB.texCoord);
  EXPECT_EQ(slotA.offset, slotB.offset);
  EXPECT_EQ(slotA.scale, slotB.scale);
  EXPECT_EQ(slotA.rotation, slotB.rotation);
  const Texture& textureA = a.textures[slotA.texture];
  const Texture& textureB = b.textures[slotB.texture];
  EXPECT_EQ(textureA.wrapS, textureB.wrapS);
  EXPECT_EQ(textureA.wrapT, textureB.wrapT);
  EXPECT_EQ(textureA.nearest, textureB.nearest);
  ASSERT_EQ(textureA.image->channels(), textureB.image->channels());
  EXPECT_TRUE(std::ranges::equal(textureA.image->bytes(), textureB.image->bytes()))
      << textureA.name;
}

inline void expectSameMaterial(const Scene& a, const Material& m, const Scene& b,
                               const Material& n) {
  SCOPED_TRACE(m.name);
  EXPECT_EQ(m.name, n.name);
  EXPECT_EQ(m.alphaMode, n.alphaMode);
  EXPECT_EQ(m.doubleSided, n.doubleSided);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(m.emissive[c], n.emissive[c]);
  expectSamePicture(a, m.albedoTexture, b, n.albedoTexture);
  expectSamePicture(a, m.emissiveTexture, b, n.emissiveTexture);
  expectSamePicture(a, m.normalTexture, b, n.normalTexture);
  expectSamePicture(a, m.occlusionTexture, b, n.occlusionTexture);
  if (m.alphaMode == AlphaMode::Mask) {
    EXPECT_EQ(m.alphaCutoff, n.alphaCutoff);
  }
  EXPECT_EQ(m.albedo, n.albedo);
  if (m.model == MaterialModel::Phong) return;
  ASSERT_EQ(m.model, n.model);
  if (m.model == MaterialModel::Unlit) return;
  EXPECT_FLOAT_EQ(m.roughness, n.roughness);
  if (m.model == MaterialModel::SpecularGlossiness) {
    EXPECT_EQ(m.specular, n.specular);
    expectSamePicture(a, m.specularTexture, b, n.specularTexture);
    return;
  }
  EXPECT_EQ(m.metallic, n.metallic);
  EXPECT_EQ(m.normalScale, n.normalScale);
  EXPECT_EQ(m.occlusionStrength, n.occlusionStrength);
  expectSamePicture(a, m.metallicRoughnessTexture, b, n.metallicRoughnessTexture);
}

inline void expectSameTriangles(const Scene& a, const Scene& b) {
  const std::vector<Corner> cornersA = cornersOf(a), cornersB = cornersOf(b);
  ASSERT_EQ(cornersA.size(), cornersB.size());
  const float size = std::max(a.boundsW().diagonal(), 1.f);
  std::map<const Material*, const Material*> materials;
  for (std::size_t i = 0; i < cornersA.size(); ++i) {
    const Corner &p = cornersA[i], &q = cornersB[i];
    const bool same = glm::distance(p.positionW, q.positionW) <= 1e-6f * size &&
                      glm::distance(p.normal, q.normal) <= 1e-5f && p.uv0 == q.uv0 &&
                      p.uv1 == q.uv1 && p.color == q.color;
    if (!same) FAIL() << "corner " << i;
    if (materials.emplace(p.material, q.material).second)
      expectSameMaterial(a, *p.material, b, *q.material);
    if (materials[p.material] != q.material) FAIL() << "material of corner " << i;
  }
}

}  // namespace lucerna::scene
