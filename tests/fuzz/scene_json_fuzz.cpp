#include "fuzz/fuzz.hpp"
#include "scene/scene_json.hpp"

namespace lucerna::fuzz {
namespace {

scene::Mesh triangle() {
  scene::Mesh mesh;
  mesh.positions = {vec3(0.f), vec3(1.f, 0.f, 0.f), vec3(0.f, 1.f, 0.f)};
  mesh.indices = {0, 1, 2};
  return mesh;
}

// Something for materials and lightSettings to name: an object of mesh 0, a material, a light.
scene::Scene smallScene() {
  scene::Scene scene;
  scene.materials.emplace_back().name = "paint";
  const std::uint32_t node = scene::addNode(scene, "node", mat4(1.f));
  scene::Object& object = scene.objects.emplace_back();
  object.node = node;
  object.mesh = object.material = 0;
  scene::Light& light = scene.lights.emplace_back();
  light.name = "lamp";
  light.node = node;
  return scene;
}

}  // namespace

void sceneJson(ByteView bytes) {
  scene::Scene scene = smallScene();
  scene::SceneLoad load;
  load.meshes.push_back(triangle());
  load.outsideFiles = scene::OutsideFiles::Refuse;
  load.included.emplace("builtin:small", smallScene());
  const Status status = scene::addSceneJson(scene, "fuzz.json", std::string(textOf(bytes)), load);
  CHECK(load.open.empty());
  if (!status) checkRefusal(status.error(), ErrorKind::Input, "fuzz.json");
  // What is wrong is left as it was, so that the scene is sound in either case.
  scene.meshes = std::move(load.meshes);
  scene.textures = std::move(load.textures);
  useScene(std::move(scene));
}

}  // namespace lucerna::fuzz
