#include "passes/custom_shaders/custom_shaders.hpp"

#include <algorithm>

namespace lucerna::passes {
namespace {

bool anyCustom(const render::GpuScene& gpuScene, const render::DrawLists& lists) {
  return std::ranges::any_of(lists.solid(), [&](const render::DrawList* list) {
    return std::ranges::any_of(list->batches, [&](const render::DrawBatch& batch) {
      return gpuScene.scene->materials[batch.material].shader.used();
    });
  });
}

}  // namespace

using gpu::Format;

void CustomShaders::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("CustomShaders", "Draws objects whose material has a shader of its own over the picture.");
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  d.param("backFaces", &Params::backFaces)
      .help("Draw the back faces of single-sided materials, too; as GBuffer does.");
  d.read("scene", &Ports::scene).help("Geometry, materials and their shaders.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  d.read("lightmaps", &Ports::lightmaps).optional().help("Baked light, which is added.");
  d.read("drawLists", &Ports::drawLists)
      .help("What to draw: of all but its transparent list what has a custom shader.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .help("Reversed depth of all surfaces, these objects among them.");
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float)
      .sizeOf("depth")
      .sameSizeAs("depth")
      .optional()
      .whenDisabled(vec4(0.f, 0.f, 0.f, 1.f))
      .help("Linear radiance; before TiledLighting a picture that is black but for these objects.");
}

void CustomShaders::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  if (!ports.color.isNew() && !anyCustom(*ports.scene, *ports.drawLists)) return;
  gpu::Rendering rendering = context.device.render({
      .colors = {{ports.color.get(), ports.color.isNew() ? gpu::Load::Clear : gpu::Load::Keep,
                  vec4(0.f, 0.f, 0.f, 1.f)}},
      .depth = {ports.depth.get()},
      .viewport = ports.view->viewport,
  });
  // The objects are in the depth buffer already: what passes is what is seen.
  const gpu::RenderState state{.depthTest = true,
                               .cull = params.backFaces ? gpu::Cull::None : gpu::Cull::Back};
  const render::ForwardShading::Inputs inputs{.scene = *ports.scene,
                                              .view = *ports.view,
                                              .lights = *ports.lights,
                                              .lightmaps = ports.lightmaps.get(),
                                              .ambient = params.ambient,
                                              .time = context.time,
                                              .onlyCustom = true};
  for (const render::DrawList* list : ports.drawLists->solid())
    shading_.draw(rendering, inputs, *list, state);
}

}  // namespace lucerna::passes
