#include "passes/show_gbuffer/show_gbuffer.hpp"

namespace lucerna::passes {

using gpu::Format;

void ShowGBuffer::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShowGBuffer", "Shows one component of the G-buffer on the screen.");
  d.param("component", &Params::component)
      .choices({"depth", "normal", "albedo", "specular", "occlusion", "material", "shininess",
                "metallic", "emissive", "position"})
      .help(
          "depth: scale / (scale + distance); normal: view space, 0.5 is zero; material: one "
          "colour per type; shininess: or roughness, 255 is white; position: world space, "
          "repeating every scale.");
  d.param("scale", &Params::scale)
      .range(1e-3, 1e6)
      .unit("m")
      .help("Distance at which depth shows half grey; period of position.");
  d.read("view", &Ports::view).help("The view that the G-buffer was drawn from.");
  d.read("depth", &Ports::depth).texture(Format::Depth32F).help("Reversed depth.");
  d.read("normal", &Ports::normal)
      .texture(Format::Rg16Unorm)
      .sameSizeAs("depth")
      .help("View-space normal, octahedral.");
  d.read("albedo", &Ports::albedo)
      .texture(Format::Srgb8Alpha8)
      .sameSizeAs("depth")
      .help("Diffuse or base colour.");
  d.read("specular", &Ports::specular)
      .texture(Format::Srgb8Alpha8)
      .sameSizeAs("depth")
      .help("Specular and occlusion of ambient light.");
  d.read("material", &Ports::material)
      .texture(Format::Rgba8Uint)
      .sameSizeAs("depth")
      .help("Type, shininess or roughness, metallic.");
  d.read("emissive", &Ports::emissive)
      .texture(Format::R11G11B10Float)
      .sameSizeAs("depth")
      .help("Radiance.");
  d.read("color", &Ports::input)
      .optional()
      .help("The picture to show instead while this pass is disabled.");
  d.write("color", &Ports::output)
      .texture(Format::Rgba8Unorm)
      .sizeOf("depth")
      .passesThrough("color")
      .help("sRGB-encoded picture; black where nothing was drawn.");
}

ShowGBuffer::ShowGBuffer(gpu::Device& device)
    : program_(device.program({.vertex = "gpu/fullscreen.vert",
                               .fragment = "passes/show_gbuffer/show_gbuffer.frag"})) {}

void ShowGBuffer::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering = context.device.render(
      {.colors = {{ports.output.get(), gpu::Load::Clear, vec4(0.f, 0.f, 0.f, 1.f)}},
       .depth = {ports.depth.get()}});
  // At depth 0: passes where something was drawn.
  rendering.use(*program_,
                {.depthTest = true, .depthCompare = gpu::Compare::Less, .cull = gpu::Cull::None});
  program_->set("component", static_cast<int>(params.component));
  program_->set("scale", params.scale);
  rendering.buffer("ViewBlock", ports.view->block);
  rendering.texture("depth", *ports.depth, gpu::kNearest);
  rendering.texture("normal", *ports.normal, gpu::kNearest);
  rendering.texture("albedo", *ports.albedo, gpu::kNearest);
  rendering.texture("specular", *ports.specular, gpu::kNearest);
  rendering.texture("material", *ports.material, gpu::kNearest);
  rendering.texture("emissive", *ports.emissive, gpu::kNearest);
  rendering.fullscreen();
}

}  // namespace lucerna::passes
