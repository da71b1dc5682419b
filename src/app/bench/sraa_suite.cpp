// Tables 4.7 and 4.8: SRAA's samples and filter, and supersampling against SRAA; beside them how
// far each is from a picture of sixteen samples a pixel.
#include <algorithm>

#include "app/bench/suite.hpp"
#include "app/bench/supersampling.hpp"
#include "image/metrics.hpp"

namespace lucerna::app::bench {
namespace {

// As in the passes suite: shares of the sight.
constexpr float kAoRadius = 0.1f, kLensRadius = 0.01f;

const std::string kDepth = "depth", kNormals = "depth+normal";
const std::string kNone = "none", kFxaa = "Fxaa", kSraaDepth = "SRAA, depth",
                  kSraa = "SRAA, depth+normal", kSupersampling = "4x supersampling";
const std::vector<std::string> kTechniques{kNone, kFxaa, kSraaDepth, kSraa, kSupersampling};
const std::string kPlainPicture = "no effects", kEffects = "AO and depth of field";

// Names of the two kinds of measurement: {"split", size, geometry, row, scene} and {"frame", size,
// effects, technique, scene}.
const std::string kSplit = "split", kFrame = "frame";

void addSraa(Chain& chain, const std::string& geometry) {
  chain.rows.push_back({"GeometrySamples", {"geometry=" + geometry}});
  chain.rows.push_back({"Sraa"});
}

// SRAA mixes what the eye sees, which ToneMap makes; effects behind it want smooth edges already.
Chain chainOf(const std::string& technique, const std::string& effects) {
  const bool all = effects == kEffects;
  const auto smooth = [&](Chain& chain) {
    if (technique == kSraaDepth) addSraa(chain, kDepth);
    if (technique == kSraa) addSraa(chain, kNormals);
  };
  Chain chain{{{"Cull"}, {"GBuffer"}}};
  if (all) chain.rows.push_back({"ScreenSpaceAo", {}, {{"radius", kAoRadius}}});
  chain.rows.insert(
      chain.rows.end(),
      {{"TiledLighting"}, {"CustomShaders"}, {"Background"}, {"Mirrors"}, {"Transparency"}});
  if (all) {
    smooth(chain);
    chain.rows.push_back(
        {"DepthOfField", {}, {{"lensRadius", kLensRadius}, {"focusDistance", 1.f}}});
  }
  chain.rows.push_back({"ToneMap"});
  if (!all) smooth(chain);
  if (technique == kFxaa) chain.rows.push_back({"Fxaa"});
  return chain;
}

// What stays the same for all techniques at a camera.
struct Truth {
  Image picture;  // of sixteen samples a pixel
  Image edges;    // pixels that hold an edge of a surface
};

void see(Run& run, const Truth& truth, const Name& name, const Image& picture) {
  if (name[0] != kFrame || name[2] != kPlainPicture) return;
  const Image test = meanOfSamples(picture, run.extent.sizes.front());
  Measurement& m = run.results.at(name);
  m.count("flip", flipLdr(truth.picture, test).mean);
  if (std::ranges::max(truth.edges.as<std::uint8_t>()) > 0)
    m.count("edge_psnr", pixelMetrics(truth.picture, test, &truth.edges).psnr);
}

void take(Run& run, const Name& name, const Sample& sample) {
  if (name[0] == kFrame) {
    run.results.at(name).add(sample.realMs, sample.cpuMs);
    return;
  }
  for (const graph::StepProfile& step : sample.profile.steps)
    if (step.row == "GeometrySamples" || step.row == "Sraa") {
      Name full = name;
      full.insert(full.end() - 1, step.row);
      run.results.at(full).add(step.gpuMs, step.cpuMs);
    }
}

// The first size is that of whole frames and pictures, the last that of the split.
void addVariants(Run& run) {
  const uvec2 size = run.extent.sizes.front(), large = run.extent.sizes.back();
  for (const std::string& geometry : {kDepth, kNormals})
    run.add({kSplit, sizeName(large), geometry, run.scene},
            {.chain = chainOf(geometry == kDepth ? kSraaDepth : kSraa, kPlainPicture),
             .size = large,
             .profiled = true});
  for (const std::string& effects : {kPlainPicture, kEffects})
    for (const std::string& technique : kTechniques)
      run.add({kFrame, sizeName(size), effects, technique, run.scene},
              {.chain = chainOf(technique, effects),
               .size = technique == kSupersampling ? 2u * size : size});
}

// Draws sixteen samples a pixel.
class TruthMaker {
 public:
  static Result<TruthMaker> of(Run& run) {
    const uvec2 size = 4u * run.extent.sizes.front();
    LUCERNA_TRY(picture, run.stage.add({.chain = chainOf(kNone, kPlainPicture), .size = size}));
    LUCERNA_TRY(depth,
                run.stage.add({.chain = {{{"Cull"}, {"GBuffer"}}, "GBuffer.depth"}, .size = size}));
    return TruthMaker{picture, depth};
  }

  Result<Truth> draw(Run& run) const {
    const uvec2 size = run.extent.sizes.front();
    Image picture, depth;
    LUCERNA_TRY_VOID(run.stage.draw(picture_, &picture));
    LUCERNA_TRY_VOID(run.stage.draw(depth_, &depth));
    return Truth{.picture = meanOfSamples(picture, size),
                 .edges = edgesOfSamples(depth, run.stage.view(size), size)};
  }

