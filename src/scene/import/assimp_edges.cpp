// Edges of an OBJ as lights: system B's thesis, appendix C.1.
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

#include "scene/import/assimp_parts.hpp"

namespace lucerna::scene {
namespace {

constexpr float kFarthest = 300.f;  // m, "Dosah světel je omezen na 300 metrů" (thesis 5.1.1)
constexpr std::size_t kMostWarnings = 100;

struct Edge {
  vec3 first, second;
};

// An object with edges; what it has besides is its surface.
struct EdgeObject {
  std::string name;
  std::vector<Edge> edges;
};

// In the order of the file.
void gatherEdges(const aiScene& source, const aiNode& node, std::vector<EdgeObject>& objects) {
  EdgeObject object;
  object.name = node.mName.C_Str();
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *source.mMeshes[node.mMeshes[i]];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 2) continue;
      const aiVector3D &a = mesh.mVertices[face.mIndices[0]], &b = mesh.mVertices[face.mIndices[1]];
      object.edges.push_back({{a.x, a.y, a.z}, {b.x, b.y, b.z}});
    }
  }
  if (!object.edges.empty()) objects.push_back(std::move(object));
  for (unsigned i = 0; i < node.mNumChildren; ++i)  // OBJ: below the root, nothing deeper
    gatherEdges(source, *node.mChildren[i], objects);
}

bool finite(vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// All lights of a group but for where they stand.
Light lightOf(const LightGroupIni& group, const std::string& name) {
  Light light;
  light.name = name;
  if (group.blink) light.group = name;
  setRelativeStrength(group.color, light);
  light.attenuation = group.attenuation;
  if (group.cut >= 0.f) {
    light.kind = LightKind::Spot;
    light.outerCone = light.innerCone = glm::radians(group.cut);
    light.exponent = group.spot;
  }
  if (reach(light) > kFarthest) light.range = kFarthest;
  return light;
}

class EdgeLights {
 public:
  EdgeLights(const NodesByName& nodes, const LightsIni& ini, Scene& scene)
      : nodes_(nodes), ini_(ini), scene_(scene), warnings_(ini.warnings) {}

  void run(const std::vector<EdgeObject>& objects) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const auto group = ini_.groups.find(static_cast<std::uint32_t>(i));
      if (group != ini_.groups.end())
        add(objects[i], i, group->second);
      else
        warn("{}: no section LIGHT{} for object '{}' and its {} edges, which light nothing; add it",
             ini_.file, i, objects[i].name, objects[i].edges.size());
    }
    if (objects.empty() && !ini_.groups.empty())
      warn(
          "{}:{}: describes lights, but no object of the scene has edges ('l' records); export it "
          "with its edges",
          ini_.file, ini_.groups.begin()->second.line);
    else
      for (auto it = ini_.groups.lower_bound(static_cast<std::uint32_t>(objects.size()));
           it != ini_.groups.end(); ++it)
        warn(
            "{}:{}: LIGHT{} is of no object: {} have edges ('l' records), counted from 0; it is "
            "passed over",
            ini_.file, it->second.line, it->first, objects.size());
    tellWarnings();
  }

 private:
  template <typename... Args>
  void warn(fmt::format_string<Args...> format, Args&&... args) {
    warnings_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void add(const EdgeObject& object, std::size_t number, const LightGroupIni& group) {
    const std::string name = object.name.empty() ? fmt::format("LIGHT{}", number) : object.name;
    Light light = lightOf(group, name);
    std::size_t left = 0;
    for (const Edge& edge : object.edges) {
      const vec3 direction = edge.second - edge.first;
      const bool good = finite(edge.first) && finite(direction) &&
                        (light.kind == LightKind::Point || glm::length(direction) >= 1e-6f);
      if (!good) {
        ++left;
        continue;
      }
      light.node = addLookingNode(scene_, nodes_, name, edge.first, direction, {0.f, 1.f, 0.f});
      scene_.lights.push_back(light);
    }
    if (left > 0)
      warn(
          "{}:{}: {} edges of object '{}' have no direction or a point that is not a number; they "
          "light nothing",
          ini_.file, group.line, left, name);
  }

  void tellWarnings() {
    const std::size_t told = std::min(warnings_.size(), kMostWarnings);
    scene_.warnings.insert(scene_.warnings.end(), warnings_.begin(),
                           warnings_.begin() + static_cast<std::ptrdiff_t>(told));
    if (told < warnings_.size())
      scene_.warnings.push_back(
          fmt::format("{}: and {} more faults", ini_.file, warnings_.size() - told));
  }

  const NodesByName& nodes_;
  const LightsIni& ini_;
  Scene& scene_;
  std::vector<std::string> warnings_;
};

}  // namespace

void convertEdges(const aiScene& source, const NodesByName& nodes, const LightsIni& ini,
                  Scene& scene) {
  std::vector<EdgeObject> objects;
  if (source.mRootNode) gatherEdges(source, *source.mRootNode, objects);
  EdgeLights(nodes, ini, scene).run(objects);
  scene.bake = ini.bake;
}

}  // namespace lucerna::scene
