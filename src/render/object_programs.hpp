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
  // fragment: includes render/object_surface.glsl and knows ALPHA_TEST and TEXTURE_ENVIRONMENT, and
  // BAKED_LIGHT if it is asked for.
  ObjectPrograms(gpu::Device& device, std::string fragment,
                 std::map<std::string, std::string> defines = {});

  // Draws nothing if it does not compile; Device::takeErrors() then says why, each time.
  // baked: with BAKED_LIGHT, for scenes that have it (bakesLight() of render/lightmaps.hpp).
  const gpu::Program& of(const scene::Material& material, bool baked = false);

 private:
  gpu::Device& device_;
  gpu::ProgramDesc desc_;
  // Bit 0: alpha test, bit 1: texture environment, bit 2: baked light.
  std::array<gpu::ProgramPtr, 8> variants_;
};

}  // namespace lucerna::render
