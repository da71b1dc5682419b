// Skins, and the objects that follow them.
#include <algorithm>
#include <cmath>
#include <map>

#include "scene/gltf/convert.hpp"

namespace lucerna::scene::gltf {

namespace {

class SkinReader {
 public:
  explicit SkinReader(Context& context)
      : context_(context),
        document_(context.document),
        places_(document_.root().elements("skins")),
        made_(places_.size(), kNone) {}

  void attach(const SkinnedNode& skinned);

 private:
  std::uint32_t skinOf(std::uint32_t gltfSkin);
  std::vector<mat4> inverseBindMatrices(const Place& place, std::size_t joints);
  void requireJoints(const Place& skin, std::uint32_t mesh, std::size_t joints);

  Context& context_;
  Document& document_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> made_;                 // by glTF skin: Scene::skins, or kNone
  std::map<std::uint32_t, std::uint16_t> highest_;  // by mesh of the scene: the joint it follows
};

std::vector<mat4> SkinReader::inverseBindMatrices(const Place& place, std::size_t joints) {
  std::vector<mat4> matrices(joints, mat4(1.f));
  const auto index = place.index("inverseBindMatrices", context_.accessors.size(), "accessors");
  if (index == kNone) return matrices;
  const Accessor& accessor = context_.accessors[index];
  if (accessor.components != 16 || accessor.type != ComponentType::F32 || accessor.count < joints) {
    accessor.place.refuse(fmt::format("{} {}", accessor.count, typeName(accessor)),
                          fmt::format("MAT4 of floats, one for each of the {} joints", joints));
  }
  const auto values = readFloats(document_, accessor, 16);
  for (std::size_t i = 0; i < joints * 16; ++i) {
    if (!std::isfinite(values[i])) {
      accessor.place.refuse("a matrix that is infinite or not a number", "finite matrices");
    }
  }
  for (std::size_t i = 0; i < joints; ++i) matrices[i] = glm::make_mat4(&values[i * 16]);
  return matrices;
}

// kNone, with a warning, if a joint is outside the scene that is drawn.
std::uint32_t SkinReader::skinOf(std::uint32_t gltfSkin) {
  if (made_[gltfSkin] != kNone) return made_[gltfSkin];
  const Place place = places_[gltfSkin];
  Skin skin;
  skin.name = place.name(fmt::format("skin {}", gltfSkin));
  const auto joints = place.at("joints").elements();
  if (joints.empty()) place.at("joints").refuse("no joints", "one at least");
  for (const Place& joint : joints) {
    const auto node = joint.index(context_.sceneNodes.size(), "nodes");
    if (context_.sceneNodes[node] == kNone) {
      document_.warn(joint, "is a node outside the scene: what has this skin stands at rest");
      return kNone;
    }
    skin.joints.push_back(context_.sceneNodes[node]);
  }
  skin.jointFromMesh = inverseBindMatrices(place, joints.size());
  made_[gltfSkin] = static_cast<std::uint32_t>(context_.scene.skins.size());
  context_.scene.skins.push_back(std::move(skin));
  return made_[gltfSkin];
}

void SkinReader::requireJoints(const Place& skin, std::uint32_t mesh, std::size_t joints) {
  const auto [known, isNew] = highest_.emplace(mesh, 0);
  const auto& used = context_.scene.meshes[mesh].influences.joints;
  if (isNew) known->second = *std::max_element(used.begin(), used.end());
  if (known->second >= joints) {
    skin.at("joints").refuse(fmt::format("{} joints, but mesh \"{}\" follows joint {}", joints,
                                         context_.scene.meshes[mesh].name, known->second),
                             "a joint for every number in JOINTS_0");
  }
}

// A skinned mesh is where its joints are: the transform of its own node does not count (glTF 2.0,
// 3.7.3.3). So its objects hang at a node of their own that stands still.
void SkinReader::attach(const SkinnedNode& skinned) {
  Scene& scene = context_.scene;
  const std::uint32_t skin = skinOf(skinned.skin);
  if (skin == kNone) {
    addObjects(context_, skinned.place, skinned.mesh, skinned.node, skinned.node);
    return;
  }
  Node still;
  still.name = scene.nodes[skinned.node].name;
  const std::uint32_t node = addNode(scene, std::move(still));
  const std::size_t first = addObjects(context_, skinned.place, skinned.mesh, node, skinned.node);
  for (std::size_t i = first; i < scene.objects.size(); ++i) {
    Object& object = scene.objects[i];
    const Mesh& mesh = scene.meshes[object.mesh];
    if (mesh.influences.perVertex == 0) {
      document_.warn(skinned.place, "has a skin, but mesh \"" + mesh.name +
                                        "\" has no JOINTS_0: drawn without the skin");
      object.node = skinned.node;
      continue;
    }
    requireJoints(places_[skinned.skin], object.mesh, scene.skins[skin].joints.size());
    object.skin = skin;
  }
}

}  // namespace

void readSkins(Context& context) {
  SkinReader reader(context);
  for (const SkinnedNode& skinned : context.skinnedNodes) reader.attach(skinned);
}

}  // namespace lucerna::scene::gltf
