#include "passes/gbuffer/gbuffer.hpp"

#include <utility>

#include "core/log.hpp"

namespace lucerna::passes {

using gpu::Format;

namespace {

// Half floats: baked light varies slowly, and six bits of mantissa would show in it as bands.
void describeBakedLight(graph::PassInfo<GBuffer::Params, GBuffer::Ports>& d) {
  using Ports = GBuffer::Ports;
  d.param("baked", &GBuffer::Params::baked)
      .rebuilds(graph::Rebuild::Ports)
      .help("Draw baked light, too, into a target of its own.");
  if (!d.values().baked) return;
  d.read("lightmaps", &Ports::lightmaps).help("Baked light; without any the target is black.");
  d.write("bakedIrradiance", &Ports::bakedIrradiance)
      .texture(Format::Rgba16Float)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f))
      .help("Irradiance by baked light.");
}

}  // namespace

void GBuffer::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("GBuffer", "Draws geometry and materials of all but translucent objects into targets.");
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.param("backFaces", &Params::backFaces)
      .help("Draw the back faces of single-sided materials, too.");
  d.read("scene", &Ports::scene).help("Geometry and materials.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("drawLists", &Ports::drawLists).help("What to draw: all but its transparent list.");
  d.write("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f))
      .help("Reversed depth: 1 at the near plane, 0 where nothing was drawn.");
  d.write("normal", &Ports::normal)
      .texture(Format::Rg16Unorm)
      .sizeOfOutput()
      .whenDisabled(vec4(0.5f))
      .help("View-space shading normal, octahedral.");
  d.write("albedo", &Ports::albedo)
      .texture(Format::Srgb8Alpha8)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f, 0.f, 0.f, 1.f))
      .help("Diffuse reflectance, or base colour of metallic-roughness.");
  d.write("specular", &Ports::specular)
      .texture(Format::Srgb8Alpha8)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f, 0.f, 0.f, 1.f))
      .help(
          "rgb: specular reflectance of Phong and specular-glossiness; a: occlusion of ambient "
          "light.");
  d.write("material", &Ports::material)
      .texture(Format::Rgba8Uint)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f))
      .help(
          "r: type (0 nothing, 1 Phong, 2 metallic-roughness, 3 custom shader, 4 unlit, 5 "
          "specular-glossiness); g: shininess or roughness * 255; b: metallic * 255.");
  d.write("emissive", &Ports::emissive)
      .texture(Format::R11G11B10Float)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f))
      .help("Radiance that the surface sends out by itself.");
  describeBakedLight(d);
}

bool GBuffer::bakes(gpu::Device& device, const Ports& ports) {
  if (!ports.bakedIrradiance) return false;
  if (render::bakesLight(*ports.scene, ports.lightmaps.get())) return true;
  device.clear(*ports.bakedIrradiance, vec4(0.f));
  if (!std::exchange(warned_, true))
    log::warning(
        "GBuffer: baked=true finds no baked light, so that there is none; --lightmap DIR brings "
        "it, of a folder that `lucerna bake` made");
  return false;
}

void GBuffer::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const bool baked = bakes(context.device, ports);
  gpu::Targets targets{
      .colors = {{ports.normal.get(), gpu::Load::Clear, vec4(0.5f)},
                 {ports.albedo.get(), gpu::Load::Clear, vec4(0.f, 0.f, 0.f, 1.f)},
                 {ports.specular.get(), gpu::Load::Clear, vec4(0.f, 0.f, 0.f, 1.f)},
                 {ports.material.get(), gpu::Load::Clear, vec4(0.f)},
                 {ports.emissive.get(), gpu::Load::Clear, vec4(0.f)}},
      .depth = {ports.depth.get(), gpu::Load::Clear},
      .viewport = ports.view->viewport,
  };
  if (baked) targets.colors.push_back({ports.bakedIrradiance.get(), gpu::Load::Clear, vec4(0.f)});
  gpu::Rendering rendering = context.device.render(targets);
  const gpu::RenderState state{.depthTest = true,
                               .depthWrite = true,
                               .cull = params.backFaces ? gpu::Cull::None : gpu::Cull::Back};
  rendering.buffer("ViewBlock", ports.view->block);
  if (baked) render::bindLightmaps(rendering, *ports.lightmaps);
  const auto programOf = [&](const scene::Material& material) {
    return &programs_.of(material, baked);
  };
  for (const render::DrawList* list : ports.drawLists->solid())
    drawList(rendering, *ports.scene, *list, state, programOf);
}

}  // namespace lucerna::passes
