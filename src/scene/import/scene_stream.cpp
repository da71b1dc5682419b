#include "scene/import/scene_stream.hpp"

#include "core/byte_stream.hpp"
#include "scene/check_scene.hpp"

namespace lucerna::scene {
namespace {

constexpr std::uint64_t kMagic = 0x31656e656373634cull;  // "Lcscene1"

// Each struct once, for both directions: ByteWriter and ByteReader understand the same calls.
// NOLINTBEGIN(readability-identifier-naming): named as the functions they are called like
const auto textureFields = [](auto& a, auto& t) {
  a(t.path), a(t.bytes), a(t.alphaPath), a(t.bump);
  a.choice(t.wrapS, 3), a.choice(t.wrapT, 3);
};

const auto meshFields = [](auto& a, auto& m) {
  a(m.name), a(m.positions), a(m.normals), a(m.tangents), a(m.texCoords[0]), a(m.texCoords[1]);
  a(m.colors), a(m.indices), a(m.bounds);
};

const auto materialFields = [](auto& a, auto& m) {
  const auto slot = [&](auto& s) {
    a(s.texture), a(s.texCoord), a(s.offset), a(s.scale), a(s.rotation);
  };
  a(m.name), a.choice(m.model, 4), a.choice(m.alphaMode, 3), a(m.alphaCutoff), a(m.doubleSided);
  a(m.albedo), slot(m.albedoTexture), a(m.emissive), slot(m.emissiveTexture);
  slot(m.normalTexture), a(m.normalScale), a(m.transmission);
  a(m.metallic), a(m.roughness), slot(m.metallicRoughnessTexture), slot(m.occlusionTexture);
  a(m.occlusionStrength), a(m.specular), slot(m.specularTexture), a(m.shininess);
};

const auto nodeFields = [](auto& a, auto& n) {
  a(n.name), a(n.parent), a(n.translation), a(n.rotation), a(n.scale), a(n.matrix);
};

const auto objectFields = [](auto& a, auto& o) { a(o.node), a(o.mesh), a(o.material); };

const auto lightFields = [](auto& a, auto& l) {
  a(l.name), a.choice(l.kind, 3), a(l.color), a(l.intensity), a(l.ambientIntensity);
  a(l.attenuation), a(l.range), a(l.radius), a(l.angle), a(l.innerCone), a(l.outerCone);
  a(l.exponent), a(l.group), a(l.on), a(l.node);
};

const auto cameraFields = [](auto& a, auto& c) {
  a(c.name), a(c.orthographic), a(c.fovY), a(c.height), a(c.aspect), a(c.near), a(c.far);
  a(c.node);
};

const auto animationFields = [](auto& a, auto& animation) {
  a(animation.name);
  a.list(animation.channels, [](auto& b, auto& c) {
    b(c.node), b.choice(c.path, 3), b.choice(c.interpolation, 3), b(c.times), b(c.values);
  });
};

const auto bakeFields = [](auto& a, auto& b) {
  a(b.maps), a(b.patches), a(b.areaLights), a(b.area), a(b.patchTolerance), a(b.mapSize);
};

const auto textFields = [](auto& a, auto& text) { a(text); };

const auto fields = [](auto& a, auto& imported) {
  a.list(imported.textures, textureFields);
  auto& scene = imported.scene;
  a.list(scene.meshes, meshFields);
  a.list(scene.materials, materialFields);
  a.list(scene.nodes, nodeFields);
  a.list(scene.objects, objectFields);
  a.list(scene.lights, lightFields);
  a.list(scene.cameras, cameraFields);
  a.list(scene.animations, animationFields);
  a.list(scene.warnings, textFields);
  a(scene.ambient);
  bakeFields(a, scene.bake);
};
// NOLINTEND(readability-identifier-naming)

}  // namespace

Bytes writeStream(const ImportedScene& imported) {
  ByteWriter writer;
  std::size_t size = 1 << 16;
  for (const Mesh& mesh : imported.scene.meshes)
    size += 48 * mesh.positions.size() + 4 * mesh.indices.size() + 256;
  writer.bytes.reserve(size);
  writer(kMagic);
  fields(writer, imported);
  return std::move(writer.bytes);
}

Result<ImportedScene> readStream(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  std::uint64_t magic = 0;
  reader(magic);
  if (magic != kMagic) return error(ErrorKind::Input, "does not start as it should");
  ImportedScene imported;
  fields(reader, imported);
  if (!reader.good()) return error(ErrorKind::Input, "ends early or holds impossible counts");
  if (!reader.atEnd()) return error(ErrorKind::Input, "has bytes left over");
  LUCERNA_TRY_VOID(checkScene(imported.scene, imported.textures.size()));
  return imported;
}

}  // namespace lucerna::scene
