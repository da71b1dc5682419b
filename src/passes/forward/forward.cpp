#include "passes/forward/forward.hpp"

namespace lucerna::passes {

using gpu::Format;

void Forward::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Forward", "Draws all but translucent objects, shading each fragment with all lights.");
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  d.param("backFaces", &Params::backFaces)
      .help("Draw the back faces of single-sided materials, too.");
  d.read("scene", &Ports::scene).help("Geometry and materials.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  d.read("lightmaps", &Ports::lightmaps).optional().help("Baked light, which is added.");
  d.read("drawLists", &Ports::drawLists).help("What to draw: all but its transparent list.");
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

void Forward::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  gpu::Rendering rendering = context.device.render({
      .colors = {{ports.color.get(), gpu::Load::Clear, vec4(0.f, 0.f, 0.f, 1.f)}},
      .depth = {ports.depth.get(), gpu::Load::Clear},
      .viewport = ports.view->viewport,
  });
  const gpu::RenderState state{.depthTest = true,
                               .depthWrite = true,
                               .cull = params.backFaces ? gpu::Cull::None : gpu::Cull::Back};
  const render::ForwardShading::Inputs inputs{.scene = *ports.scene,
                                              .view = *ports.view,
                                              .lights = *ports.lights,
                                              .lightmaps = ports.lightmaps.get(),
                                              .ambient = params.ambient,
                                              .time = context.time};
  for (const render::DrawList* list : ports.drawLists->solid())
    shading_.draw(rendering, inputs, *list, state);
}

}  // namespace lucerna::passes
