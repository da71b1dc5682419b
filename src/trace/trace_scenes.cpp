#include "trace/trace_scenes.hpp"

namespace lucerna::trace::testing {

scene::Scene emptyScene() {
  scene::Scene scene;
  scene.background.color = vec3(0.f);
  scene::Camera camera;
  camera.near = 0.01f;
  camera.far = 1000.f;
  camera.node = addNode(scene, "camera", mat4(1.f));
  scene.cameras.push_back(camera);
  return scene;
}

scene::View viewOf(const scene::Scene& scene, uvec2 size) {
  return scene::viewOf(scene, scene.cameras[0],
                       static_cast<float>(size.x) / static_cast<float>(size.y));
}

scene::Material& addMaterial(scene::Scene& scene) {
  scene::Material material;
  material.model = scene::MaterialModel::Phong;
  material.doubleSided = true;
  scene.materials.push_back(material);
  return scene.materials.back();
}

void addSquare(scene::Scene& scene, vec3 center, vec3 a, vec3 b) {
  scene::Mesh mesh;
  mesh.positions = {center - a - b, center + a - b, center + a + b, center - a + b};
  mesh.normals.assign(4, glm::normalize(glm::cross(a, b)));
  mesh.texCoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  for (const vec3& p : mesh.positions) mesh.bounds.grow(p);
  scene::Object object;
  object.node = addNode(scene, "square", mat4(1.f));
  object.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  object.material = static_cast<std::uint32_t>(scene.materials.size()) - 1;
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back(object);
  updateTransforms(scene);
}

vec3 addPane(scene::Scene& scene, int i) {
  scene::Material& pane = addMaterial(scene);
  pane.alphaMode = scene::AlphaMode::Blend;
  pane.albedo.w = 0.1f * static_cast<float>(i + 1);
  pane.transmission = {1.f, 0.8f, 0.5f};
  return scene::transmittance(pane.albedo.w, pane.transmission);
}

scene::Light& addLight(scene::Scene& scene, scene::LightKind kind, vec3 at, vec3 along) {
  const vec3 z = -glm::normalize(along);
  const vec3 x =
      glm::normalize(glm::cross(std::abs(z.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0), z));
  scene::Light light;
  light.kind = kind;
  light.range = 1000.f;
  light.outerCone = light.innerCone = 1.5f;
  light.node =
      addNode(scene, "light", mat4(vec4(x, 0), vec4(glm::cross(z, x), 0), vec4(z, 0), vec4(at, 1)));
  scene.lights.push_back(light);
  updateTransforms(scene);
  return scene.lights.back();
}

}  // namespace lucerna::trace::testing
