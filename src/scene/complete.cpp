// What a viewer expects where a file is silent.
#include <algorithm>
#include <cmath>

#include "scene/fit_camera.hpp"
#include "scene/load_parts.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {
namespace {

// A head-on white surface shows 0.8 of its albedo by the headlight and 0.2 by the ambient light.
constexpr float kHeadlightBrightness = 0.8f;
constexpr float kDefaultAmbient = 0.2f;

// A surface sends back no more than it gets; the G-buffer could not hold more either.
void limitReflectance(Scene& scene) {
  for (Material& material : scene.materials) {
    const vec3 albedo = glm::min(vec3(material.albedo), vec3(1.f));
    const vec3 specular = glm::min(material.specular, vec3(1.f));
    if (albedo == vec3(material.albedo) && specular == material.specular) continue;
    material.albedo = vec4(albedo, material.albedo.w);
    material.specular = specular;
    scene.warnings.push_back("material '" + material.name +
                             "' reflects more than it gets (a colour above 1); 1 is taken");
  }
}

void addBounds(Mesh& mesh) {
  mesh.bounds = {};
  for (const std::uint32_t index : mesh.elements()) mesh.bounds.grow(mesh.positions[index]);
}

void addTangents(Scene& scene) {
  for (const Object& object : scene.objects) {
    Mesh& mesh = scene.meshes[object.mesh];
    const TextureSlot& slot = scene.materials[object.material].normalTexture;
    if (!slot.used() || !mesh.tangents.empty() || mesh.texCoords[slot.texCoord].empty() ||
        mesh.triangleCount() == 0)
      continue;
    makeTangents(mesh, slot.texCoord);
  }
}

void addHeadlight(Scene& scene) {
  Light light;
  light.name = "headlight";
  light.kind = LightKind::Directional;
  light.intensity = kHeadlightBrightness * kPi;
  light.node = scene.cameras.front().node;
  scene.headlight = static_cast<std::uint32_t>(scene.lights.size());
  scene.lights.push_back(light);
  scene.ambient = vec3(kDefaultAmbient);
}

}  // namespace

void addDefaultMaterial(Scene& scene) {
  std::uint32_t material = kNone;
  for (Object& object : scene.objects) {
    if (object.material != kNone) continue;
    if (material == kNone) {
      material = static_cast<std::uint32_t>(scene.materials.size());
      Material grey;
      grey.name = "default";
      grey.albedo = vec4(vec3(0.8f), 1.f);
      grey.metallic = 0.f;
      grey.doubleSided = true;  // who states no material states no side either
      scene.materials.push_back(grey);
    }
    object.material = material;
  }
}

void complete(Scene& scene) {
  addDefaultMaterial(scene);
  limitReflectance(scene);
  for (Mesh& mesh : scene.meshes) {
    if (mesh.normals.empty() && mesh.triangleCount() > 0) makeNormals(mesh);
    if (mesh.bounds.empty()) addBounds(mesh);
  }
  addTangents(scene);
  addDeformations(scene);
  updateTransforms(scene);
  if (scene.cameras.empty()) addFittingCamera(scene);
  // A scene with ambient light only is meant to look so.
  if (scene.lights.empty() && scene.ambient == vec3(0.f)) addHeadlight(scene);
}

}  // namespace lucerna::scene
