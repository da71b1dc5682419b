// The node hierarchy and what hangs on it: objects, cameras, lights, instances.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/gltf/convert.hpp"

namespace lucerna::scene::gltf {

namespace {

constexpr float kHuge = 1e30f;

// Sets translation, rotation and scale from a matrix, or keeps the matrix where they cannot say it.
void setMatrix(Node& node, const mat4& m) {
  vec3 scale(glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2])));
  const bool affine = m[0].w == 0.f && m[1].w == 0.f && m[2].w == 0.f && m[3].w == 1.f;
  const bool regular = scale.x > 0.f && scale.y > 0.f && scale.z > 0.f;
  if (affine && regular) {
    if (glm::determinant(mat3(m)) < 0.f) scale.x = -scale.x;
    const mat3 turn(vec3(m[0]) / scale.x, vec3(m[1]) / scale.y, vec3(m[2]) / scale.z);
    constexpr float kSkew = 1e-5f;
    if (std::abs(glm::dot(turn[0], turn[1])) < kSkew &&
        std::abs(glm::dot(turn[1], turn[2])) < kSkew &&
        std::abs(glm::dot(turn[2], turn[0])) < kSkew) {
      node.translation = vec3(m[3]);
      node.rotation = glm::normalize(glm::quat_cast(turn));
      node.scale = scale;
      return;
    }
  }
  node.matrix = m;
}

void requireDepth(const Place& lens, const Camera& camera) {
  if (camera.far <= camera.near) {
    lens.at("zfar").refuse(fmt::format("a number above znear, which is {}", camera.near));
  }
}

class NodeReader {
 public:
  explicit NodeReader(Context& context)
      : context_(context),
        document_(context.document),
        nodes_(document_.root().elements("nodes")),
        cameras_(document_.root().elements("cameras")),
        skinCount_(document_.root().elements("skins").size()) {
    if (const auto lights = document_.root().extension("KHR_lights_punctual")) {
      lights_ = lights->elements("lights");
    }
  }

  void read();

 private:
  void readHierarchy();
  std::vector<std::uint32_t> roots() const;
  void visit(std::uint32_t node, std::uint32_t parent);
  void readTransform(const Place& place, Node& node);
  void addMesh(const Place& place, std::uint32_t gltfMesh, std::uint32_t node);
  void addInstances(const Place& instancing, std::uint32_t gltfMesh, std::uint32_t node);
  void addCamera(const Place& place, std::uint32_t node);
  void addLight(const Place& place, std::uint32_t node);
  Context& context_;
  Document& document_;
  std::vector<Place> nodes_, cameras_, lights_;
  std::size_t skinCount_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> parents_;
};

// Children of all nodes; each may have one parent, and going up must end.
void NodeReader::readHierarchy() {
  children_.resize(nodes_.size());
  parents_.assign(nodes_.size(), kNone);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    for (const Place& place : nodes_[i].elements("children")) {
      const std::uint32_t child = place.index(nodes_.size(), "nodes");
      if (parents_[child] != kNone) {
        place.refuse(
            fmt::format("node {}, which is a child of node {} already", child, parents_[child]),
            "each node under one parent");
      }
      parents_[child] = i;
      children_[i].push_back(child);
    }
  }
  // Every node that a root reaches is fine; the rest are the cycles and what hangs below them.
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (parents_[i] == kNone) open.push_back(i);
  }
  std::vector<bool> reached(nodes_.size(), false);
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    reached[node] = true;
    open.insert(open.end(), children_[node].begin(), children_[node].end());
  }
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (!reached[i]) {
      nodes_[i]
          .at("children")
          .refuse("a node that is its own ancestor (a cycle)", "a tree of nodes");
    }
  }
}

std::vector<std::uint32_t> NodeReader::roots() const {
  const auto scenes = document_.root().elements("scenes");
  for (const Place& scene : scenes) scene.text("name");  // checked even where it is not drawn
  const auto chosen = document_.root().index("scene", scenes.size(), "scenes");
  std::vector<std::uint32_t> result;
  if (scenes.empty()) {
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (parents_[i] == kNone) result.push_back(i);
    }
    return result;
  }
  std::vector<bool> seen(nodes_.size(), false);
  for (const Place& place : scenes[chosen == kNone ? 0 : chosen].elements("nodes")) {
    const std::uint32_t node = place.index(nodes_.size(), "nodes");
    if (seen[node]) place.refuse(fmt::format("node {} a second time", node), "each node once");
    if (parents_[node] != kNone) {  // some exporters do that
      document_.warn(place,
                     fmt::format("names node {}, a child of node {}, as a root: drawn as one", node,
                                 parents_[node]));
    }
    seen[node] = true;
    result.push_back(node);
  }
  return result;
}

