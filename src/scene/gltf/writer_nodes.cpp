// The node hierarchy, cameras and lights.
#include <algorithm>
#include <cmath>

#include "scene/gltf/writer_parts.hpp"
#include "scene/view.hpp"

namespace lucerna::scene::gltf {
namespace {

constexpr const char* kLights = "KHR_lights_punctual";

class NodeWriter {
 public:
  NodeWriter(Output& out, MeshWriter& meshes) : out_(out), meshes_(meshes) {}

  void write();

 private:
  void addObjects();
  void addCameras();
  void addLights();
  std::size_t add(Json node, std::uint32_t parent);
  Json& placeOf(std::uint32_t node, const std::string& name, std::set<std::uint32_t>& taken);

  Output& out_;
  MeshWriter& meshes_;
  std::vector<Json> nodes_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> roots_;
};

Json jsonOf(const Node& node) {
  Json json = Json::object();
  if (!node.name.empty()) json["name"] = node.name;
  if (node.matrix) {
    Json& matrix = json["matrix"] = Json::array();
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) matrix.push_back((*node.matrix)[column][row]);
    return json;
  }
  const quat& r = node.rotation;
  if (node.translation != vec3(0.f)) json["translation"] = gltf::jsonOf(node.translation);
  if (r != quat(1.f, 0.f, 0.f, 0.f)) json["rotation"] = gltf::jsonOf(vec4(r.x, r.y, r.z, r.w));
  if (node.scale != vec3(1.f)) json["scale"] = gltf::jsonOf(node.scale);
  return json;
}

// What a camera leaves open is what Lucerna would choose. Square where only the output knows.
Json jsonOf(const Scene& scene, const Camera& camera) {
  const float aspect = camera.aspect > 0.f ? camera.aspect : 1.f;
  const View view = viewOf(scene, camera, aspect);
  Json json = Json::object();
  if (!camera.name.empty()) json["name"] = camera.name;
  if (camera.orthographic) {
    const float half = 0.5f * camera.height, near = std::max(view.near, 0.f);
    const float far = std::isfinite(view.far) ? view.far : near + 1e6f;
    json["type"] = "orthographic";
    json["orthographic"] = {
        {"xmag", half * aspect}, {"ymag", half}, {"zfar", far}, {"znear", near}};
    return json;
  }
  json["type"] = "perspective";
  Json& lens = json["perspective"];
  if (camera.aspect > 0.f) lens["aspectRatio"] = camera.aspect;
  lens["yfov"] = camera.fovY;
  if (camera.far > 0.f && std::isfinite(camera.far)) lens["zfar"] = camera.far;
  lens["znear"] = view.near;
  return json;
}

// The light's intensity if it fell with the square of the distance alone, which is all that glTF
// has. Of other attenuations the strength is kept at one distance: halfway to where the light or
// the scene ends.
float squareIntensity(Output& out, const Light& light) {
  const vec3 a = light.attenuation;
  if (light.kind == LightKind::Directional || a == vec3(0.f, 0.f, 1.f)) return light.intensity;
  if (a.x == 0.f && a.y == 0.f && a.z > 0.f) return light.intensity / a.z;
  out.notes.add("a light that does not fall with the square of the distance is right at one only");
  const float size = std::max(out.scene.boundsW().diagonal(), 1e-3f);
  const float d = 0.5f * std::min(reach(light), size);
  return light.intensity * d * d / std::max(a.x + a.y * d + a.z * d * d, 1e-6f);
}

void writeCone(Output& out, const Light& light, Json& json) {
  const float outer = std::min(light.outerCone, glm::half_pi<float>());
  json["spot"] = {{"innerConeAngle", std::min(light.innerCone, 0.999f * outer)},
                  {"outerConeAngle", outer}};
  if (light.exponent > 0.f) out.notes.add("the exponent of a spot light is left out");
}

Json jsonOf(Output& out, const Light& light) {
  Json json = Json::object();
  if (!light.name.empty()) json["name"] = light.name;
  // Colours are at most 1.
  const float brightest = std::max({light.color.x, light.color.y, light.color.z, 1.f});
  json["color"] = gltf::jsonOf(light.color / brightest);
  json["intensity"] = squareIntensity(out, light) * brightest;
  json["type"] = light.kind == LightKind::Directional ? "directional"
                 : light.kind == LightKind::Point     ? "point"
                                                      : "spot";
  if (light.range > 0.f && light.kind != LightKind::Directional) json["range"] = light.range;
  if (light.kind == LightKind::Spot) writeCone(out, light, json);
  if (light.radius > 0.f || light.angle > 0.f) out.notes.add("the size of a light is left out");
  return json;
}

std::size_t NodeWriter::add(Json node, std::uint32_t parent) {
  const std::size_t index = nodes_.size();
  nodes_.push_back(std::move(node));
  children_.emplace_back();
  (parent == kNone ? roots_ : children_[parent]).push_back(index);
  return index;
}

// The node itself for its first camera or light, a child of it for others.
Json& NodeWriter::placeOf(std::uint32_t node, const std::string& name,
                          std::set<std::uint32_t>& taken) {
  if (node != kNone && taken.insert(node).second) return nodes_[node];
  Json child = Json::object();
  if (!name.empty()) child["name"] = name;
  return nodes_[add(std::move(child), node)];
}

void NodeWriter::addObjects() {
  std::vector<std::vector<Object>> objects(out_.scene.nodes.size());
  for (const Object& object : out_.scene.objects)
    if (!out_.scene.meshes[object.mesh].elements().empty()) objects[object.node].push_back(object);
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (!objects[i].empty()) nodes_[i]["mesh"] = meshes_.mesh(objects[i]);
}

void NodeWriter::addCameras() {
  std::set<std::uint32_t> taken;
  for (const Camera& camera : out_.scene.cameras) {
    Json& node = placeOf(camera.node, camera.name, taken);
    node["camera"] = out_.append("cameras", jsonOf(out_.scene, camera));
  }
}

void NodeWriter::addLights() {
  std::set<std::uint32_t> taken;
  Json list = Json::array();
  for (std::size_t i = 0; i < out_.scene.lights.size(); ++i) {
    const Light& light = out_.scene.lights[i];
    if (i == out_.scene.headlight) continue;  // every viewer has its own
    if (!light.on) {
      out_.notes.add("a light that is off is left out");
      continue;
    }
    Json& node = placeOf(light.node, light.name, taken);
    out_.extend(node, kLights)["light"] = list.size();
    list.push_back(jsonOf(out_, light));
  }
  if (!list.empty()) out_.extend(out_.root, kLights)["lights"] = std::move(list);
}

void NodeWriter::write() {
  for (const Node& node : out_.scene.nodes) add(jsonOf(node), node.parent);
  addObjects();
  addCameras();
  addLights();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!children_[i].empty()) nodes_[i]["children"] = children_[i];
    out_.append("nodes", std::move(nodes_[i]));
  }
  Json scene = Json::object();
  if (!out_.scene.name.empty()) scene["name"] = out_.scene.name;
  if (!roots_.empty()) scene["nodes"] = roots_;
  out_.append("scenes", std::move(scene));
  out_.root["scene"] = 0;
}

}  // namespace

void writeNodes(Output& out, MeshWriter& meshes) {
  NodeWriter(out, meshes).write();
}

}  // namespace lucerna::scene::gltf
