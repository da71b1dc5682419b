#include "scene/scene_json.hpp"

#include <algorithm>

#include "core/file.hpp"
#include "core/json_value.hpp"
#include "core/text.hpp"
#include "scene/append.hpp"
#include "scene/scene_json_parts.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "scene/1";
constexpr std::size_t kMaxFiles = 1000;
constexpr std::uint64_t kMaxRepeatedBytes = 256ull << 20;
constexpr std::size_t kMaxDepth = 32;
constexpr NumberRange kScale{1e-6f, 1e6f};

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
    if (scale.number(uniform, kScale)) node.scale = vec3(uniform);
  } else if (scale.numbers({glm::value_ptr(axes), 3}, kAnyNumber)) {
    const vec3 size = glm::abs(axes);
    if (glm::any(glm::lessThan(size, vec3(kScale.min))) ||
        glm::any(glm::greaterThan(size, vec3(kScale.max))))
      scale.wrong(fmt::format("factors from {} to {}, or that below 0", kScale.min, kScale.max));
    else
      node.scale = axes;
  }
}

// "animation": the name or the index of the one that plays, or "none".
void readAnimation(const JsonValue& owner, Scene& scene) {
  if (!owner.has("animation")) return;
  const JsonValue animation = owner.at("animation");
  std::string choice;
  if (animation.isNumber())
    choice = animation.found();
  else if (!animation.text(choice))
    return;
  if (const Status chosen = chooseAnimation(scene, choice); !chosen)
    animation.fault(chosen.error().message);
}

// The scene to include, read when it is met for the first time. Null if it is faulty, which is told
// once. An error is none of the files': the reading must end.
Result<Scene*> includedScene(const JsonValue& file, const std::string& name, const fs::path& folder,
                             SceneLoad& load) {
  const bool builtin = name.starts_with("builtin:");
  std::error_code code;
  const std::string key = builtin ? name : fs::weakly_canonical(folder / name, code).string();
  if (const auto known = load.included.find(key); known != load.included.end()) {
    if (!known->second) return nullptr;
    load.repeatedBytes += bytesOf(*known->second) + bytesOfBent(*known->second, load.meshes);
    if (load.repeatedBytes <= kMaxRepeatedBytes) return &*known->second;
    file.fault(fmt::format("included again and again, scenes take more than {}; include fewer",
                           bytesText(kMaxRepeatedBytes)));
    return nullptr;
  }
  if (load.outsideFiles == OutsideFiles::Refuse) {
    file.wrong("nothing: no other scene may be read here");
    return nullptr;
  }
  if (load.included.size() >= kMaxFiles) {
    file.fault(fmt::format("more than {} different scenes are included", kMaxFiles));
    return nullptr;
  }
  Result<Scene> scene = readScene(builtin ? name : (folder / name).string(), load);
  if (!scene && scene.error().kind != ErrorKind::Input) return scene.error();
  if (!scene) file.fault(scene.error().message);
  Result<Scene>& kept = load.included.insert_or_assign(key, std::move(scene)).first->second;
  return kept ? &*kept : nullptr;
}

Status readIncludes(const JsonValue& includes, const fs::path& folder, Scene& scene,
                    SceneLoad& load) {
  std::map<const Scene*, std::size_t> materials;  // where those of an included scene begin
  for (const JsonValue& entry : includes.elements()) {
    if (!entry.object({"file", "translation", "rotation", "scale", "animation"})) continue;
    Node node;
    if (!entry.has("file")) entry.wrong("no \"file\"", "the scene to include");
    if (!entry.read("file", node.name)) continue;
    entry.read("translation", node.translation);
    readRotation(entry, node);
    readScale(entry, node);
    LUCERNA_TRY(part, includedScene(entry.at("file"), node.name, folder, load));
    if (!part) continue;
    const auto [known, isNew] = materials.emplace(part, scene.materials.size());
    Scene copy = *part;
    for (std::string& warning : copy.warnings) warning.insert(0, node.name + ": ");
    readAnimation(entry, copy);
    append(scene, std::move(copy), node, isNew ? std::nullopt : std::optional(known->second));
    part->warnings.clear();
  }
  return {};
}

// The file may not be among those that are being read.
Status enter(const fs::path& path, SceneLoad& load) {
  std::error_code code;
  fs::path whole = fs::weakly_canonical(path, code);
  if (code) whole = fs::absolute(path, code);
  const auto found = std::find(load.open.begin(), load.open.end(), whole);
  if (found != load.open.end()) {
    std::string circle;
    for (auto it = found; it != load.open.end(); ++it) circle += it->filename().string() + " -> ";
    return error(ErrorKind::Input, "{}: includes itself ({}{}); remove one of these includes",
                 path.string(), circle, whole.filename().string());
  }
  if (load.open.size() >= kMaxDepth)
    return error(ErrorKind::Input, "{}: includes are nested more than {} deep", path.string(),
                 kMaxDepth);
  load.open.push_back(std::move(whole));
  return {};
}

Status apply(const JsonValue& root, const fs::path& folder, Scene& scene, SceneLoad& load) {
  if (!root.object({"$schema", "lucerna", "include", "materials", "lights", "lightSettings",
                    "cameras", "background", "ambient", "exposure", "animation", "bake"}))
    return {};
  root.format(kFormat);
  if (root.has("include")) LUCERNA_TRY_VOID(readIncludes(root.at("include"), folder, scene, load));
  readAnimation(root, scene);
  JsonPictures pictures(folder, load);
  if (root.has("materials")) readMaterials(root.at("materials"), pictures, scene);
  if (root.has("lightSettings")) readLightSettings(root.at("lightSettings"), scene);
  if (root.has("lights")) readLights(root.at("lights"), scene);
  if (root.has("cameras")) readCameras(root.at("cameras"), scene);
  if (root.has("background")) readBackground(root.at("background"), pictures, scene.background);
  pictures.load();
  root.read("ambient", scene.ambient, kNotNegative);
  root.read("exposure", scene.exposure, {-30.f, 30.f, "EV"});
  if (root.has("bake")) readBake(root.at("bake"), scene.bake);
  return {};
}

}  // namespace

Status addSceneJson(Scene& scene, const fs::path& path, SceneLoad& load) {
  LUCERNA_TRY(text, readText(path));
  return addSceneJson(scene, path, text, load);
}

Status addSceneJson(Scene& scene, const fs::path& path, const std::string& text, SceneLoad& load) {
  LUCERNA_TRY(document, JsonDocument::parse(text, path.string(), ErrorKind::Input));
  LUCERNA_TRY_VOID(enter(path, load));
  const Status applied = apply(document.root(), path.parent_path(), scene, load);
  load.open.pop_back();
  LUCERNA_TRY_VOID(applied);
  return document.status();
}

}  // namespace lucerna::scene