void NodeReader::readTransform(const Place& place, Node& node) {
  if (const auto matrix = place.find("matrix")) {
    mat4 m(1.f);
    matrix->numbers({&m[0].x, 16});
    setMatrix(node, m);
    return;
  }
  node.translation = place.vector3("translation", vec3(0.f));
  node.scale = place.vector3("scale", vec3(1.f));
  const vec4 rotation = place.vector4("rotation", vec4(0.f, 0.f, 0.f, 1.f));
  const float length = glm::length(rotation);
  if (!(length > 1e-6f && length < kHuge)) {
    document_.warn(place, "has a rotation of length 0: not rotated");
    return;
  }
  node.rotation = glm::normalize(quat(rotation.w, rotation.x, rotation.y, rotation.z));
}

void NodeReader::addMesh(const Place& place, std::uint32_t gltfMesh, std::uint32_t node) {
  const MeshParts& mesh = context_.meshes[gltfMesh];
  auto weights = readMorphWeights(place, mesh.targets);
  if (weights.empty()) weights = mesh.weights;
  document_.spend(weights.size() * sizeof(float), place);
  context_.scene.nodes[node].weights = std::move(weights);
  const auto skin = place.index("skin", skinCount_, "skins");
  const auto instancing = place.extension("EXT_mesh_gpu_instancing");
  if (skin != kNone) {
    context_.skinnedNodes.push_back({place, node, gltfMesh, skin});
    if (instancing) document_.warn(place, "has a skin and instances: the instances are left out");
  } else if (instancing) {
    addInstances(*instancing, gltfMesh, node);
  } else {
    addObjects(context_, place, gltfMesh, node, node);
  }
}

// EXT_mesh_gpu_instancing: a child node without a name for every instance; draw lists merge them.
void NodeReader::addInstances(const Place& instancing, std::uint32_t gltfMesh, std::uint32_t node) {
  const Place attributes = instancing.at("attributes");
  std::size_t count = 0;
  const auto read = [&](const char* name, int components) -> std::vector<float> {
    const auto index = attributes.index(name, context_.accessors.size(), "accessors");
    if (index == kNone) return {};
    const Accessor& accessor = context_.accessors[index];
    if (count != 0 && accessor.count != count) {
      attributes.at(name).refuse(fmt::format("an accessor with count {}", accessor.count),
                                 fmt::format("{}, as in the other attributes", count));
    }
    if (accessor.components != components) {
      accessor.place.refuse(typeName(accessor), fmt::format("VEC{} for {}", components, name));
    }
    count = accessor.count;
    document_.spend(count * sizeof(Node), accessor.place);
    auto values = readFloats(document_, accessor, components);
    for (const float value : values) {
      if (!std::isfinite(value))
        accessor.place.refuse("a number that is not finite", "finite ones");
    }
    return values;
  };
  const auto translations = read("TRANSLATION", 3);
  const auto rotations = read("ROTATION", 4);
  const auto scales = read("SCALE", 3);
  for (std::size_t i = 0; i < count; ++i) {
    Node instance;
    instance.parent = node;
    if (!translations.empty()) instance.translation = glm::make_vec3(&translations[i * 3]);
    if (!scales.empty()) instance.scale = glm::make_vec3(&scales[i * 3]);
    if (!rotations.empty()) {
      const float* r = &rotations[i * 4];
      const quat rotation(r[3], r[0], r[1], r[2]);
      if (glm::length(rotation) > 1e-6f) instance.rotation = glm::normalize(rotation);
    }
    const std::uint32_t made = addNode(context_.scene, std::move(instance));
    addObjects(context_, instancing, gltfMesh, made, node);
  }
}

