// The description of a Fullscreen row, which its shader decides.
#pragma once

#include "graph/pass.hpp"
#include "passes/fullscreen/shader_interface.hpp"

namespace lucerna::passes {

// The resource that a shader gets by declaring the uniform block ViewBlock (render/view.glsl).
inline constexpr const char* kViewBlock = "ViewBlock";
inline constexpr const char* kViewPort = "view";

struct FullscreenRow {
  struct Params {
    std::string shader = "passes/fullscreen/copy.frag";
    std::string format = "Rgba16Float";
    float outputScale = 1.f;
    bool smooth = true;
    int halo = graph::kWholeImage;
  };
  Params params;
  ShaderInterface interface;
  graph::PassDescription description;  // the parameters of every row, then the shader's
  std::size_t fixedParams = 0;         // how many of them every row has
};

// Never fails: what is wrong with the shader is in description.faults.
FullscreenRow describeFullscreen(gpu::ShaderSources& sources, const graph::ParamValues& values);

// Uniforms that the program gives and no row sets: the scene's time (float, s), the frame (int).
bool isGiven(const ShaderInterface::Uniform& uniform);

}  // namespace lucerna::passes
