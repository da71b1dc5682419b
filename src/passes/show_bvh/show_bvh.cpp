#include "passes/show_bvh/show_bvh.hpp"

#include <cmath>

namespace lucerna::passes {

using gpu::Format;

void ShowBvh::describe(graph::PassInfo<Params, Ports>& d) {
  d.pass("ShowBvh", "Draws the boxes of the culling hierarchy over the picture.");
  d.param("level", &Params::level)
      .range(-1, 63)
      .help("Level of the hierarchy, 0 is the root; -1 shows the leaves.");
  d.param("lineColor", &Params::lineColor)
      .color()
      .range(0, 100)
      .help(
          "Of the lines on the screen, linear: before ToneMap the scene's exposure is taken out.");
  d.param("hidden", &Params::hidden).help("Show lines behind surfaces, too.");
  d.read("scene", &Ports::scene).help("The hierarchy over its objects; its exposure.");
  d.read("view", &Ports::view).help("The view to draw from.");
  d.read("depth", &Ports::depth)
      .texture(Format::Depth32F)
      .help("Reversed depth of the surfaces that hide lines.");
  d.update("color", &Ports::color)
      .texture(Format::Rgba16Float, Format::Rgba8Unorm)
      .sameSizeAs("depth")
      .help("The picture, before or after ToneMap.");
}

std::vector<Aabb> boxesOfLevel(const scene::Bvh& bvh, int level) {
  struct Visit {
    std::uint32_t node;
    int level;
  };
  std::vector<Aabb> boxes;
  std::vector<Visit> stack;
  if (!bvh.nodes().empty()) stack.push_back({0, 0});
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const scene::Bvh::Node& node = bvh.nodes()[visit.node];
    if (node.count > 0 || visit.level == level) {
      boxes.push_back(node.box);
    } else {
      stack.push_back({node.first, visit.level + 1});
      stack.push_back({node.first + 1, visit.level + 1});
    }
  }
  return boxes;
}

ShowBvh::ShowBvh(gpu::Device& device)
    : program_(device.program({.vertex = "passes/show_bvh/show_bvh.vert",
                               .fragment = "passes/show_bvh/show_bvh.frag"})) {}

void ShowBvh::execute(graph::PassContext& context, const Params& params, const Ports& ports) {
  const std::vector<Aabb> boxes = boxesOfLevel(ports.scene->bvh, params.level);
  if (boxes.empty()) return;
  const std::uint32_t before = boxes_.id();
  context.device.write(boxes_, std::as_bytes(std::span(boxes)), "BVH boxes");
  if (boxes_.id() != before || !input_) {
    using Type = gpu::VertexAttribute::Type;
    input_ = context.device.createVertexInput(
        {.buffers = {{.buffer = &boxes_, .stride = sizeof(Aabb), .divisor = 1}},
         .attributes = {{0, 0, 3, Type::Float, offsetof(Aabb, min)},
                        {1, 0, 3, Type::Float, offsetof(Aabb, max)}},
         .indices = nullptr},
        "BVH boxes");
  }

  gpu::Rendering rendering = context.device.render({.colors = {{ports.color.get()}},
                                                    .depth = {ports.depth.get()},
                                                    .viewport = ports.view->viewport});
  rendering.use(
      *program_,
      {.depthTest = !params.hidden, .cull = gpu::Cull::None, .topology = gpu::Topology::Lines});
  program_->set("lineColor", params.lineColor);
  program_->set("encoded", ports.color->desc().format == Format::Rgba8Unorm);
  program_->set("exposure", std::exp2(ports.scene->scene->exposure));
  rendering.buffer("ViewBlock", ports.view->block);
  constexpr std::uint32_t kVerticesOfBox = 24;  // two for each of twelve edges
  rendering.draw(input_, 0, kVerticesOfBox, static_cast<std::uint32_t>(boxes.size()));
}

}  // namespace lucerna::passes
