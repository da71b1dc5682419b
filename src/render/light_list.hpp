// The resource "lights": all lights that are on, on the CPU and as the storage block `LightBlock`
// (render/lights.glsl), with the scene's ambient light.
#pragma once

#include <vector>

#include "gpu/device.hpp"
#include "scene/scene.hpp"

namespace lucerna::render {

struct LightList {
  static constexpr const char* kPortName = "Lights";
  std::vector<scene::PlacedLight> lights;
  vec3 ambient{0.f};  // scene ambient plus the lights' ambient shares
  gpu::Buffer block;  // LightBlock: world space; at least one light's room, count in the header
};

void updateLights(gpu::Device& device, LightList& list, const scene::Scene& scene);

}  // namespace lucerna::render
