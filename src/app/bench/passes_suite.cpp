// Tables 4.5 and 4.6, and figure 4.3: what every pass takes, in two resolutions.
#include <algorithm>
#include <map>

#include "app/bench/suite.hpp"

namespace lucerna::app::bench {
namespace {

// The share of the sight that surfaces darken each other over, and the lens by the sight: what is
// infinitely far is then blurred over a fiftieth of the picture's height.
constexpr float kAoRadius = 0.1f, kLensRadius = 0.01f;

Row row(const char* pass, std::vector<std::string> settings = {},
        std::vector<Length> lengths = {}) {
  return {.pass = pass, .settings = std::move(settings), .lengths = std::move(lengths)};
}

const std::vector<Length> kAo{{"radius", kAoRadius}},
    kLens{{"lensRadius", kLensRadius}, {"focusDistance", 1.f}};

// All passes of system A, with the thesis' own methods where there are several.
Chain thesisChain() {
  return {{row("Cull"), row("GBuffer"),
           row("ScreenSpaceAo", {"method=hemisphere", "blur=box", "samples=30"}, kAo),
           row("CustomShaders"), row("ShadowMaps", {"method=lispsm", "size=2048", "redraw=always"}),
           row("TileLights"), row("TiledLighting"), row("Background"), row("Mirrors"),
           row("Transparency"), row("GeometrySamples"), row("Sraa"),
           row("DepthOfField", {"method=separable"}, kLens), row("ToneMap")}};
}

// What can stand in their place.
Chain otherChain() {
  return {{row("Cull"), row("GBuffer"), row("ScreenSpaceAo", {"method=horizon"}, kAo),
           row("TileLights"), row("TiledLighting", {"shadows=none"}), row("CustomShaders"),
           row("Background"), row("Transparency"), row("DepthOfField", {"method=gather"}, kLens),
           row("ToneMap"), row("Fxaa")}};
}

const std::string kFrame = "whole frame";  // of the thesis' chain
// What the tables call rows of the other chain; they do not show the rest, which both have.
const std::map<std::string, std::string> kOtherRows{{"ScreenSpaceAo", "ScreenSpaceAo, horizon"},
                                                    {"TiledLighting", "TiledLighting, no shadows"},
                                                    {"DepthOfField", "DepthOfField, gather"},
                                                    {"Fxaa", "Fxaa"}};

std::string labelOf(const std::string& row, bool other) {
  if (other) return kOtherRows.contains(row) ? kOtherRows.at(row) : "";
  return row == "ScreenSpaceAo"  ? "ScreenSpaceAo, hemisphere"
         : row == "DepthOfField" ? "DepthOfField, separable"
                                 : row;
}

// Cost: graph::StepProfile or graph::FrameProfile.
template <typename Cost>
void add(Measurement& m, const Cost& cost) {
  m.add(cost.gpuMs, cost.cpuMs);
  m.count("draws", static_cast<double>(cost.counters.draws));
  m.count("primitives", static_cast<double>(cost.counters.primitives));
}

// Variants are named by size, chain and scene; measurements by size, pass and scene.
Status measure(Run& run) {
  const std::string thesis = "thesis", other = "other";
  for (const uvec2 size : run.extent.sizes)
    for (const std::string& chain : {thesis, other})
      run.add(
          {sizeName(size), chain, run.scene},
          {.chain = chain == other ? otherChain() : thesisChain(), .size = size, .profiled = true});
  return run.takeTurnsEverywhere({.take = [&](const Name& name, const Sample& sample) {
    const bool isOther = name[1] == other;
    for (const graph::StepProfile& step : sample.profile.steps)
      if (const std::string label = labelOf(step.row, isOther); !label.empty())
        add(run.results.at({name[0], label, run.scene}), step);
    if (!isOther) add(run.results.at({name[0], kFrame, run.scene}), sample.profile);
  }});
}

// The passes of the thesis' chain that take longest.
std::vector<std::string> largestPasses(const Results& results, const std::string& size) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> passes = results.parts(1, {size});
  std::erase_if(passes, [](const std::string& label) {
    return label == kFrame ||
           std::ranges::any_of(kOtherRows, [&](const auto& row) { return row.second == label; });
  });
  const auto time = [&](const std::string& pass) {
    return -spreadOf(results.times({size, pass})).median;
  };
  std::ranges::stable_sort(passes, {}, time);
  passes.resize(std::min(passes.size(), kMost));
  return passes;
}

BarPlot barsOf(const Results& results, const std::string& size) {
  BarPlot plot{.title = "A frame at " + size + ", medians",
               .unit = "ms",
               .rows = results.parts(2, {size}),
               .parts = largestPasses(results, size)};
  for (const std::string& scene : plot.rows) {
    std::vector<double>& values = plot.values.emplace_back();
    double rest = spreadOf(results.times({size, kFrame, scene})).median;
    for (const std::string& pass : plot.parts) {
      values.push_back(spreadOf(results.times({size, pass, scene})).median);
      rest -= values.back();
    }
    values.push_back(std::max(rest, 0.0));
  }
  plot.parts.emplace_back("all others");
  return plot;
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(
      "Time in ms: median (quartiles) over all cameras and rounds. Below the whole frame stand the "
      "passes of a second chain, which is drawn in turn with it: TiledLighting without shadows, "
      "other "
      "methods of ScreenSpaceAo and DepthOfField, and Fxaa. Radius, lens and focus follow from "
      "how far away things are at each place.");
  const std::vector<std::string> sizes = results.parts(0);
  const std::vector<std::string> passes = results.parts(1), scenes = results.parts(2);
  for (const std::string& size : sizes)
    blocks.emplace_back(tableOf(size + ", ms", "pass", passes, scenes,
                                [&](const std::string& pass, const std::string& scene) {
                                  return spreadText(results.times({size, pass, scene}));
                                }));
  if (sizes.size() > 1)
    blocks.emplace_back(
        tableOf(sizes.back() + " against " + sizes.front() + ", median of the ratios", "pass",
                passes, scenes, [&](const std::string& pass, const std::string& scene) {
                  return ratioText(
                      results.ratios({sizes.back(), pass, scene}, {sizes.front(), pass, scene}));
                }));
  blocks.emplace_back(drawsTable(results, sizes.front(), "pass", passes, scenes));
  for (const std::string& size : sizes) blocks.emplace_back(barsOf(results, size));
  return blocks;
}

}  // namespace

Suite passesSuite() {
  return {.name = "passes",
          .title = "the cost of every pass (tables 4.5 and 4.6, figure 4.3)",
          .scenes = thesisScenes(),
          .full = {.sizes = {{800, 600}, {1600, 1200}}, .cameras = 5, .rounds = 2},
          .quick = {.sizes = {{320, 240}, {640, 480}}, .cameras = 1, .rounds = 2},
          .measure = measure,
          .report = report};
}

}  // namespace lucerna::app::bench
