#include "passes/geometry_samples/geometry_samples.hpp"

namespace lucerna::passes {

using gpu::Format;

namespace {

constexpr const char* kFragment = "passes/geometry_samples/geometry_samples.frag";

}  // namespace

void GeometrySamples::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("GeometrySamples", "Draws the G-buffer's surfaces at four places in each pixel.");
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.needs(gpu::kFeatureMultisample);
  d.param("geometry", &Params::geometry)
      .choices({"depth", "depth+normal"})
      .rebuilds(graph::Rebuild::Ports)
      .help("What is stored of a surface.");
  d.param("backFaces", &Params::backFaces)
      .help("Draw the back faces of single-sided materials, too; as GBuffer does.");
  d.read("scene", &Ports::scene).help("Geometry and materials.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("drawLists", &Ports::drawLists).help("What to draw: all but its transparent list.");
  d.write("depthSamples", &Ports::depthSamples)
      .spec(gpu::TextureKind::Multisample2D, {Format::Depth32F})
      .samples(kSamples)
      .sizeOfOutput()
      .whenDisabled(vec4(1.f))
      .help(
          "Reversed depth, 0 where nothing was drawn. 1, on the near plane like no surface, while "
          "the row is disabled.");
  if (d.values().geometry == Geometry::DepthAndNormal)
    d.write("normalSamples", &Ports::normalSamples)
        .spec(gpu::TextureKind::Multisample2D, {Format::Rg16Unorm})
        .samples(kSamples)
        .sizeOfOutput()
        .whenDisabled(vec4(0.5f))
        .help("View-space shading normal, octahedral.");
}

GeometrySamples::GeometrySamples(gpu::Device& device)
    : depthPrograms_(device, kFragment, {{"EACH_SAMPLE", "1"}}),
      normalPrograms_(device, kFragment, {{"EACH_SAMPLE", "1"}, {"NORMALS", "1"}}) {}

void GeometrySamples::execute(graph::PassContext& context, const Params& params,
                              const Ports& ports) {
  gpu::Targets targets{.depth = {ports.depthSamples.get(), gpu::Load::Clear},
                       .viewport = ports.view->viewport};
  if (ports.normalSamples)
    targets.colors = {{ports.normalSamples.get(), gpu::Load::Clear, vec4(0.5f)}};
  gpu::Rendering rendering = context.device.render(targets);
  const gpu::RenderState state{.depthTest = true,
                               .depthWrite = true,
                               .cull = params.backFaces ? gpu::Cull::None : gpu::Cull::Back};
  rendering.buffer("ViewBlock", ports.view->block);
  render::ObjectPrograms& programs = ports.normalSamples ? normalPrograms_ : depthPrograms_;
  const auto programOf = [&](const scene::Material& material) { return &programs.of(material); };
  for (const render::DrawList* list : ports.drawLists->solid())
    drawList(rendering, *ports.scene, *list, state, programOf);
}

}  // namespace lucerna::passes
