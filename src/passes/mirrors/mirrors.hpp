// Mirrors: what planar mirrors reflect, and mirrors in mirrors, drawn over their own material.
#pragma once

#include <deque>
#include <set>
#include <vector>

#include "graph/pass_info.hpp"
#include "passes/mirrors/plan_reflections.hpp"
#include "render/background_shading.hpp"
#include "render/forward_shading.hpp"

namespace lucerna::passes {

class Mirrors {
 public:
  struct Params {
    int depth = 4;
    int budget = 256;  // pictures of reflections
    float ambient = 1.f, background = 1.f;
    bool backFaces = false;
  };
  struct Ports {
    graph::In<render::GpuScene> scene;
    graph::In<render::ViewData> view;
    graph::In<render::LightList> lights;
    graph::In<render::Lightmaps> lightmaps;
    graph::In<render::DrawLists> drawLists;
    graph::In<gpu::Texture> depth;
    graph::InOut<gpu::Texture> color;
  };

  static void describe(graph::PassInfo<Params, Ports>& d);
  explicit Mirrors(gpu::Device& device);
  void execute(graph::PassContext& context, const Params& params, const Ports& ports);

 private:
  // A picture that reflections are drawn into, of the window's size, or the one that is passed on.
  struct Target {
    const gpu::Texture *color, *depth;
  };
  struct OwnTarget {
    gpu::Texture color, depth;
  };
  // What the GPU reads of a reflection, kept for its memory.
  struct Buffers {
    render::ViewData view;
    render::DrawLists lists;
    render::DrawList mirrors;  // as seen in the picture that shows them
  };
  struct Frame {
    graph::PassContext& context;
    const Params& params;
    const Ports& ports;
    std::size_t reflections = 0;  // drawn so far
  };

  void warnOfCurved(const scene::Scene& scene, const std::vector<std::uint32_t>& objects);
  void warnOfBudget(std::size_t beyond, int budget);
  void makeTargets(gpu::Device& device, const gpu::Texture& color, std::size_t count);
  void drawAll(Frame& frame, const std::vector<Reflection>& reflections,
               const render::ViewData& view, const Target& target, std::size_t depth);
  void draw(Frame& frame, const Reflection& reflection, Buffers& buffers, std::size_t depth);
  void show(Frame& frame, const Reflection& reflection, Buffers& buffers,
            const render::ViewData& view, const Target& target, const gpu::Texture& picture);

  render::BackgroundShading background_;
  render::ForwardShading solid_, transparent_;
  render::ObjectPrograms showing_;
  std::vector<OwnTarget> targets_;  // of each depth
  std::deque<Buffers> buffers_;
  std::set<std::uint32_t> warned_;
  bool warnedOfBudget_ = false;
};

}  // namespace lucerna::passes
