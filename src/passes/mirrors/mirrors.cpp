#include "passes/mirrors/mirrors.hpp"

#include <algorithm>
#include <utility>

#include "core/log.hpp"
#include "passes/mirrors/mirror_faces.hpp"

namespace lucerna::passes {

using gpu::Format;

namespace {

int depthOf(const std::vector<Reflection>& reflections) {
  int depth = 0;
  for (const Reflection& reflection : reflections)
    depth = std::max(depth, 1 + depthOf(reflection.within));
  return depth;
}

// In px of the window.
gpu::Rect scissorOf(const render::ViewData& view, const Reflection& reflection) {
  const ivec2 origin = reflection.part.origin - view.window.origin;
  const ivec2 size(reflection.part.size);
  return {origin.x, origin.y, size.x, size.y};
}

}  // namespace

void Mirrors::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("Mirrors", "Draws what planar mirrors reflect over their own material.");
  d.needs(gpu::kFeatureMultiDrawIndirect);
  d.needs(gpu::kFeatureDualSourceBlend);
  d.param("depth", &Params::depth)
      .range(1, 16)
      .help("Most reflections of a ray: at 1 a mirror in a mirror shows its own material.");
  d.param("budget", &Params::budget)
      .range(1, 65536)
      .help(
          "Most pictures of reflections in a view. Those that are smallest on the screen are left "
          "out: their mirrors show their own material.");
  d.param("ambient", &Params::ambient).range(0, 100).help("Factor on the scene's ambient light.");
  d.param("background", &Params::background)
      .range(0, 1000)
      .help("Factor on the background's radiance.");
  d.param("backFaces", &Params::backFaces)
      .help("Draw the back faces of single-sided materials, too; as GBuffer does.");
  d.read("scene", &Ports::scene).help("Geometry, materials and background.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("lights", &Ports::lights).help("Lights that are on, and the ambient light.");
  d.read("lightmaps", &Ports::lightmaps).optional().help("Baked light, which is added.");
  d.read("drawLists", &Ports::drawLists).help("Which mirrors are seen.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .help("Reversed depth of all surfaces, the mirrors among them.");
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float)
      .sameSizeAs("depth")
      .help("Linear radiance, the mirrors' own material where they are.");
}

Mirrors::Mirrors(gpu::Device& device)
    : background_(device),
      solid_(device),
      transparent_(device, {{"TRANSPARENT", "1"}}),
      showing_(device, "passes/mirrors/mirrored_picture.frag") {}

void Mirrors::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  if (ports.drawLists->mirrors.objects.empty()) return;
  const ReflectionPlan plan =
      planReflections(*ports.scene, *ports.view, ports.drawLists->mirrors.objects,
                      {.depth = params.depth,
                       .backFaces = params.backFaces,
                       .budget = static_cast<std::size_t>(params.budget)});
  warnOfCurved(*ports.scene->scene, plan.curved);
  warnOfBudget(plan.beyondBudget, params.budget);
  makeTargets(context.device, *ports.color, static_cast<std::size_t>(depthOf(plan.reflections)));
  Frame frame{.context = context, .params = params, .ports = ports};
  drawAll(frame, plan.reflections, *ports.view, {ports.color.get(), ports.depth.get()}, 0);
}

void Mirrors::warnOfCurved(const scene::Scene& scene, const std::vector<std::uint32_t>& objects) {
  for (const std::uint32_t index : objects)
    if (warned_.insert(index).second)
      log::warning(
          "'{}' has a reflectivity and is no planar mirror: its mesh has more than {} flat faces; "
          "it shows its own material",
          scene.nodes[scene.objects[index].node].name, kMostFaces);
}

void Mirrors::warnOfBudget(std::size_t beyond, int budget) {
  if (beyond == 0 || std::exchange(warnedOfBudget_, true)) return;
  log::warning(
      "Mirrors: {} of the smallest reflections are left out, as more than {} would be drawn; see "
      "its parameters budget and depth",
      beyond, budget);
}

void Mirrors::makeTargets(gpu::Device& device, const gpu::Texture& color, std::size_t count) {
  const gpu::TextureDesc desc{
      .format = Format::Rgba16Float, .width = color.width(), .height = color.height()};
  if (!targets_.empty() &&
      (targets_[0].color.width() != desc.width || targets_[0].color.height() != desc.height))
    targets_.clear();
  while (targets_.size() < count) {
    gpu::TextureDesc depth = desc;
    depth.format = Format::Depth32F;
    targets_.push_back({device.createTexture(desc, "reflection"),
                        device.createTexture(depth, "depth of reflection")});
  }
}

