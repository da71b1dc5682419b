#include "render/deferred_shading.hpp"

namespace lucerna::render {

DeferredProgram::DeferredProgram(gpu::Device& device, std::string fragment) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert", .fragment = std::move(fragment)};
  plain_ = device.program(desc);
  desc.defines["AMBIENT_VISIBILITY"] = "1";
  occluded_ = device.program(desc);
}

gpu::Rendering beginDeferred(gpu::Device& device, const DeferredPorts& ports) {
  gpu::Rendering rendering = device.render({
      .colors = {{ports.color.get(), ports.color.isNew() ? gpu::Load::Clear : gpu::Load::Keep,
                  vec4(0.f, 0.f, 0.f, 1.f)}},
      .depth = {ports.depth.get()},
  });
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.buffer("LightBlock", ports.lights->block);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("normal", *ports.normal, gpu::kNearest);
  rendering.texture("albedo", *ports.albedo, gpu::kNearest);
  rendering.texture("specular", *ports.specular, gpu::kNearest);
  rendering.texture("material", *ports.material, gpu::kNearest);
  rendering.texture("emissive", *ports.emissive, gpu::kNearest);
  if (ports.ambientVisibility)
    rendering.texture("ambientVisibility", *ports.ambientVisibility, gpu::kNearest);
  return rendering;
}

gpu::RenderState deferredState(gpu::Blend blend) {
  return {.depthTest = true,
          .depthCompare = gpu::Compare::Less,
          .blend = blend,
          .cull = gpu::Cull::None};
}

}  // namespace lucerna::render
