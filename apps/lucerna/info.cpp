// lucerna info SCENE

#include <memory>
#include <span>

#include "command_line.hpp"
#include "core/check.hpp"
#include "scene/load.hpp"

namespace lucerna::cli {
namespace {

constexpr const char* kLightKinds[] = {"directional", "point", "spot"};
constexpr const char* kLightUnits[] = {"lux", "cd", "cd"};
constexpr const char* kModels[] = {"phong", "metallic-roughness", "unlit", "specular-glossiness"};
constexpr const char* kAlphaModes[] = {"opaque", "mask", "blend"};

template <typename Enum>
const char* nameIn(std::span<const char* const> names, Enum value) {
  const auto index = static_cast<std::size_t>(value);
  CHECK(index < names.size(), "value {} has no name among {}", index, names.size());
  return names[index];
}

Json vectorJson(vec3 v) {
  return {v.x, v.y, v.z};
}

std::string vectorText(vec3 v) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", v.x, v.y, v.z);
}

vec3 placeOf(const scene::Scene& scene, std::uint32_t node) {
  return vec3(scene.nodes[node].worldFromNode[3]);
}

Json countsJson(const scene::Scene& scene) {
  return {{"triangles", scene.triangleCount()},   {"meshes", scene.meshes.size()},
          {"objects", scene.objects.size()},      {"nodes", scene.nodes.size()},
          {"materials", scene.materials.size()},  {"textures", scene.textures.size()},
          {"lights", scene.lights.size()},        {"cameras", scene.cameras.size()},
          {"animations", scene.animations.size()}};
}

Json sceneJson(const scene::Scene& scene) {
  Json json{{"name", scene.name}};
  json.update(countsJson(scene));
  const Aabb bounds = scene.boundsW();
  if (bounds.empty())
    json["bounds"] = nullptr;
  else
    json["bounds"] = {{"min", vectorJson(bounds.min)}, {"max", vectorJson(bounds.max)}};
  json["exposure"] = scene.exposure;
  json["ambient"] = vectorJson(scene.ambient);
  json["camera_list"] = Json::array();
  for (const scene::Camera& camera : scene.cameras)
    json["camera_list"].push_back({{"name", camera.name},
                                   {"position", vectorJson(placeOf(scene, camera.node))},
                                   {"fov_y", glm::degrees(camera.fovY)},
                                   {"orthographic", camera.orthographic}});
  json["light_list"] = Json::array();
  for (const scene::Light& light : scene.lights)
    json["light_list"].push_back({{"name", light.name},
                                  {"kind", nameIn(kLightKinds, light.kind)},
                                  {"intensity", light.intensity},
                                  {"group", light.group},
                                  {"on", light.on}});
  json["material_list"] = Json::array();
  for (const scene::Material& material : scene.materials)
    json["material_list"].push_back({{"name", material.name},
                                     {"model", nameIn(kModels, material.model)},
                                     {"alpha_mode", nameIn(kAlphaModes, material.alphaMode)},
                                     {"double_sided", material.doubleSided}});
  json["animation_list"] = Json::array();
  for (const scene::Animation& animation : scene.animations)
    json["animation_list"].push_back({{"name", animation.name},
                                      {"seconds", animation.duration()},
                                      {"playing", animation.playing}});
  json["warnings"] = scene.warnings;
  return json;
}

std::string sceneText(const scene::Scene& scene) {
  std::string text = scene.name + "\n";
  const Json counts = countsJson(scene);
  for (const auto& [name, count] : counts.items())
    text += fmt::format("  {:12} {:>10}\n", name, count.get<std::size_t>());
  if (const Aabb box = scene.boundsW(); box.empty())
    text += "  nothing to draw\n";
  else
    text += fmt::format("  from {} to {} m\n", vectorText(box.min), vectorText(box.max));
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    text += fmt::format("  camera {}: '{}' at {} m\n", i, scene.cameras[i].name,
                        vectorText(placeOf(scene, scene.cameras[i].node)));
  for (const scene::Light& light : scene.lights)
    text += fmt::format(
        "  light '{}': {}, {:g} {}{}{}\n", light.name, nameIn(kLightKinds, light.kind),
        light.intensity, nameIn(kLightUnits, light.kind),
        light.group.empty() ? "" : ", group '" + light.group + "'", light.on ? "" : ", off");
  for (const scene::Material& material : scene.materials)
    text += fmt::format("  material '{}': {}, {}{}\n", material.name,
                        nameIn(kModels, material.model), nameIn(kAlphaModes, material.alphaMode),
                        material.doubleSided ? ", double-sided" : "");
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    const scene::Animation& animation = scene.animations[i];
    text += fmt::format("  animation {}: '{}', {:.2f} s{}\n", i, animation.name,
                        animation.duration(), animation.playing ? ", playing" : "");
  }
  for (const std::string& warning : scene.warnings) text += "  warning: " + warning + "\n";
  return text;
}

Result<int> info(const std::string& path, bool json) {
  LUCERNA_TRY(scene, scene::loadScene(path));
  if (json)
    printJson(sceneJson(scene));
  else
    printText(sceneText(scene));
  return 0;
}

}  // namespace

void addInfo(CommandLine& line) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = addCommand(line, line.app, "info", "what a scene contains",
                                 [&line, path] { return info(*path, line.talk.json); });
  command->add_option("SCENE", *path, sceneHelp())->required();
}

}  // namespace lucerna::cli
