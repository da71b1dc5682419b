// Tables 4.7 and 4.8: SRAA's samples and filter, and supersampling against SRAA; beside them how
// far each is from a picture of sixteen samples a pixel.
#include "app/bench/suite.hpp"
#include "app/resample.hpp"
#include "image/metrics.hpp"

namespace lucerna::app::bench {
namespace {

// As in the passes suite: shares of the sight.
constexpr float kAoRadius = 0.1f, kLensRadius = 0.01f;
// Of a component in 0 to 255: pixels that differ more without anti-aliasing need it.
constexpr float kAliased = 8.f;

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

Chain chainOf(const std::string& technique, const std::string& effects, float sight) {
  const bool all = effects == kEffects;
  Chain chain{{{"Cull"}, {"GBuffer"}}};
  if (all) chain.rows.push_back({"ScreenSpaceAo", {fmt::format("radius={}", kAoRadius * sight)}});
  chain.rows.insert(chain.rows.end(),
                    {{"Lighting"}, {"CustomShaders"}, {"Background"}, {"Transparency"}});
  if (technique == kSraaDepth) addSraa(chain, kDepth);
  if (technique == kSraa) addSraa(chain, kNormals);
  if (all)
    chain.rows.push_back({"DepthOfField",
                          {fmt::format("lensRadius={}", kLensRadius * sight),
                           fmt::format("focusDistance={}", sight)}});
  chain.rows.push_back({"ToneMap"});
  if (technique == kFxaa) chain.rows.push_back({"Fxaa"});
  return chain;
}

Image rgb(const Image& bytes) {
  return converted(bytes, ComponentType::F32, 3);
}

// Where the picture without anti-aliasing differs from the true one.
Image aliasedPixels(const Image& truth, const Image& none) {
  Image mask(truth.width(), truth.height(), 1, ComponentType::U8);
  const auto a = truth.as<float>(), b = none.as<float>();
  const auto pixels = mask.as<std::uint8_t>();
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(a[3 * i + c] - b[3 * i + c]) > kAliased / 255.f) pixels[i] = 255;
  return mask;
}

// What stays the same for all techniques at a camera.
struct Truth {
  Image picture;  // of sixteen samples a pixel
  Image aliased;  // which pixels need anti-aliasing
};

// kNone is seen first.
void see(Run& run, Truth& truth, const Name& name, Image picture) {
  if (name[0] != kFrame || name[2] != kPlainPicture) return;
  const Image test = rgb(resizedSrgb(std::move(picture), run.extent.sizes.front()));
  if (name[3] == kNone) truth.aliased = aliasedPixels(truth.picture, test);
  Measurement& m = run.results.at(name);
  m.count("flip", flipLdr(truth.picture, test).mean);
  m.count("edge_psnr", pixelMetrics(truth.picture, test, &truth.aliased).psnr);
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
Status addVariants(Run& run) {
  const uvec2 size = run.extent.sizes.front(), large = run.extent.sizes.back();
  const float sight = run.sight();
  for (const std::string& geometry : {kDepth, kNormals})
    LUCERNA_TRY_VOID(
        run.add({kSplit, sizeName(large), geometry, run.scene},
                {.chain = chainOf(geometry == kDepth ? kSraaDepth : kSraa, kPlainPicture, sight),
                 .size = large,
                 .profiled = true}));
  for (const std::string& effects : {kPlainPicture, kEffects})
    for (const std::string& technique : kTechniques)
      LUCERNA_TRY_VOID(run.add({kFrame, sizeName(size), effects, technique, run.scene},
                               {.chain = chainOf(technique, effects, sight),
                                .size = technique == kSupersampling ? 2u * size : size}));
  return {};
}

Status measure(Run& run) {
  LUCERNA_TRY_VOID(addVariants(run));
  const uvec2 size = run.extent.sizes.front();
  LUCERNA_TRY(sixteen, run.stage.add({.chain = chainOf(kNone, kPlainPicture, run.sight()),
                                      .size = 4u * size}));
  Truth truth;
  return run.takeTurnsEverywhere(
      {.prepare = [&]() -> Status {
         Image fine;
         LUCERNA_TRY_VOID(run.stage.draw(sixteen, &fine));
         truth.picture = rgb(resizedSrgb(std::move(fine), size));
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
                   return numberText(spreadOf(samples).median + spreadOf(filter).median);
                 });
}

Table framesTable(const Results& results, const std::string& size, const std::string& effects) {
  const std::string ratio = "4x supersampling / SRAA";
  std::vector<std::string> columns = kTechniques;
  columns.push_back(ratio);
  const auto times = [&](const std::string& technique, const std::string& scene) {
    return results.times({kFrame, size, effects, technique, scene});
  };
  return tableOf("A frame with " + effects + ", " + size + ", ms: median (quartiles)", "scene",
                 results.parts(4, {kFrame, size, effects}), columns,
                 [&](const std::string& scene, const std::string& column) {
                   return column == ratio
                              ? ratioText(times(kSupersampling, scene), times(kSraa, scene))
                              : spreadText(times(column, scene));
                 });
}

Table errorTable(const Results& results, const std::string& size, std::string title,
                 const std::string& counter) {
  return tableOf(std::move(title), "scene", results.parts(4, {kFrame, size, kPlainPicture}),
                 kTechniques, [&](const std::string& scene, const std::string& technique) {
                   return spreadText(
                       results.samples({kFrame, size, kPlainPicture, technique, scene}, counter));
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
      "Supersampling draws twice the width and height; that its picture is made smaller after that "
      "is not in its time. Effects: ScreenSpaceAo and DepthOfField.");
  for (const std::string& size : results.parts(1, {kSplit})) {
    blocks.emplace_back(splitTable(results, size));
    blocks.emplace_back(splitPlot(results, size));
  }
  for (const std::string& size : results.parts(1, {kFrame})) {
    for (const std::string& effects : {kPlainPicture, kEffects})
      blocks.emplace_back(framesTable(results, size, effects));
    blocks.emplace_back(errorTable(
        results, size, "FLIP from 16x supersampling, " + size + ": median (quartiles)", "flip"));
    blocks.emplace_back(
        errorTable(results, size,
                   fmt::format("PSNR in dB of the pixels that differ by more than {} without "
                               "anti-aliasing, {}: median (quartiles)",
                               kAliased, size),
                   "edge_psnr"));
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
