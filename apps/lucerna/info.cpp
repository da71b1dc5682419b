// lucerna info SCENE

#include <memory>

#include "command_line.hpp"
#include "scene/load.hpp"

namespace lucerna::cli {
namespace {

constexpr const char* kLightKinds[] = {"directional", "point", "spot"};

Json vectorJson(vec3 v) {
  return {v.x, v.y, v.z};
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
  json["bounds"] = {{"min", vectorJson(bounds.min)}, {"max", vectorJson(bounds.max)}};
  json["exposure"] = scene.exposure;
  json["ambient"] = vectorJson(scene.ambient);
  json["camera_list"] = Json::array();
  for (const scene::Camera& camera : scene.cameras)
    json["camera_list"].push_back(
        {{"name", camera.name},
         {"position", vectorJson(vec3(scene.nodes[camera.node].worldFromNode[3]))},
         {"fov_y", glm::degrees(camera.fovY)},
         {"orthographic", camera.orthographic}});
  json["light_list"] = Json::array();
  for (const scene::Light& light : scene.lights)
    json["light_list"].push_back({{"name", light.name},
                                  {"kind", kLightKinds[static_cast<int>(light.kind)]},
                                  {"intensity", light.intensity},
                                  {"group", light.group},
                                  {"on", light.on}});
  json["animation_list"] = Json::array();
  for (const scene::Animation& animation : scene.animations)
    json["animation_list"].push_back({{"name", animation.name}, {"seconds", animation.duration()}});
  json["warnings"] = scene.warnings;
  return json;
}

std::string sceneText(const scene::Scene& scene) {
  std::string text = scene.name + "\n";
  const Json counts = countsJson(scene);
  for (const auto& [name, count] : counts.items())
    text += fmt::format("  {:12} {:>10}\n", name, count.get<std::size_t>());
  const Aabb box = scene.boundsW();
  text += fmt::format("  from ({:.3f}, {:.3f}, {:.3f}) to ({:.3f}, {:.3f}, {:.3f}) m\n", box.min.x,
                      box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    text += fmt::format("  camera {}: '{}'\n", i, scene.cameras[i].name);
  for (const scene::Animation& animation : scene.animations)
    text += fmt::format("  animation '{}': {:.2f} s\n", animation.name, animation.duration());
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
  command->add_option("SCENE", *path, "file, or builtin:NAME?key=value")->required();
}

}  // namespace lucerna::cli
