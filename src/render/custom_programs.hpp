// The programs of materials that bring their own shader (scene::CustomShader).
#pragma once

#include <map>
#include <set>
#include <string>

#include "gpu/device.hpp"
#include "scene/scene.hpp"

namespace lucerna::render {

class CustomPrograms {
 public:
  // defines: of render/forward_output.glsl.
  explicit CustomPrograms(gpu::Device& device, std::map<std::string, std::string> defines = {});

  // The material's program with its parameters and the scene's time (s) set. Null if it does not
  // compile, or reads what the material does not give it: Device::takeErrors() says why, each time.
  // A parameter that it does not read is warned of once. baked: as for ObjectPrograms.
  const gpu::Program* of(const scene::Scene& scene, const scene::Material& material, double time,
                         bool baked = false);

 private:
  bool isCustomShader(const gpu::Program& program, const scene::Material& material);
  bool takesParameters(const gpu::Program& program, const scene::Material& material);
  bool hasAllInputs(const gpu::Program& program, const scene::Scene& scene,
                    const scene::Material& material);
  bool refuseOwnName(const scene::Material& material, const std::string& name);
  void refuse(const scene::Material& material, const std::string& problem);

  gpu::Device& device_;
  std::map<std::string, std::string> defines_;
  std::set<std::string> warned_;
};

}  // namespace lucerna::render
