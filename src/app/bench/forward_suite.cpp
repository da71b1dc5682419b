// Tables 4.3 and 4.4, and figure 4.2: forward shading against the deferred chain along a path.
#include "app/bench/suite.hpp"

namespace lucerna::app::bench {
namespace {

constexpr int kFramesPerCamera = 4;  // along the path from one to the next

const std::string kForward = "forward", kDeferred = "deferred";

Chain chainOf(const std::string& name) {
  Chain chain{{{"Cull"}}};
  if (name == kForward)
    chain.rows.push_back({"Forward"});
  else
    chain.rows.insert(chain.rows.end(),
                      {{"GBuffer"}, {"TileLights"}, {"TiledLighting"}, {"CustomShaders"}});
  chain.rows.insert(chain.rows.end(), {{"Background"}, {"Transparency"}, {"ToneMap"}});
  return chain;
}

// The samples of a name are in the order of the path, all rounds of a frame together.
Status measure(Run& run) {
  for (const uvec2 size : run.extent.sizes)
    for (const std::string& name : {kForward, kDeferred})
      run.add({sizeName(size), name, run.scene}, {.chain = chainOf(name), .size = size});
  const CameraPath path = pathThrough(run.cameras);
  const int frames = kFramesPerCamera * (run.extent.cameras - 1) + 1;
  const Run::Turns turns{.take = [&](const Name& name, const Sample& sample) {
    Measurement& m = run.results.at(name);
    m.add(sample.realMs, sample.cpuMs);
    m.count("draws", static_cast<double>(sample.counters.draws));
    m.count("primitives", static_cast<double>(sample.counters.primitives));
  }};
  for (int frame = 0; frame < frames; ++frame) {
    const CameraPose pose = path.at(static_cast<double>(frame) / kFramesPerCamera);
    LUCERNA_TRY_VOID(run.stage.look(pose));
    LUCERNA_TRY_VOID(run.takeTurns(turns, 1.0 / frames));
  }
  return {};
}

// The median of each frame's rounds.
std::vector<double> alongPath(const Measurement& m, int rounds) {
  std::vector<double> frames;
  const auto count = static_cast<std::size_t>(rounds);
  for (std::size_t i = 0; i + count <= m.realMs.size(); i += count)
    frames.push_back(spreadOf(std::span(m.realMs).subspan(i, count)).median);
  return frames;
}

Table timesOf(const Results& results, const std::string& size) {
  const std::string ratio = kForward + " / " + kDeferred;
  return tableOf(size + ", ms", "chain", {kForward, kDeferred, ratio}, results.parts(2, {size}),
                 [&](const std::string& row, const std::string& scene) {
                   return row == ratio ? ratioText(results.ratios({size, kForward, scene},
                                                                  {size, kDeferred, scene}))
                                       : spreadText(results.times({size, row, scene}));
                 });
}

LinePlot pathPlot(const Results& results, const std::string& size, const std::string& chain) {
  LinePlot plot{
      .title = chain + " along the path, " + size,
      .xLabel = "frame",
      .yLabel = "ms",
  };
  for (const std::string& scene : results.parts(2, {size, chain})) {
    Curve& curve = plot.curves.emplace_back(Curve{.name = scene});
    for (const double ms : alongPath(*results.find({size, chain, scene}), results.rounds))
      curve.points.emplace_back(static_cast<double>(curve.points.size()), ms);
  }
  return plot;
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(
      "Time of a whole frame in ms: median (quartiles) over all frames of a path through the "
      "seeded "
      "cameras. Both chains shade the same materials by the same code, lit by one light.");
  const std::vector<std::string> sizes = results.parts(0);
  for (const std::string& size : sizes) blocks.emplace_back(timesOf(results, size));
  blocks.emplace_back(
      drawsTable(results, sizes.front(), "chain", {kForward, kDeferred}, results.parts(2)));
  for (const std::string& size : sizes)
    for (const std::string& chain : {kForward, kDeferred})
      blocks.emplace_back(pathPlot(results, size, chain));
  return blocks;
}

}  // namespace

Suite forwardSuite() {
  return {.name = "forward",
          .title = "forward against deferred shading (tables 4.3 and 4.4, figure 4.2)",
          .scenes = thesisScenes(),
          .full = {.sizes = {{800, 600}, {1366, 768}}, .cameras = 13, .rounds = 3},
          .quick = {.sizes = {{320, 240}, {546, 307}}, .cameras = 4, .rounds = 2},
          .measure = measure,
          .report = report};
}

}  // namespace lucerna::app::bench
