#include "passes/forward/forward.hpp"

namespace lucerna::passes {

using gpu::Format;

void Forward::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Forward",
         "Draws opaque and alpha-tested objects, shading each fragment with all lights.");
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  d.param("backFaces", &Params::backFaces)
      .help("Draw the back faces of single-sided materials, too.");
  d.read("scene", &Ports::scene).help("Geometry and materials.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  d.read("drawLists", &Ports::drawLists).help("What to draw: its opaque and alpha-tested lists.");
  d.write("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f))
      .help("Reversed depth: 1 at the near plane, 0 where nothing was drawn.");
  d.write("color", &Ports::color)
      .texture(Format::Rgba16Float)
      .sizeOfOutput()
      .whenDisabled(vec4(0.f, 0.f, 0.f, 1.f))
      .help("Linear radiance, emission included; black where nothing was drawn.");
}

Forward::Forward(gpu::Device& device)
    : opaque_(device.program({.vertex = "render/object.vert", .fragment = "render/forward.frag"})),
      alphaTested_(device.program({.vertex = "render/object.vert",
                                   .fragment = "render/forward.frag",
                                   .defines = {{"ALPHA_TEST", "1"}}})) {}

void Forward::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering = context.device.render({
      .colors = {{ports.color.get(), gpu::Load::Clear, vec4(0.f, 0.f, 0.f, 1.f)}},
      .depth = {ports.depth.get(), gpu::Load::Clear},
  });
  const gpu::RenderState state{.depthTest = true,
                               .depthWrite = true,
                               .cull = params.backFaces ? gpu::Cull::None : gpu::Cull::Back};
  const render::DrawLists& lists = *ports.drawLists;
  const auto draw = [&](const render::DrawList& list, const gpu::Program& program) {
    rendering.use(program, state);
    program.set("ambientScale", params.ambient);
    rendering.buffer("LightBlock", ports.lights->block);
    drawList(rendering, *ports.scene, list, program, state, ports.view->block);
  };
  draw(lists.opaque, *opaque_);
  draw(lists.alphaTested, *alphaTested_);
}

}  // namespace lucerna::passes
