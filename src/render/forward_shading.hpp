// Draws lists forward: each object shaded as it is drawn, with all lights, by the shader that is
// built in or by its material's own. Used by every pass that does not go through the G-buffer.
#pragma once

#include <map>
#include <string>

#include "render/custom_programs.hpp"
#include "render/draw_list.hpp"
#include "render/light_list.hpp"
#include "render/lightmaps.hpp"
#include "render/object_programs.hpp"
#include "render/view_data.hpp"

namespace lucerna::render {

class ForwardShading {
 public:
  // defines: of render/forward.frag.
  explicit ForwardShading(gpu::Device& device,
                          const std::map<std::string, std::string>& defines = {});

  struct Inputs {
    const GpuScene& scene;
    const ViewData& view;
    const LightList& lights;
    const Lightmaps* lightmaps = nullptr;  // null: without baked light
    float ambient = 1.f;                   // factor on the scene's ambient light
    double time = 0;                       // s, for custom shaders
    bool onlyCustom = false;               // leaves out materials without a shader of their own
  };
  // state: as for drawList().
  void draw(gpu::Rendering& rendering, const Inputs& inputs, const DrawList& list,
            const gpu::RenderState& state);

 private:
  const gpu::Program* programOf(const Inputs& inputs, const scene::Material& material);

  ObjectPrograms programs_;
  CustomPrograms customPrograms_;
};

}  // namespace lucerna::render
