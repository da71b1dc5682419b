#include "passes/transparency/transparency.hpp"

namespace lucerna::passes {

using gpu::Format;

void Transparency::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Transparency", "Draws translucent objects back to front over the picture.");
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.needs(gpu::kFeatureDualSourceBlend);
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  d.param("backFaces", &Params::backFaces)
      .help("Draw the back faces of single-sided materials, too.");
  d.read("scene", &Ports::scene).help("Geometry and materials.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  d.read("lightmaps", &Ports::lightmaps).optional().help("Baked light, which is added.");
  d.read("drawLists", &Ports::drawLists).help("What to draw: its transparent list, in its order.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .help("Reversed depth of the opaque surfaces, which hide what lies behind.");
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float)
      .sameSizeAs("depth")
      .help("Linear radiance.");
}

void Transparency::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const render::DrawList& list = ports.drawLists->transparent;
  if (list.objects.empty()) return;
  gpu::Rendering rendering = context.device.render({.colors = {{ports.color.get()}},
                                                    .depth = {ports.depth.get()},
                                                    .viewport = ports.view->viewport});
  const gpu::RenderState state{.depthTest = true,
                               .blend = gpu::Blend::Transmit,
                               .cull = params.backFaces ? gpu::Cull::None : gpu::Cull::Back};
  shading_.draw(rendering,
                {.scene = *ports.scene,
                 .view = *ports.view,
                 .lights = *ports.lights,
                 .lightmaps = ports.lightmaps.get(),
                 .ambient = params.ambient,
                 .time = context.time},
                list, state);
}

}  // namespace lucerna::passes
