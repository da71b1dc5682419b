// Figure 4.5: what shadow maps of a size cost and how far they are from traced shadows.
#include "app/bench/suite.hpp"
#include "image/metrics.hpp"
#include "trace/reference.hpp"

namespace lucerna::app::bench {
namespace {

const std::vector<std::string> kMethods{"uniform", "lispsm", "cascades"};

std::vector<std::string> mapSizes(const Results& results) {
  std::vector<std::string> sizes{"512", "1024", "2048", "4096", "8192"};
  if (results.context.quick) sizes.resize(3);
  return sizes;
}

Chain chainOf(const std::string& method, const std::string& size) {
  return {{{"Cull"},
           {"GBuffer"},
           {"ShadowMaps", {"method=" + method, "size=" + size, "redraw=always"}},
           {"TiledLighting"},
           {"Background"},
           {"ToneMap", {"operator=linear"}}}};
}

// Shadows are hard, for the sun has no size, and exact: one ray decides a pixel.
Result<Image> traced(const Run& run) {
  const uvec2 size = run.extent.sizes.front();
  const trace::ReferencePicture picture =
      trace::renderReference(run.stage.scene(), {.size = size,
                                                 .view = run.stage.view(size),
                                                 .samples = 1,
                                                 .primary = trace::Primary::Centre,
                                                 .mirrors = 0});
  if (picture.cancelled) return error(ErrorKind::Cancelled, "cancelled while tracing");
  return asShown(picture.color);
}

// ShadowMaps and TiledLighting together: a better map may cost in either.
void addTimes(Measurement& m, const graph::FrameProfile& profile) {
  double real = 0, cpu = 0, maps = 0;
  for (const graph::StepProfile& step : profile.steps) {
    if (step.row != "ShadowMaps" && step.row != "TiledLighting") continue;
    real += step.gpuMs;
    cpu += step.cpuMs;
    if (step.row == "ShadowMaps") maps = step.gpuMs;
  }
  m.add(real, cpu);
  m.count("maps_ms", maps);
}

// Measurements are named by method, size of the map, and scene.
Status measure(Run& run) {
  for (const std::string& mapSize : mapSizes(run.results))
    for (const std::string& method : kMethods)
      run.add(
          {method, mapSize, run.scene},
          {.chain = chainOf(method, mapSize), .size = run.extent.sizes.front(), .profiled = true});
  Image truth;
  return run.takeTurnsEverywhere(
      {.prepare = [&]() -> Status {
         LUCERNA_TRY(picture, traced(run));
         truth = std::move(picture);
         return {};
       },
       .take = [&](const Name& name,
                   const Sample& sample) { addTimes(run.results.at(name), sample.profile); },
       .see =
           [&](const Name& name, const Image& picture) {
             const Image test = converted(picture, ComponentType::F32, 3);
             Measurement& m = run.results.at(name);
             m.count("flip", flipLdr(truth, test).mean);
             m.count("psnr", pixelMetrics(truth, test).psnr);
           }});
}

// What the thesis says of figure 4.5: lispsm at 2048 is better than uniform maps at 8192.
Table thesisTable(const Results& results, const std::vector<std::string>& scenes) {
  const std::string lispsm = "lispsm at 2048", uniform = "uniform at " + mapSizes(results).back();
  const std::string ratio = "median of the cameras' ratios", better = lispsm + " is better at";
  return tableOf(
      "FLIP, " + lispsm + " against " + uniform, "scene", scenes, {lispsm, uniform, ratio, better},
      [&](const std::string& scene, const std::string& column) {
        const auto own = results.samples({"lispsm", "2048", scene}, "flip");
        const auto other = results.samples({"uniform", mapSizes(results).back(), scene}, "flip");
        if (column == lispsm) return worstText(own);
        if (column == uniform) return worstText(other);
        if (column == ratio) return ratioText(pairedRatios(own, other));
        if (own.size() != other.size()) return std::string("-");
        std::size_t cameras = 0;
        for (std::size_t i = 0; i < own.size(); ++i) cameras += own[i] < other[i];
        return fmt::format("{} of {} cameras", cameras, own.size());
      });
}

Table ratioTable(const Results& results, const std::vector<std::string>& sizes) {
  return tableOf("Time against uniform of the same size, all scenes: median of the ratios", "size",
                 sizes, kMethods, [&](const std::string& size, const std::string& method) {
                   return ratioText(results.ratios({method, size}, {"uniform", size}));
                 });
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(
      "Time of ShadowMaps and TiledLighting together in ms, and the distance of the picture "
      "from a traced one with the same hard shadows of the sun; all surfaces are plain. Over all "
      "cameras. A map of cascades is one of four.");
  const std::vector<std::string> sizes = mapSizes(results), scenes = results.parts(2);
  blocks.emplace_back(tableOf("ms, all scenes: median (quartiles)", "size", sizes, kMethods,
                              [&](const std::string& size, const std::string& method) {
                                return spreadText(results.times({method, size}));
                              }));
  blocks.emplace_back(tableOf("Of it ShadowMaps alone", "size", sizes, kMethods,
                              [&](const std::string& size, const std::string& method) {
                                return spreadText(results.samples({method, size}, "maps_ms"));
                              }));
  blocks.emplace_back(ratioTable(results, sizes));
  blocks.emplace_back(thesisTable(results, scenes));
  for (const std::string& scene : scenes)
    blocks.emplace_back(tableOf("FLIP, " + scene + ": median (worst camera)", "size", sizes,
                                kMethods, [&](const std::string& size, const std::string& method) {
                                  return worstText(results.samples({method, size, scene}, "flip"));
                                }));
  blocks.emplace_back(tableOf("PSNR in dB, all scenes: median (worst camera)", "size", sizes,
                              kMethods, [&](const std::string& size, const std::string& method) {
                                return worstText(results.samples({method, size}, "psnr"),
                                                 &Spread::min);
                              }));
  const std::string side = "px, side of the map";
  blocks.emplace_back(medianPlot({.title = "Time against size, all scenes",
                                  .xLabel = side,
                                  .yLabel = "ms",
                                  .logarithmic = true},
                                 kMethods, sizes,
                                 [&](const std::string& method, const std::string& size) {
                                   return results.times({method, size});
                                 }));
  blocks.emplace_back(medianPlot({.title = "Error against size, all scenes",
                                  .xLabel = side,
                                  .yLabel = "FLIP",
                                  .logarithmic = true},
                                 kMethods, sizes,
                                 [&](const std::string& method, const std::string& size) {
                                   return results.samples({method, size}, "flip");
                                 }));
  return blocks;
}

}  // namespace

Suite shadowSizeSuite() {
  return {.name = "shadow-size",
          .title = "shadow maps, time and error against their size (figure 4.5)",
          .scenes = {{.name = "nightcity",
                      .path = "builtin:nightcity",
                      .elevationDegrees = 8,
                      .azimuthDegrees = 40,
                      .eyeHeight = 1.7f},
                     {.name = "atrium", .path = "builtin:atrium"},
                     {.name = "materials", .path = "builtin:materials"},
                     {.name = "street-1", .path = "torcs_street-1/street-1.gltf", .outside = true},
                     {.name = "sponza",
                      .path = "crytek_sponza/gltf/sponza.gltf",
                      .outside = true,
                      .elevationDegrees = 75},
                     {.name = "institute",
                      .path = "redeclipse_institute/institute.obj",
                      .outside = true}},
          .full = {.sizes = {{480, 270}}, .cameras = 20, .rounds = 1},
          .quick = {.sizes = {{320, 180}}, .cameras = 2, .rounds = 1},
          .surfaces = Surfaces::Plain,
          .measure = measure,
          .report = report};
}

}  // namespace lucerna::app::bench