// Pictures of one depth are drawn and shown one after the other, so they share a target.
void Mirrors::drawAll(Frame& frame, const std::vector<Reflection>& reflections,
                      const render::ViewData& view, const Target& target, std::size_t depth) {
  for (const Reflection& reflection : reflections) {
    if (frame.reflections == buffers_.size()) buffers_.emplace_back();
    Buffers& buffers = buffers_[frame.reflections++];
    draw(frame, reflection, buffers, depth);
    show(frame, reflection, buffers, view, target, targets_[depth].color);
  }
}

void Mirrors::draw(Frame& frame, const Reflection& reflection, Buffers& buffers,
                   std::size_t depth) {
  gpu::Device& device = frame.context.device;
  const Ports& ports = frame.ports;
  updateView(device, buffers.view, reflection.view, ports.view->size, ports.view->window);
  makeLists(device, *ports.scene, reflection.view, reflection.visible, true, buffers.lists);
  const Target target{&targets_[depth].color, &targets_[depth].depth};
  const gpu::Targets targets{
      .colors = {{target.color}}, .depth = {target.depth}, .viewport = ports.view->viewport};
  const render::ForwardShading::Inputs inputs{.scene = *ports.scene,
                                              .view = buffers.view,
                                              .lights = *ports.lights,
                                              .lightmaps = ports.lightmaps.get(),
                                              .ambient = frame.params.ambient,
                                              .time = frame.context.time};
  const gpu::Cull cull = frame.params.backFaces ? gpu::Cull::None : gpu::Cull::Back;
  {
    gpu::Rendering rendering = device.render(targets);
    rendering.setScissor(scissorOf(*ports.view, reflection));
    // The background lies at depth 0: it clears both.
    background_.draw(rendering, *ports.scene, buffers.view, frame.params.background,
                     {.depthWrite = true, .cull = gpu::Cull::None});
    for (const render::DrawList* list : buffers.lists.solid())
      solid_.draw(rendering, inputs, *list, {.depthTest = true, .depthWrite = true, .cull = cull});
  }
  drawAll(frame, reflection.within, buffers.view, target, depth + 1);
  if (buffers.lists.transparent.objects.empty()) return;
  gpu::Rendering rendering = device.render(targets);
  rendering.setScissor(scissorOf(*ports.view, reflection));
  transparent_.draw(rendering, inputs, buffers.lists.transparent,
                    {.depthTest = true, .blend = gpu::Blend::Transmit, .cull = cull});
}

void Mirrors::show(Frame& frame, const Reflection& reflection, Buffers& buffers,
                   const render::ViewData& view, const Target& target,
                   const gpu::Texture& picture) {
  const Ports& ports = frame.ports;
  buffers.mirrors.objects = reflection.mirrors;
  finishList(frame.context.device, *ports.scene, view.view, buffers.mirrors);
  gpu::Rendering rendering = frame.context.device.render(
      {.colors = {{target.color}}, .depth = {target.depth}, .viewport = ports.view->viewport});
  rendering.setScissor(scissorOf(*ports.view, reflection));
  rendering.buffer("ViewBlock", view.block);
  rendering.texture("mirroredPicture", picture, gpu::kNearest);
  // Of a full mirror's own material nothing is left, not even an infinity.
  for (const bool full : {false, true}) {
    const auto programOf = [&](const scene::Material& material) -> const gpu::Program* {
      if ((material.reflectivity >= 1.f) != full) return nullptr;
      const gpu::Program& program = showing_.of(material);
      program.set("reflectivity", material.reflectivity);
      program.set("mirrorPlaneW", reflection.planeW);
      program.set("tolerance", reflection.tolerance);
      return &program;
    };
    drawList(rendering, *ports.scene, buffers.mirrors,
             {.depthTest = true,
              .blend = full ? gpu::Blend::Off : gpu::Blend::Alpha,
              .cull = frame.params.backFaces ? gpu::Cull::None : gpu::Cull::Back},
             programOf);
  }
}

}  // namespace lucerna::passes