void NodeReader::addCamera(const Place& place, std::uint32_t node) {
  Camera camera;
  camera.name = place.name(context_.scene.nodes[node].name);
  camera.node = node;
  const std::string& type = place.at("type").text();
  if (type == "perspective") {
    const Place lens = place.at("perspective");
    camera.fovY = lens.at("yfov").number(1e-4f, 3.14f);
    camera.aspect = lens.number("aspectRatio", 0.f, 1e-4f, 1e4f);
    camera.near = lens.at("znear").number(1e-9f, kHuge);
    camera.far = std::numeric_limits<float>::infinity();
    if (lens.has("zfar")) camera.far = lens.at("zfar").number();
    requireDepth(lens, camera);
  } else if (type == "orthographic") {
    const Place lens = place.at("orthographic");
    const float halfWidth = lens.at("xmag").number(-kHuge, kHuge);
    const float halfHeight = lens.at("ymag").number(-kHuge, kHuge);
    if (halfWidth == 0.f || halfHeight == 0.f) lens.refuse("a magnification of 0", "another");
    camera.orthographic = true;
    camera.height = 2.f * std::abs(halfHeight);
    camera.aspect = std::abs(halfWidth / halfHeight);
    camera.near = lens.at("znear").number(0.f, kHuge);
    camera.far = lens.at("zfar").number();
    requireDepth(lens, camera);
  } else {
    place.at("type").refuse("\"perspective\" or \"orthographic\"");
  }
  context_.scene.cameras.push_back(std::move(camera));
}

void NodeReader::addLight(const Place& place, std::uint32_t node) {
  Light light;
  light.name = place.name(context_.scene.nodes[node].name);
  light.node = node;
  light.color = place.vector3("color", vec3(1.f));
  light.intensity = place.number("intensity", 1.f, 0.f, kHuge);
  light.range = place.number("range", 0.f, 0.f, kHuge);
  const std::string& type = place.at("type").text();
  if (type == "directional") {
    light.kind = LightKind::Directional;
  } else if (type == "point") {
    light.kind = LightKind::Point;
  } else if (type == "spot") {
    light.kind = LightKind::Spot;
    const Place cone = place.at("spot");
    constexpr float kHalfPi = glm::half_pi<float>();
    light.outerCone = cone.number("outerConeAngle", glm::quarter_pi<float>(), 0.f, kHalfPi);
    light.innerCone = std::min(cone.number("innerConeAngle", 0.f, 0.f, kHalfPi), light.outerCone);
  } else {
    place.at("type").refuse("\"directional\", \"point\" or \"spot\"");
  }
  context_.scene.lights.push_back(std::move(light));
}

void NodeReader::visit(std::uint32_t index, std::uint32_t parent) {
  const Place place = nodes_[index];
  Node node;
  node.name = place.name(fmt::format("node {}", index));
  node.parent = parent;
  readTransform(place, node);
  const std::uint32_t made = addNode(context_.scene, std::move(node));
  context_.sceneNodes[index] = made;

  const auto mesh = place.index("mesh", context_.meshes.size(), "meshes");
  if (mesh != kNone) addMesh(place, mesh, made);
  const auto camera = place.index("camera", cameras_.size(), "cameras");
  if (camera != kNone) addCamera(cameras_[camera], made);
  if (const auto light = place.extension("KHR_lights_punctual")) {
    addLight(
        lights_[light->at("light").index(lights_.size(), "extensions/KHR_lights_punctual/lights")],
        made);
  }
}

void NodeReader::read() {
  readHierarchy();
  context_.sceneNodes.assign(nodes_.size(), kNone);
  // Depth first in the order of the file, without recursion: hierarchies can be deep.
  struct Open {
    std::uint32_t node, parent;
  };
  std::vector<Open> open;
  const auto first = roots();
  for (auto it = first.rbegin(); it != first.rend(); ++it) open.push_back({*it, kNone});
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    if (context_.sceneNodes[next.node] != kNone) continue;  // was named as a root as well
    visit(next.node, next.parent);
    const auto& below = children_[next.node];
    for (auto it = below.rbegin(); it != below.rend(); ++it) {
      open.push_back({*it, context_.sceneNodes[next.node]});
    }
  }
}

}  // namespace

std::size_t addObjects(Context& context, const Place& place, std::uint32_t gltfMesh,
                       std::uint32_t node, std::uint32_t morphNode) {
  Scene& scene = context.scene;
  const std::size_t first = scene.objects.size();
  const std::vector<Part>& parts = context.meshes[gltfMesh].parts;
  context.document.spend(parts.size() * sizeof(Object), place);
  for (const Part& part : parts) {
    if (part.material == kNone && context.defaultMaterial == kNone) {
      context.defaultMaterial = static_cast<std::uint32_t>(scene.materials.size());
      scene.materials.emplace_back().name = "default";
    }
    Object object;
    object.node = node;
    object.mesh = part.mesh;
    object.material = part.material == kNone ? context.defaultMaterial : part.material;
    object.morphNode = morphNode;
    scene.objects.push_back(object);
  }
  return first;
}

void readNodes(Context& context) {
  NodeReader(context).read();
}

}  // namespace lucerna::scene::gltf
