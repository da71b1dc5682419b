#include "scene/scene_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/text.hpp"
#include "scene/append.hpp"
#include "scene/json_reader.hpp"
#include "scene/scene_json_parts.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "scene/1";
constexpr int kMaxIncludes = 1000;
constexpr std::size_t kMaxDepth = 32;

// "rotation": three Euler angles, about x first, then y, then z, in degrees; or a quaternion x y z
// w.
void readRotation(const JsonValue& include, Node& node) {
  if (!include.has("rotation")) return;
  const JsonValue rotation = include.at("rotation");
  if (rotation.elements().size() == 4) {
    vec4 q(0.f);
    if (!rotation.numbers({glm::value_ptr(q), 4}, kAnyNumber)) return;
    if (glm::length(q) < 1e-6f) return rotation.wrong("a quaternion that is not zero");
    node.rotation = glm::normalize(quat(q.w, q.x, q.y, q.z));
    return;
  }
  vec3 degrees(0.f);
  if (!rotation.numbers({glm::value_ptr(degrees), 3}, kAnyNumber)) return;
  const vec3 angles = glm::radians(degrees);
  node.rotation = glm::angleAxis(angles.z, vec3(0.f, 0.f, 1.f)) *
                  glm::angleAxis(angles.y, vec3(0.f, 1.f, 0.f)) *
                  glm::angleAxis(angles.x, vec3(1.f, 0.f, 0.f));
}

void readScale(const JsonValue& include, Node& node) {
  if (!include.has("scale")) return;
  const JsonValue scale = include.at("scale");
  float uniform = 1.f;
  vec3 axes(1.f);
  if (scale.isNumber()) {
    if (scale.number(uniform, {1e-6f, 1e6f})) node.scale = vec3(uniform);
  } else if (scale.numbers({glm::value_ptr(axes), 3}, kAnyNumber)) {
    if (axes.x == 0.f || axes.y == 0.f || axes.z == 0.f)
      scale.wrong("factors that are not zero");
    else
      node.scale = axes;
  }
}

void include(const JsonValue& entry, const fs::path& folder, Scene& scene, IncludeChain& chain) {
  if (!entry.object({"file", "translation", "rotation", "scale"})) return;
  std::string file;
  if (!entry.has("file")) return entry.fault("found no \"file\", wanted the scene to include");
  if (!entry.read("file", file)) return;
  Node node;
  node.name = file;
  entry.read("translation", node.translation);
  readRotation(entry, node);
  readScale(entry, node);
  if (++chain.total > kMaxIncludes)
    return entry.fault(fmt::format("more than {} scenes are included", kMaxIncludes));
  const std::string path = file.starts_with("builtin:") ? file : (folder / file).string();
  Result<Scene> part = readScene(path, chain);
  if (!part) return entry.at("file").fault(part.error().message);
  append(scene, std::move(*part), node);
}

// The file may not be among those that are being read.
Status enter(const fs::path& path, IncludeChain& chain) {
  std::error_code code;
  fs::path whole = fs::weakly_canonical(path, code);
  if (code) whole = fs::absolute(path, code);
  const auto found = std::find(chain.open.begin(), chain.open.end(), whole);
  if (found != chain.open.end()) {
    std::string circle;
    for (auto it = found; it != chain.open.end(); ++it) circle += it->filename().string() + " -> ";
    return error(ErrorKind::Input, "{}: includes itself ({}{}); remove one of these includes",
                 path.string(), circle, whole.filename().string());
  }
  if (chain.open.size() >= kMaxDepth)
    return error(ErrorKind::Input, "{}: includes are nested more than {} deep", path.string(),
                 kMaxDepth);
  chain.open.push_back(std::move(whole));
  return {};
}

void apply(const JsonValue& root, const fs::path& folder, Scene& scene, IncludeChain& chain) {
  if (!root.object({"$schema", "lucerna", "include", "materials", "lights", "lightSettings",
                    "cameras", "background", "ambient", "exposure"}))
    return;
  root.format(kFormat);
  if (root.has("include"))
    for (const JsonValue& entry : root.at("include").elements())
      include(entry, folder, scene, chain);
  if (root.has("materials")) readMaterials(root.at("materials"), scene);
  if (root.has("lightSettings")) readLightSettings(root.at("lightSettings"), scene);
  if (root.has("lights")) readLights(root.at("lights"), scene);
  if (root.has("cameras")) readCameras(root.at("cameras"), scene);
  if (root.has("background")) readBackground(root.at("background"), folder, scene);
  root.read("ambient", scene.ambient, kNotNegative);
  root.read("exposure", scene.exposure, {-30.f, 30.f, "EV"});
}

}  // namespace

Status addSceneJson(Scene& scene, const fs::path& path, IncludeChain& chain) {
  LUCERNA_TRY(text, readText(path));
  LUCERNA_TRY(document, parseJson(text, path.string()));
  LUCERNA_TRY_VOID(enter(path, chain));
  JsonFaults faults(path.string(), text);
  apply(JsonValue(document, "", faults), path.parent_path(), scene, chain);
  chain.open.pop_back();
  return faults.status();
}

}  // namespace lucerna::scene