 private:
  TruthMaker(std::size_t picture, std::size_t depth) : picture_(picture), depth_(depth) {}
  std::size_t picture_, depth_;  // of the stage's variants
};

Status measure(Run& run) {
  addVariants(run);
  LUCERNA_TRY(maker, TruthMaker::of(run));
  Truth truth;
  return run.takeTurnsEverywhere(
      {.prepare = [&]() -> Status {
         LUCERNA_TRY(drawn, maker.draw(run));
         truth = std::move(drawn);
         return {};
       },
       .take = [&](const Name& name, const Sample& sample) { take(run, name, sample); },
       .see = [&](const Name& name, const Image& picture) { see(run, truth, name, picture); }});
}

Table splitTable(const Results& results, const std::string& size) {
  const std::vector<std::string> columns{"samples, depth",  "samples, depth+normal",
                                         "filter, depth",   "filter, depth+normal",
                                         "together, depth", "together, depth+normal"};
  const auto times = [&](const std::string& geometry, const char* row, const std::string& scene) {
    return results.times({kSplit, size, geometry, row, scene});
  };
  return tableOf("SRAA split, " + size + ", ms: median (quartiles)", "scene",
                 results.parts(4, {kSplit, size}), columns,
                 [&](const std::string& scene, const std::string& column) {
                   const std::string geometry = column.ends_with(kNormals) ? kNormals : kDepth;
                   const auto samples = times(geometry, "GeometrySamples", scene);
                   const auto filter = times(geometry, "Sraa", scene);
                   if (column.starts_with("samples")) return spreadText(samples);
                   if (column.starts_with("filter")) return spreadText(filter);
                   if (samples.empty() || filter.empty()) return std::string("-");
                   return numberText(spreadOf(samples).median + spreadOf(filter).median);
                 });
}

Table framesTable(const Results& results, const std::string& size, const std::string& effects) {
  const std::string ratio = "4x supersampling / SRAA, depth+normal";
  std::vector<std::string> columns = kTechniques;
  columns.push_back(ratio);
  const auto name = [&](const std::string& technique, const std::string& scene) {
    return Name{kFrame, size, effects, technique, scene};
  };
  return tableOf("A frame with " + effects + ", " + size + ", ms: median (quartiles)", "scene",
                 results.parts(4, {kFrame, size, effects}), columns,
                 [&](const std::string& scene, const std::string& column) {
                   return column == ratio ? ratioText(results.ratios(name(kSupersampling, scene),
                                                                     name(kSraa, scene)))
                                          : spreadText(results.times(name(column, scene)));
                 });
}

Table errorTable(const Results& results, const std::string& size, std::string title,
                 const std::string& counter, double Spread::* worst) {
  return tableOf(std::move(title), "scene", results.parts(4, {kFrame, size, kPlainPicture}),
                 kTechniques, [&](const std::string& scene, const std::string& technique) {
                   return worstText(
                       results.samples({kFrame, size, kPlainPicture, technique, scene}, counter),
                       worst);
                 });
}

BarPlot splitPlot(const Results& results, const std::string& size) {
  BarPlot plot{.title = "SRAA split, " + size, .unit = "ms", .parts = {"GeometrySamples", "Sraa"}};
  for (const std::string& scene : results.parts(4, {kSplit, size}))
    for (const std::string& geometry : {kDepth, kNormals}) {
      plot.rows.push_back(fmt::format("{}, {}", scene, geometry));
      std::vector<double>& values = plot.values.emplace_back();
      for (const std::string& row : plot.parts)
        values.push_back(spreadOf(results.times({kSplit, size, geometry, row, scene})).median);
    }
  return plot;
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(
      "Supersampling draws twice the width and height; that the mean of its pixels is taken after "
      "that is not in its time. Effects: ScreenSpaceAo and DepthOfField. The truth is the plain "
      "mean of 4x4 samples a pixel; edges are the pixels whose samples see the distance jump or "
      "surfaces meet.");
  for (const std::string& size : results.parts(1, {kSplit})) {
    blocks.emplace_back(splitTable(results, size));
    blocks.emplace_back(splitPlot(results, size));
  }
  for (const std::string& size : results.parts(1, {kFrame})) {
    for (const std::string& effects : {kPlainPicture, kEffects})
      blocks.emplace_back(framesTable(results, size, effects));
    blocks.emplace_back(errorTable(
        results, size, "FLIP from 16 samples a pixel, " + size + ": median (worst camera)", "flip",
        &Spread::max));
    blocks.emplace_back(errorTable(
        results, size, "PSNR in dB of the pixels with edges, " + size + ": median (worst camera)",
        "edge_psnr", &Spread::min));
  }
  return blocks;
}

}  // namespace

Suite sraaSuite() {
  return {.name = "sraa",
          .title = "SRAA split, and against supersampling (tables 4.7 and 4.8)",
          .scenes = thesisScenes(),
          .full = {.sizes = {{800, 600}, {1600, 1200}}, .cameras = 20, .rounds = 1},
          .quick = {.sizes = {{320, 240}, {640, 480}}, .cameras = 1, .rounds = 1},
          .measure = measure,
          .report = report};
}

}  // namespace lucerna::app::bench
