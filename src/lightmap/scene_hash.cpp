#include "lightmap/scene_hash.hpp"

#include <span>
#include <vector>

#include "core/byte_stream.hpp"
#include "core/hash.hpp"

namespace lucerna::lightmap {

std::uint64_t geometryHash(const scene::Scene& scene) {
  std::vector<std::uint64_t> meshes;
  for (const scene::Mesh& mesh : scene.meshes)
    meshes.push_back(hashBytes(std::as_bytes(std::span(mesh.indices)),
                               hashBytes(std::as_bytes(std::span(mesh.positions)))));
  std::uint64_t hash = scene.objects.size();
  for (const scene::Object& object : scene.objects) hash = hashCombine(hash, meshes[object.mesh]);
  return hash;
}

std::uint64_t placeHash(const scene::Scene& scene, std::uint32_t object) {
  const mat4& worldFromObject = scene.nodes[scene.objects[object].node].worldFromNode;
  return hashBytes(std::as_bytes(std::span(&worldFromObject, 1)));
}

std::uint64_t lightHash(const scene::PlacedLight& l) {
  ByteWriter w;
  w(static_cast<int>(l.kind));
  for (const vec3 v : {l.positionW, l.directionW, l.intensity, l.attenuation}) w(v);
  for (const float f : {l.reach, l.radius, l.angle, l.cosInner, l.cosOuter, l.exponent}) w(f);
  return hashBytes(w.bytes);
}

std::uint64_t lightHash(const scene::Scene& scene, std::uint32_t light) {
  const scene::Light& l = scene.lights[light];
  return lightHash(
      scene::place(l, l.node == scene::kNone ? mat4(1.f) : scene.nodes[l.node].worldFromNode));
}

}  // namespace lucerna::lightmap
