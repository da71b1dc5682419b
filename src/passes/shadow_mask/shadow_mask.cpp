#include "passes/shadow_mask/shadow_mask.hpp"

namespace lucerna::passes {

using gpu::Format;

void ShadowMask::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShadowMask", "Finds for each pixel the layers whose light is blocked, a bit for each.");
  d.param("bias", &Params::bias)
      .range(0, 100)
      .unit("m")
      .help("How far a point is moved towards the light before it is compared.");
  d.param("normalBias", &Params::normalBias)
      .range(0, 16)
      .help("How far a point is moved off its surface before it is compared: see TiledLighting.");
  d.read("view", &Ports::view).help("The view that the G-buffer was drawn from.");
  d.read("lights", &Ports::lights).help("Lights that are on.");
  d.read("tileLights", &Ports::tileLights)
      .optional()
      .help("Which lights may reach a pixel; without it each pixel tries them all.");
  d.read("shadowMaps", &Ports::shadowMaps)
      .optional()
      .help("What each light sees; without it nothing is blocked.");
  d.read("shadowLayers", &Ports::shadowLayers)
      .optional()
      .help("The layer of each light; without it nothing is in the mask.");
  d.read("depth", &Ports::depth).texture(Format::Depth32F).halo(1).help("Reversed depth.");
  d.read("normal", &Ports::normal)
      .texture(Format::Rg16Unorm)
      .sameSizeAs("depth")
      .help("View-space normal, octahedral.");
  d.write("shadowMask", &Ports::shadowMask)
      .texture(Format::R32Uint)
      .sizeOf("depth")
      .whenDisabled(vec4(0.f))
      .help("Bit l: the light of layer l that reaches this pixel is blocked.");
}

ShadowMask::ShadowMask(gpu::Device& device) {
  gpu::ProgramDesc desc{.vertex = "gpu/fullscreen.vert",
                        .fragment = "passes/shadow_mask/shadow_mask.frag"};
  ofAllLights_ = device.program(desc);
  desc.defines["TILE_LIGHTS"] = "1";
  ofTiles_ = device.program(desc);
}

void ShadowMask::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering =
      context.device.render({.colors = {{ports.shadowMask.get(), gpu::Load::Clear, vec4(0.f)}},
                             .depth = {ports.depth.get()}});
  if (!ports.shadowMaps || !ports.shadowLayers) return;
  const gpu::Program& program = ports.tileLights ? *ofTiles_ : *ofAllLights_;
  rendering.use(program,
                {.depthTest = true, .depthCompare = gpu::Compare::Less, .cull = gpu::Cull::None});
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.buffer("LightBlock", ports.lights->block);
  if (ports.tileLights) rendering.buffer("TileLightBlock", ports.tileLights->block);
  rendering.buffer("ShadowLayerBlock", ports.shadowLayers->block);
  render::bindShadowMaps(rendering, *ports.shadowMaps, false);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("normal", *ports.normal, gpu::kNearest);
  program.set("shadowReach", 0.5f);
  program.set("shadowBias", params.bias);
  program.set("shadowNormalBias", params.normalBias);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
