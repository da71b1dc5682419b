#include "scene/deform.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "core/math/transform.hpp"
#include "core/parallel.hpp"
#include "scene/extent.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {
namespace {

constexpr std::size_t kGrain = 4096;  // vertices

// The targets that count, and the streams that any of them changes.
struct Morph {
  struct Part {
    const MorphTarget* target;
    float weight;
  };
  std::vector<Part> parts;
  bool texCoords[2] = {false, false}, colors = false;
};

// Streams that some target changes are written even if its weight is 0 now: it was another before.
Morph morphOf(const Mesh& rest, std::span<const float> weights) {
  Morph morph;
  for (std::size_t i = 0; i < rest.targets.size(); ++i) {
    const MorphTarget& target = rest.targets[i];
    for (int set = 0; set < 2; ++set) morph.texCoords[set] |= !target.texCoords[set].empty();
    morph.colors |= !target.colors.empty();
    if (weights[i] != 0.f) morph.parts.push_back({&target, weights[i]});
  }
  return morph;
}

template <typename T, typename Stream>
T morphed(T value, const Morph& morph, std::size_t vertex, Stream stream) {
  for (const auto& [target, weight] : morph.parts)
    if (const auto& deltas = stream(*target); !deltas.empty()) value += weight * deltas[vertex];
  return value;
}

u8vec4 unorm(vec4 color) {
  return u8vec4(glm::clamp(color, 0.f, 1.f) * 255.f + 0.5f);
}

template <int N>
bool finite(const glm::vec<N, float>& v) {
  for (int i = 0; i < N; ++i)
    if (!std::isfinite(v[i])) return false;
  return true;
}

void morphSurface(const Mesh& rest, const Morph& morph, std::size_t i, Mesh& bent) {
  for (std::size_t set = 0; set < 2; ++set) {
    if (!morph.texCoords[set] || rest.texCoords[set].empty()) continue;
    const vec2 uv = morphed(rest.texCoords[set][i], morph, i,
                            [&](const MorphTarget& t) -> const auto& { return t.texCoords[set]; });
    bent.texCoords[set][i] = finite(uv) ? uv : rest.texCoords[set][i];
  }
  if (!morph.colors || rest.colors.empty()) return;
  const vec4 color = morphed(vec4(rest.colors[i]) / 255.f, morph, i,
                             [](const MorphTarget& t) -> const auto& { return t.colors; });
  bent.colors[i] = finite(color) ? unorm(color) : rest.colors[i];
}

vec3 unitOr(vec3 v, vec3 fallback) {
  const float square = glm::dot(v, v);
  return square > 0.f && square < std::numeric_limits<float>::infinity() ? v / std::sqrt(square)
                                                                         : fallback;
}

mat4 blended(const Influences& influences, std::span<const mat4> joints, std::size_t vertex) {
  mat4 sum(0.f);
  const std::size_t first = vertex * influences.perVertex;
  for (std::size_t i = first; i < first + influences.perVertex; ++i)
    if (influences.weights[i] != 0.f) sum += influences.weights[i] * joints[influences.joints[i]];
  return sum;
}

// False if the vertex stays where it rests.
bool bendVertex(const Mesh& rest, const Morph& morph, std::span<const mat4> joints, std::size_t i,
                Mesh& bent) {
  vec3 position = morphed(rest.positions[i], morph, i,
                          [](const MorphTarget& t) -> const auto& { return t.positions; });
  vec3 normal(0.f);
  if (!rest.normals.empty())
    normal = morphed(rest.normals[i], morph, i,
                     [](const MorphTarget& t) -> const auto& { return t.normals; });
  vec3 tangent(0.f);
  if (!rest.tangents.empty())
    tangent = morphed(vec3(rest.tangents[i]), morph, i,
                      [](const MorphTarget& t) -> const auto& { return t.tangents; });
  if (!joints.empty()) {
    const mat4 m = blended(rest.influences, joints, i);
    position = vec3(m * vec4(position, 1.f));
    normal = normalMatrix(mat3(m)) * normal;
    tangent = mat3(m) * tangent;
  }
  const bool bends = withinReach(position);
  bent.positions[i] = bends ? position : rest.positions[i];
  if (!rest.normals.empty()) bent.normals[i] = unitOr(normal, rest.normals[i]);
  if (!rest.tangents.empty())
    bent.tangents[i] = vec4(unitOr(tangent, vec3(rest.tangents[i])), rest.tangents[i].w);
  return bends;
}

Aabb boundsOf(const Mesh& mesh) {
  const auto& elements = mesh.elements();
  std::vector<Aabb> boxes((elements.size() + kGrain - 1) / kGrain);
  parallelFor(elements.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Aabb& box = boxes[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) box.grow(mesh.positions[elements[i]]);
  });
  Aabb bounds;
  for (const Aabb& box : boxes) bounds.grow(box);
  return bounds;
}

std::vector<mat4> jointMatrices(const Scene& scene, const Deformation& deformation) {
  std::vector<mat4> matrices;
  if (deformation.skin == kNone) return matrices;
  const Skin& skin = scene.skins[deformation.skin];
  const mat4 objectFromWorld = glm::inverse(scene.nodes[deformation.node].worldFromNode);
  matrices.reserve(skin.joints.size());
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    matrices.push_back(objectFromWorld * scene.nodes[skin.joints[i]].worldFromNode *
                       skin.jointFromMesh[i]);
  return matrices;
}

