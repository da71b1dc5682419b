#include "bake/plan_hash.hpp"

#include "core/byte_stream.hpp"
#include "core/hash.hpp"

namespace lucerna::bake {
namespace {

// What a change of this program does to the light that is stored raises it.
constexpr int kVersion = 6;

void add(ByteWriter& w, const scene::TextureSlot& slot) {
  w(slot.texture);
  w(slot.texCoord);
  w(slot.offset);
  w(slot.scale);
  w(slot.rotation);
  w(static_cast<int>(slot.coordinates));
  w(slot.planeS);
  w(slot.planeT);
}

// What light that meets or passes a surface depends on.
void add(ByteWriter& w, const scene::Material& m) {
  w(static_cast<int>(m.model));
  w(static_cast<int>(m.alphaMode));
  w(m.alphaCutoff);
  w(m.doubleSided);
  w(m.albedo);
  w(static_cast<int>(m.combine));
  w(m.emissive);
  w(m.transmission);
  add(w, m.albedoTexture);
  add(w, m.emissiveTexture);
}

void add(ByteWriter& w, const scene::PlacedLight& l) {
  w(l.light);  // manifests name lights by it
  w(static_cast<int>(l.kind));
  for (const vec3 v : {l.positionW, l.directionW, l.intensity, l.attenuation}) w(v);
  for (const float f : {l.reach, l.radius, l.angle, l.cosInner, l.cosOuter, l.exponent}) w(f);
}

void add(ByteWriter& w, const BakeSettings& s) {
  w(static_cast<int>(s.unwrap));
  w(s.density);
  w(s.pack.side);
  w(s.pack.gap);
  w(s.sampling.positions);
  w(s.sampling.finePositions);
  w(s.sampling.lightSamples);
  w(s.sampling.emitterSize);
  w(s.sampling.emitterShare);
  w(s.reach);
  w(s.faintest);
  w(s.sky);
  w(s.sampling.skyDirections);
  w(s.sampling.skyPoints);
  w(static_cast<int>(s.engine));
}

std::uint64_t shapeOf(const Image& image) {
  return hashCombine(static_cast<std::uint64_t>(image.width()) << 32 | image.height(),
                     static_cast<std::uint64_t>(image.type()) * 8 + image.channels());
}

template <typename T>
std::uint64_t hashOfList(const std::vector<T>& list, std::uint64_t seed) {
  return hashBytes(std::as_bytes(std::span(list)), seed);
}

}  // namespace

std::uint64_t hashOf(const Plan& plan) {
  ByteWriter w;
  w(kVersion);
  add(w, plan.settings);
  const scene::Scene& scene = *plan.world.scene;
  w(plan.emittersShine());
  w(scene.exposure);  // sets how far emitting surfaces reach
  if (scene.bake.area)
    for (const float f :
         {scene.bake.area->cut, scene.bake.area->attenuation, scene.bake.area->intensity})
      w(f);
  for (const scene::Material& material : scene.materials) add(w, material);
  for (const WorldObject& object : plan.world.objects) {
    w(object.object);
    w(scene.objects[object.object].material);
    w(scene.objects[object.object].mesh);
  }
  w.list(plan.groups, [](ByteWriter& writer, const LightGroup& group) {
    writer(group.name);
    writer.list(group.lights,
                [](ByteWriter& inner, const scene::PlacedLight& light) { add(inner, light); });
  });
  std::uint64_t hash = hashBytes(w.bytes);
  hash = hashOfList(plan.world.positions, hash);
  hash = hashOfList(plan.world.normals, hash);
  hash = hashOfList(plan.world.indices, hash);
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const auto& set : mesh.texCoords) hash = hashOfList(set, hash);
    hash = hashOfList(mesh.colors, hash);
  }
  // All six pictures of cube maps: shadow rays ask for the opacity of what reflects one. Those of a
  // background, which lights nothing (--sky does), are among them only because all are.
  for (const scene::Texture& texture : scene.textures) {
    hash = hashBytes(
        texture.image->bytes(),
        hashCombine(hashCombine(hash, shapeOf(*texture.image)),
                    static_cast<std::uint64_t>(texture.wrapS) * 8 +
                        static_cast<std::uint64_t>(texture.wrapT) * 2 + (texture.nearest ? 1 : 0)));
    for (const auto& face : texture.faces) hash = hashBytes(face->bytes(), hash);
  }
  return hash;
}

}  // namespace lucerna::bake
