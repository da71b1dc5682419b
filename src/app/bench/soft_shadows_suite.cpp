// Tables 1 and 2 of system C: frames with soft shadows by method, kernel, size and number of
// lights; what they look up and hold; and where their time goes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/bench/lights_per_pixel.hpp"
#include "app/bench/shadow_methods.hpp"
#include "app/bench/suite.hpp"

namespace lucerna::app::bench {
namespace {

constexpr uvec2 kCounted{160, 90};  // px at which lights are counted
constexpr uvec2 kSmall{640, 360}, kMiddle{1280, 720}, kLarge{1920, 1080};

// Whether maps are drawn in every frame.
const std::string kRedrawn = "redrawn", kKept = "kept";
const std::array kMaps{kRedrawn, kKept};
const std::string kStep = "step_";  // before a row's name: its ms

const std::string kAlone = "lighting alone", kHard = "hard", kPcss = "pcss 5+11",
                  kWidePcss = "pcss 5+23", kLayered = "layered 11", kWideLayered = "layered 23",
                  kWidestLayered = "layered 47";
// Where not all methods are drawn: by number of lights, and quickly.
const std::vector<std::string> kMain{kAlone, kHard, "pcf 11", kPcss, "prefiltered", kLayered};
const std::vector<std::string> kOfBars{kAlone,   kHard,        kPcss,         kWidePcss,
                                       kLayered, kWideLayered, kWidestLayered};

std::string ofLights(int count) {
  return fmt::format("{} light{}", count, count == 1 ? "" : "s");
}

// One of the scenes that differ in the number of their lights only.
bool isSeries(const std::string& scene) {
  return scene.ends_with(" lights") || scene == ofLights(1);
}

// The hall of table 1, and one with point lights that reach so far only that the spheres which they
// light fit four layers, as in system C.
const std::string kHall = "16 lights", kApart = "16 lights apart";
// Where all methods are compared; elsewhere the main ones.
bool hasTable(const std::string& scene) {
  return !isSeries(scene) || scene == kHall || scene == ofLights(4);
}

SceneChoice hallOf(int lights, std::vector<uvec2> sizes, std::vector<uvec2> quickSizes) {
  return {.name = ofLights(lights),
          .path = fmt::format("builtin:atrium?lights={}", lights),
          .sizes = std::move(sizes),
          .quickSizes = std::move(quickSizes)};
}

SceneChoice onlyInFull(SceneChoice scene) {
  scene.quick = false;
  return scene;
}

std::vector<SceneChoice> scenes() {
  const std::vector<uvec2> all{kSmall, kMiddle, kLarge}, small{kSmall}, both{kSmall, kLarge},
      spots{kSmall, kMiddle};
  return {hallOf(16, all, all),
          {.name = kApart,
           .path = "builtin:atrium?kind=point&reach=5",
           .sizes = {kMiddle, kLarge},
           .quickSizes = {kLarge}},
          hallOf(1, all, spots),
          hallOf(4, all, all),
          onlyInFull(hallOf(8, both, {})),
          onlyInFull(hallOf(12, both, {})),
          onlyInFull(hallOf(32, small, {})),
          hallOf(64, spots, spots)};
}

std::vector<std::string> methodsFor(const Run& run, uvec2 size) {
  const bool quick = run.results.context.quick;
  if (!hasTable(run.scene) || size == kSmall || (quick && size == kMiddle)) return kMain;
  return quick ? kOfBars : shadowMethodNames();
}

Variant variantOf(const Run& run, const std::string& method, const std::string& maps, uvec2 size) {
  ShadowFrame frame{.afterLighting = {{"Background"}, {"ToneMap"}}};
  if (run.scene == kApart) {
    frame.mapSize = 512;  // of six for each light
    frame.conflicts = "spheres";
  }
  Variant variant{.chain = chainOf(shadowMethod(method), frame), .size = size};
  if (shadowMethod(method).shadows())
    variant.settings = {{"ShadowMaps", "redraw", maps == kRedrawn ? "always" : "changed"}};
  return variant;
}

void countFrame(Measurement& m, const Sample& sample) {
  m.count("texture_mib", static_cast<double>(sample.textureBytes) / (1 << 20));
  m.count("shadow_texels", static_cast<double>(sample.shadowTexels));
  m.count("layers", sample.shadowLayers);
  m.count("lights_beyond", sample.lightsBeyond);
}

void countLights(Measurement& m, const std::vector<double>& lights) {
  double mean = 0;
  for (const double count : lights) mean += count / static_cast<double>(lights.size());
  const double layers = m.samples("layers").back();
  m.count("taps", shadowMethod(m.name[2]).taps.at(mean, static_cast<int>(layers)));
  m.count("lights_median", quantileOf(lights, 0.5));
  m.count("lights_p99", quantileOf(lights, 0.99));
}

// Where the time of frames goes whose maps are redrawn, and what they look up, hold and draw.
// lights: that reach each pixel.
Status measureOnce(Run& run, const Name& name, const Variant& redrawn,
                   const std::vector<double>& lights) {
  Variant variant = redrawn;
  variant.profiled = true;
  LUCERNA_TRY(number, run.stage.add(variant));
  Measurement& m = run.results.at(name);
  for (int round = 0; round < run.extent.rounds; ++round) {
    LUCERNA_TRY(sample, run.stage.draw(number));
    for (const graph::StepProfile& step : sample.profile.steps)
      m.count(kStep + step.row, step.gpuMs);
    if (round == 0) countFrame(m, sample);
  }
  countLights(m, lights);
  return {};
}

Status measureSize(Run& run, uvec2 size, const std::vector<double>& lights, double share) {
  const auto nameOf = [&](const std::string& method, const std::string& maps) {
    return Name{sizeName(size), maps, method, run.scene};
  };
  const std::vector<std::string> methods = methodsFor(run, size);
  for (const std::string& method : methods)
    for (const std::string& maps : kMaps)
      run.add(nameOf(method, maps), variantOf(run, method, maps, size));
  LUCERNA_TRY_VOID(
      run.takeTurns({.take =
                         [&](const Name& name, const Sample& sample) {
                           Measurement& m = run.results.at(name);
                           m.add(sample.realMs, sample.cpuMs);
                           m.count("draws", static_cast<double>(sample.counters.draws));
                           m.count("primitives", static_cast<double>(sample.counters.primitives));
                         }},
                    share));
  for (const std::string& method : methods)
    if (const Name name = nameOf(method, kRedrawn); run.results.find(name))
      LUCERNA_TRY_VOID(measureOnce(run, name, variantOf(run, method, kRedrawn, size), lights));
  run.clear();
  return {};
}

// Measurements are named by size, maps, method and scene.
Status measure(Run& run) {
  const double share = 1.0 / static_cast<double>(run.cameras.size() * run.extent.sizes.size());
  for (const SeededCamera& camera : run.cameras) {
    LUCERNA_TRY_VOID(run.stage.look(camera.pose));
    const std::vector<double> lights =
        lightsPerPixel(run.stage.scene(), run.stage.view(kCounted), kCounted);
    for (const uvec2 size : run.extent.sizes)
      LUCERNA_TRY_VOID(measureSize(run, size, lights, share));
  }
  return {};
}

// In the order in which they are listed.
std::vector<std::string> methodsOf(const Results& results, const std::string& size,
                                   const std::string& scene = "") {
  const std::vector<std::string> measured = results.parts(2, {size});
  std::vector<std::string> methods = shadowMethodNames();
  std::erase_if(methods, [&](const std::string& method) {
    return scene.empty() ? std::ranges::find(measured, method) == measured.end()
                         : !results.find({size, kRedrawn, method, scene});
  });
  return methods;
}

std::vector<std::string> scenesOf(const Results& results, const std::string& size) {
  std::vector<std::string> scenes = results.parts(3, {size});
  std::ranges::stable_sort(scenes, {}, [](const std::string& scene) {
    return isSeries(scene) ? std::stoi(scene) : std::numeric_limits<int>::max();
  });
  return scenes;
}

Table timesTable(const Results& results, const std::string& size, const std::string& maps) {
  return tableOf(fmt::format("{}, maps {}, ms: median (quartiles)", size, maps), "method",
                 methodsOf(results, size), scenesOf(results, size),
                 [&](const std::string& method, const std::string& scene) {
                   return spreadText(results.times({size, maps, method, scene}));
                 });
}

std::string countText(double count) {
  return count == std::round(count) ? fmt::format("{:.0f}", count) : numberText(count);
}

double medianOf(const Results& results, const Name& name, const std::string& counter) {
  return spreadOf(results.samples(name, counter)).median;
}

// What a frame holds and draws.
struct Count {
  std::string head, maps, counter;
  double scale = 1;
};
const std::vector<Count> kCounts{{"taps a pixel", kRedrawn, "taps"},
                                 {"texels of maps, millions", kRedrawn, "shadow_texels", 1e-6},
                                 {"layers", kRedrawn, "layers"},
                                 {"lights beyond them", kRedrawn, "lights_beyond"},
                                 {"textures, MiB", kRedrawn, "texture_mib"},
                                 {"draws, redrawn", kRedrawn, "draws"},
                                 {"draws, kept", kKept, "draws"}};

Table countsTable(const Results& results, const std::string& size, const std::string& scene) {
  Table table{.title = fmt::format("What frames hold and draw, {}, {}", size, scene),
              .head = {"method"}};
  for (const Count& count : kCounts) table.head.push_back(count.head);
  for (const std::string& method : methodsOf(results, size, scene)) {
    std::vector<std::string>& row = table.rows.emplace_back(std::vector<std::string>{method});
    for (const Count& count : kCounts)
      row.push_back(countText(count.scale *
                              medianOf(results, {size, count.maps, method, scene}, count.counter)));
  }
  return table;
}

Table overlapTable(const Results& results, const std::string& size) {
  const std::string median = "lights that reach a pixel, median", most = "99th percentile",
                    layers = "layers", beyond = "lights beyond them", taps = "taps, ";
  return tableOf("How lights overlap, " + size, "scene", scenesOf(results, size),
                 {median, most, layers, beyond, taps + kPcss, taps + kLayered},
                 [&](const std::string& scene, const std::string& column) {
                   const auto value = [&](const std::string& method, const std::string& counter) {
                     return numberText(medianOf(results, {size, kRedrawn, method, scene}, counter));
                   };
                   if (column == median) return value(kLayered, "lights_median");
                   if (column == most) return value(kLayered, "lights_p99");
                   if (column == layers) return value(kLayered, "layers");
                   if (column == beyond) return value(kLayered, "lights_beyond");
                   return value(column.substr(taps.size()), "taps");
                 });
}

BarPlot stepsPlot(const Results& results, const std::string& size, const std::string& scene) {
  BarPlot plot{.title = fmt::format("Where a frame with maps redrawn goes, {}, {}", size, scene),
               .unit = "ms",
               .rows = methodsOf(results, size, scene)};
  for (const std::string& method : plot.rows)
    for (const Counter& counter : results.find({size, kRedrawn, method, scene})->counters)
      if (counter.name.starts_with(kStep) &&
          std::ranges::find(plot.parts, counter.name.substr(kStep.size())) == plot.parts.end())
        plot.parts.push_back(counter.name.substr(kStep.size()));
  for (const std::string& method : plot.rows) {
    std::vector<double>& values = plot.values.emplace_back();
    for (const std::string& part : plot.parts)
      values.push_back(medianOf(results, {size, kRedrawn, method, scene}, kStep + part));
  }
  return plot;
}

Table stepsTable(const BarPlot& plot) {
  Table table{.title = plot.title + ", ms", .head = {"method"}};
  table.head.insert(table.head.end(), plot.parts.begin(), plot.parts.end());
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    table.rows.push_back({plot.rows[i]});
    for (const double ms : plot.values[i])
      table.rows.back().push_back(ms > 0 ? numberText(ms) : "-");
  }
  return table;
}

// What is wanted of frames of one method over those of another, turn by turn.
struct Bar {
  enum class Where { ManyLights, FewLayers };  // 16 lights or more; four layers or fewer
  std::string what, over, under, maps;
  double bound;
  bool atLeast;
  std::string paper;
  Where where = Where::ManyLights;
};
const std::vector<Bar> kBars{
    {"pcss / layered, kernel 11", kPcss, kLayered, kRedrawn, 1.8, true, "1.67"},
    {"pcss / layered, kernel 23", kWidePcss, kWideLayered, kRedrawn, 3, true, "2.8"},
    {"pcss / layered, kernel 11", kPcss, kLayered, kKept, 3, true, "-"},
    {"pcss / layered, kernel 23", kWidePcss, kWideLayered, kKept, 6, true, "-"},
    {"layered / hard, kernel 11", kLayered, kHard, kRedrawn, 1.3, false, "1.37"},
    {"layered, kernel 23 / 11", kWideLayered, kLayered, kRedrawn, 1.06, false, "1.11",
     Bar::Where::FewLayers},
    {"layered, kernel 47 / 11", kWidestLayered, kLayered, kRedrawn, 1.15, false, "-",
     Bar::Where::FewLayers}};

bool isWanted(const Bar& bar, const Results& results, const std::string& size,
              const std::string& scene) {
  if (bar.where == Bar::Where::ManyLights) return scene != ofLights(4);
  return medianOf(results, {size, kRedrawn, kLayered, scene}, "layers") <= 4;
}

std::string barText(double bound, bool atLeast) {
  return fmt::format("{} {:.2f}", atLeast ? "at least" : "at most", bound);
}

std::string verdict(double measured, double bound, bool atLeast) {
  return (atLeast ? measured >= bound : measured <= bound) ? "met" : "missed";
}

Table barsTable(const Results& results, const std::string& size, const std::string& scene) {
  Table table{
      .title = fmt::format("Ratios of whole frames, {}, {}: median (quartiles)", size, scene),
      .head = {"frames", "maps", "measured", "wanted", "", "system C, on its GPU"}};
  for (const Bar& bar : kBars) {
    const std::vector<double> ratios =
        results.ratios({size, bar.maps, bar.over, scene}, {size, bar.maps, bar.under, scene});
    if (ratios.empty()) continue;
    const bool wanted = isWanted(bar, results, size, scene);
    table.rows.push_back(
        {bar.what, bar.maps, spreadText(ratios), wanted ? barText(bar.bound, bar.atLeast) : "-",
         wanted ? verdict(spreadOf(ratios).median, bar.bound, bar.atLeast) : "-", bar.paper});
  }
  return table;
}

std::vector<std::string> seriesOf(const Results& results, const std::string& size) {
  std::vector<std::string> scenes = scenesOf(results, size);
  std::erase_if(scenes, [](const std::string& scene) { return !isSeries(scene); });
  return scenes;
}

double slopeFor(const Results& results, const std::string& size, const std::string& maps,
                const std::string& method) {
  std::vector<glm::dvec2> points;
  for (const std::string& scene : seriesOf(results, size))
    if (const auto times = results.times({size, maps, method, scene}); !times.empty())
      points.emplace_back(std::stoi(scene), spreadOf(times).median);
  return slopeOf(points);
}

constexpr double kSlopeBound = 0.4;

Table slopesTable(const Results& results, const std::string& size) {
  const std::vector<std::string> scenes = seriesOf(results, size);
  Table table{.title = fmt::format("{}: ms for one light more, least squares over {} to {}", size,
                                   scenes.front(), scenes.back()),
              .head = {"maps", kPcss, kLayered, "layered / pcss", "wanted", ""}};
  for (const std::string& maps : kMaps) {
    const double pcss = slopeFor(results, size, maps, kPcss),
                 layered = slopeFor(results, size, maps, kLayered), ratio = layered / pcss;
    table.rows.push_back({maps, numberText(pcss), numberText(layered), fmt::format("{:.2f}", ratio),
                          barText(kSlopeBound, false), verdict(ratio, kSlopeBound, false)});
  }
  return table;
}

LinePlot seriesPlot(const Results& results, const std::string& size, const std::string& maps) {
  LinePlot plot{.title = fmt::format("Frames by number of lights, {}, maps {}", size, maps),
                .xLabel = "lights",
                .yLabel = "ms"};
  for (const std::string& method : kMain) {
    Curve& curve = plot.curves.emplace_back(Curve{.name = method});
    for (const std::string& scene : seriesOf(results, size))
      if (const auto times = results.times({size, maps, method, scene}); !times.empty())
        curve.points.emplace_back(std::stoi(scene), spreadOf(times).median);
  }
  return plot;
}

const std::string kText =
    "Whole frames with the maps of all lights redrawn, and with maps that are kept as nothing "
    "moves. 'pcss 5+11' searches 5 x 5 depths and compares 11 x 11; 'layered 11' blurs by 11 taps "
    "an "
    "axis, as the pipeline of that name: blockers by a minimum filter, layers of half the size; "
    "'search' searches 5 x 5 depths instead, 'full' has layers of the picture's size, 'published' "
    "is system C with its faults, 'exponential' blurs a byte of each layer in place of its bit, "
    "'sampled' looks widths up in the blur. Scenes are builtin:atrium with that many spot lights; "
    "'16 lights apart' has point lights that reach 5 m instead, so that their shadows fit four "
    "layers by the spheres that they light, as in system C. Taps are looks into shadow maps, masks "
    "and layers, worked out from the method and from how many lights reach a pixel in the mean, "
    "whatever early ends spare; a filtered comparison counts as one.";

void addBars(const Results& results, std::vector<Block>& blocks) {
  for (const std::string& size : results.parts(0))
    for (const std::string& scene : scenesOf(results, size))
      if (results.find({size, kRedrawn, kWidePcss, scene}))
        blocks.emplace_back(barsTable(results, size, scene));
  for (const std::string& size : results.parts(0))
    if (seriesOf(results, size).size() > 1) blocks.emplace_back(slopesTable(results, size));
}

void addSize(const Results& results, const std::string& size, std::vector<Block>& blocks) {
  for (const std::string& maps : kMaps) blocks.emplace_back(timesTable(results, size, maps));
  if (seriesOf(results, size).size() > 1)
    for (const std::string& maps : kMaps) blocks.emplace_back(seriesPlot(results, size, maps));
  blocks.emplace_back(overlapTable(results, size));
  const std::vector<std::string> scenes = scenesOf(results, size);
  for (const std::string& scene : scenes) {
    const bool ofTable = results.find({size, kRedrawn, kWidePcss, scene});
    if (!ofTable && scene != scenes.back()) continue;
    blocks.emplace_back(countsTable(results, size, scene));
    const BarPlot plot = stepsPlot(results, size, scene);
    blocks.emplace_back(stepsTable(plot));
    blocks.emplace_back(plot);
  }
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks{kText};
  addBars(results, blocks);
  for (const std::string& size : results.parts(0)) addSize(results, size, blocks);
  return blocks;
}

}  // namespace

Suite softShadowsSuite() {
  return {.name = "soft-shadows",
          .title = "soft shadows, time by method, kernel and lights (tables 1 and 2 of system C)",
          .scenes = scenes(),
          .full = {.sizes = {kMiddle, kLarge}, .cameras = 1, .rounds = 5},
          .quick = {.sizes = {kLarge}, .cameras = 1, .rounds = 3},
          .lighting = Lighting::Own,
          .places = Places::Own,
          .surfaces = Surfaces::Plain,
          .measure = measure,
          .report = report};
}

}  // namespace lucerna::app::bench