std::vector<float> morphWeights(const Scene& scene, const Deformation& deformation) {
  std::vector<float> weights = scene.nodes[deformation.morphNode].weights;
  weights.resize(deformation.rest->targets.size(), 0.f);
  return weights;
}

// Objects with equal keys have the same shape. The node counts only with a skin.
using ShapeKey = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

// Nothing if the object does not bend.
std::optional<ShapeKey> shapeKey(const Object& object, const Mesh& mesh) {
  const bool skinned = object.skin != kNone && mesh.influences.perVertex > 0;
  if (!skinned && mesh.targets.empty()) return std::nullopt;
  return ShapeKey{object.mesh, skinned ? object.skin : kNone,
                  object.morphNode == kNone ? object.node : object.morphNode,
                  skinned ? object.node : kNone};
}

// The mesh without what bends it, which can be many times larger and is not copied for a moment.
Mesh atRest(Mesh& mesh) {
  auto targets = std::exchange(mesh.targets, {});
  auto influences = std::exchange(mesh.influences, {});
  Mesh copy = mesh;
  mesh.targets = std::move(targets);
  mesh.influences = std::move(influences);
  return copy;
}

std::uint64_t bytesOfStreams(const Mesh& mesh) {
  return mesh.positions.size() * sizeof(vec3) + mesh.normals.size() * sizeof(vec3) +
         mesh.tangents.size() * sizeof(vec4) + mesh.colors.size() * sizeof(u8vec4) +
         (mesh.texCoords[0].size() + mesh.texCoords[1].size()) * sizeof(vec2) +
         mesh.elements().size() * sizeof(std::uint32_t);
}

}  // namespace

std::size_t bend(const Mesh& rest, std::span<const float> weights,
                 std::span<const mat4> objectFromMesh, Mesh& bent) {
  const Morph morph = morphOf(rest, weights);
  std::atomic<std::size_t> stay = 0;
  parallelFor(rest.positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!bendVertex(rest, morph, objectFromMesh, i, bent)) ++stay;
      morphSurface(rest, morph, i, bent);
    }
  });
  if (rest.flat) makeNormals(bent);
  bent.bounds = boundsOf(bent);
  return stay;
}

std::uint64_t bytesOfBent(const Scene& scene, std::span<const Mesh> meshes) {
  std::set<ShapeKey> known;
  std::uint64_t bytes = 0;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = meshes[object.mesh];
    const auto key = shapeKey(object, mesh);
    if (!key || !known.insert(*key).second) continue;
    const std::uint32_t skin = std::get<1>(*key);
    bytes += bytesOfStreams(mesh) + mesh.targets.size() * sizeof(float);
    if (skin != kNone) bytes += scene.skins[skin].joints.size() * sizeof(mat4);
  }
  return bytes;
}

void addDeformations(Scene& scene) {
  std::vector<std::optional<ShapeKey>> keys;
  std::vector<bool> drawnAtRest(scene.meshes.size(), false);
  for (const Object& object : scene.objects) {
    keys.push_back(shapeKey(object, scene.meshes[object.mesh]));
    if (!keys.back()) drawnAtRest[object.mesh] = true;
  }
  std::map<std::uint32_t, std::shared_ptr<Mesh>> rests;
  std::map<ShapeKey, std::uint32_t> bentMeshes;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!keys[i]) continue;
    Object& object = scene.objects[i];
    const auto [known, isNew] = bentMeshes.emplace(*keys[i], object.mesh);
    if (isNew) {
      std::shared_ptr<Mesh>& rest = rests[object.mesh];
      const bool first = !rest;
      if (first) rest = std::make_shared<Mesh>(std::move(scene.meshes[object.mesh]));
      Mesh bent = atRest(*rest);
      if (first && drawnAtRest[object.mesh]) scene.meshes[object.mesh] = bent;
      // The first one takes the place of the mesh at rest, unless that is drawn too.
      if (!first || drawnAtRest[object.mesh]) {
        known->second = static_cast<std::uint32_t>(scene.meshes.size());
        scene.meshes.emplace_back();
      }
      scene.meshes[known->second] = std::move(bent);
      const auto& [mesh, skin, morphNode, node] = *keys[i];
      scene.deformations.push_back({.rest = rest,
                                    .mesh = known->second,
                                    .node = object.node,
                                    .skin = skin,
                                    .morphNode = morphNode,
                                    .weights = {},
                                    .objectFromMesh = {}});
    }
    object.mesh = known->second;
  }
}

void updateDeformations(Scene& scene) {
  for (Deformation& deformation : scene.deformations) {
    std::vector<mat4> joints = jointMatrices(scene, deformation);
    std::vector<float> weights = morphWeights(scene, deformation);
    Mesh& bent = scene.meshes[deformation.mesh];
    const bool fresh = bent.version == 0;
    if (!fresh && joints == deformation.objectFromMesh && weights == deformation.weights) continue;
    deformation.objectFromMesh = std::move(joints);
    deformation.weights = std::move(weights);
    const std::size_t stay =
        bend(*deformation.rest, deformation.weights, deformation.objectFromMesh, bent);
    ++bent.version;
    if (stay == 0 || std::exchange(deformation.beyondReach, true)) continue;
    scene.warnings.push_back(
        fmt::format("mesh '{}' is bent beyond reach: {} of its {} vertices stay where they rest",
                    bent.name, stay, bent.positions.size()));
  }
}

}  // namespace lucerna::scene
