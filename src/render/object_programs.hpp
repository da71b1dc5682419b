// The programs that draw objects with one fragment shader: variants by #define, for what a material
// needs. Each is compiled when a material first asks for it.
#pragma once

#include <array>
#include <map>
#include <string>

#include "gpu/device.hpp"
#include "scene/material.hpp"

namespace lucerna::render {

class ObjectPrograms {
 public:
  // fragment: includes render/object_surface.glsl and knows ALPHA_TEST and TEXTURE_ENVIRONMENT.
  ObjectPrograms(gpu::Device& device, std::string fragment,
                 std::map<std::string, std::string> defines = {});

  // Draws nothing if it does not compile; Device::takeErrors() then says why, each time.
  const gpu::Program& of(const scene::Material& material);

 private:
  gpu::Device& device_;
  gpu::ProgramDesc desc_;
  std::array<gpu::ProgramPtr, 4> variants_;  // bit 0: alpha test, bit 1: texture environment
};

}  // namespace lucerna::render
