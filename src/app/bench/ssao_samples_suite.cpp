// Figure 4.4: time of screen-space ambient occlusion against samples, beside its error: the mean
// squared difference from ambient occlusion traced at the same pixels.
#include "app/bench/suite.hpp"
#include "trace/reference.hpp"

namespace lucerna::app::bench {
namespace {

const Length kRadius{"radius", 0.1f};
constexpr int kTraced = 256;  // directions a pixel

// A method and the blur that the sweep below found best for it.
struct Method {
  std::string name, blur;
  std::string label(const std::string& withBlur) const { return name + ", " + withBlur; }
  std::string label() const { return label(blur); }
};
const std::vector<Method> kMethods{
    {"horizon", "bilateral"}, {"hemisphere", "bilateral"}, {"gaussian", "bilateral"}};
const std::vector<std::string> kSamples{"4", "8", "16", "25", "36", "64"};
const std::vector<std::string> kBlurs{"bilateral", "box", "none"};
const std::string kSuffice = "25";  // samples, as the thesis says; at which blurs are compared

// Measurements are named by label, samples and scene.
void add(Run& run, const Method& method, const std::string& blur, const std::string& samples) {
  run.add({method.label(blur), samples, run.scene},
          {.chain = {{{"Cull"},
                      {"GBuffer"},
                      {"ScreenSpaceAo",
                       {"method=" + method.name, "blur=" + blur, "samples=" + samples},
                       {kRadius}}},
                     "ScreenSpaceAo.ambientVisibility"},
           .size = run.extent.sizes.front(),
           .profiled = true});
}

Result<Image> traced(const Run& run) {
  const uvec2 size = run.extent.sizes.front();
  const trace::ReferencePicture picture = trace::renderReference(
      run.stage.scene(),
      {.size = size,
       .view = run.stage.view(size),
       .samples = kTraced,
       .primary = trace::Primary::Centre,
       .shadows = false,
       .mirrors = 0,
       .aoRadius = static_cast<float>(run.stage.length("ScreenSpaceAo", kRadius))});
  if (picture.cancelled) return error(ErrorKind::Cancelled, "cancelled while tracing");
  return picture.ao;
}

double meanSquaredError(const Image& truth, const Image& picture) {
  const Image test = converted(picture, ComponentType::F32, 1);
  const auto a = truth.as<float>(), b = test.as<float>();
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto difference = static_cast<double>(a[i] - b[i]);
    sum += difference * difference;
  }
  return sum / static_cast<double>(a.size());
}

Status measure(Run& run) {
  for (const Method& method : kMethods) {
    for (const std::string& samples : kSamples) add(run, method, method.blur, samples);
    for (const std::string& blur : kBlurs)
      if (blur != method.blur) add(run, method, blur, kSuffice);
  }
  Image truth;
  return run.takeTurnsEverywhere(
      {.prepare = [&]() -> Status {
         LUCERNA_TRY(ao, traced(run));
         truth = std::move(ao);
         return {};
       },
       .take =
           [&](const Name& name, const Sample& sample) {
             const graph::StepProfile& step = sample.profile.steps.back();
             run.results.at(name).add(step.gpuMs, step.cpuMs);
           },
       .see =
           [&](const Name& name, const Image& picture) {
             run.results.at(name).count("mse", meanSquaredError(truth, picture));
           }});
}

std::string errorText(const Results& results, const Name& name) {
  return worstText(results.samples(name, "mse"));
}

// Over all cameras, of one scene or of all: points at the sample counts, of median time (x) and
// error (y), in the order of samples.
std::vector<glm::dvec2> errorOverTime(const Results& results, const Method& method,
                                      const std::string& scene) {
  std::vector<glm::dvec2> points;
  for (const std::string& samples : kSamples) {
    Name name{method.label(), samples};
    if (!scene.empty()) name.push_back(scene);
    points.emplace_back(spreadOf(results.times(name)).median,
                        spreadOf(results.samples(name, "mse")).median);
  }
  return points;
}

Table errorsAtTheSameTime(const Results& results) {
  const std::string all = "all scenes";
  std::vector<std::string> scenes = results.parts(2);
  scenes.push_back(all);
  std::vector<std::string> rows;
  for (const Method& method : kMethods) rows.push_back(method.name);
  return tableOf(
      fmt::format(
          "MSE in the time of the hemisphere's {} samples (against the hemisphere's); -: no "
          "number of samples takes that long",
          kSuffice),
      "scene", scenes, rows, [&](const std::string& scene, const std::string& name) -> std::string {
        const auto method = std::ranges::find(kMethods, name, &Method::name);
        const auto hemisphere = std::ranges::find(kMethods, "hemisphere", &Method::name);
        Name thesis{hemisphere->label(), kSuffice};
        if (scene != all) thesis.push_back(scene);
        const double time = spreadOf(results.times(thesis)).median;
        const auto own =
            onLogCurve(errorOverTime(results, *method, scene == all ? "" : scene), time);
        const double theirs = spreadOf(results.samples(thesis, "mse")).median;
        return own && theirs > 0 ? fmt::format("{} ({:.2f})", numberText(*own), *own / theirs)
                                 : "-";
      });
}

LinePlot errorOverTimePlot(const Results& results) {
  LinePlot plot{.title = "Error against time, median of all scenes",
                .xLabel = "ms",
                .yLabel = "MSE",
                .logarithmic = true};
  for (const Method& method : kMethods)
    plot.curves.push_back({method.label(), errorOverTime(results, method, "")});
  return plot;
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(
      fmt::format("Time of ScreenSpaceAo in ms, and the mean squared difference of its visibility "
                  "from one that is traced with {} directions a pixel from the same surfaces, all "
                  "of them plain. The radius is {} of the distance at which things are seen. Over "
                  "all cameras.",
                  kTraced, kRadius.share));
  std::vector<std::string> labels;
  std::vector<std::string> names;
  for (const Method& method : kMethods) {
    labels.push_back(method.label());
    names.push_back(method.name);
  }
  const std::vector<std::string> scenes = results.parts(2);
  blocks.emplace_back(tableOf("ms, all scenes: median (quartiles)", "samples", kSamples, labels,
                              [&](const std::string& samples, const std::string& label) {
                                return spreadText(results.times({label, samples}));
                              }));
  blocks.emplace_back(tableOf("MSE, all scenes: median (worst camera)", "samples", kSamples, labels,
                              [&](const std::string& samples, const std::string& label) {
                                return errorText(results, {label, samples});
                              }));
  blocks.emplace_back(tableOf("MSE with " + kSuffice + " samples: median (worst camera)", "method",
                              labels, scenes,
                              [&](const std::string& label, const std::string& scene) {
                                return errorText(results, {label, kSuffice, scene});
                              }));
  blocks.emplace_back(tableOf("Blurs, " + kSuffice + " samples, all scenes: MSE", "method", names,
                              kBlurs, [&](const std::string& name, const std::string& blur) {
                                const auto method =
                                    std::ranges::find(kMethods, name, &Method::name);
                                return errorText(results, {method->label(blur), kSuffice});
                              }));
  blocks.emplace_back(errorsAtTheSameTime(results));
  blocks.emplace_back(
      medianPlot({.title = "Time against samples", .xLabel = "samples", .yLabel = "ms"}, labels,
                 kSamples, [&](const std::string& label, const std::string& samples) {
                   return results.times({label, samples});
                 }));
  blocks.emplace_back(medianPlot(
      {.title = "Error against samples", .xLabel = "samples", .yLabel = "MSE", .logarithmic = true},
      labels, kSamples, [&](const std::string& label, const std::string& samples) {
        return results.samples({label, samples}, "mse");
      }));
  blocks.emplace_back(errorOverTimePlot(results));
  return blocks;
}

}  // namespace

Suite ssaoSamplesSuite() {
  return {
      .name = "ssao-samples",
      .title = "ambient occlusion, time and error against samples (figure 4.4)",
      .scenes =
          {{.name = "atrium", .path = "builtin:atrium"},
           {.name = "nightcity", .path = "builtin:nightcity"},
           {.name = "mirrors", .path = "builtin:mirrors"},
           {.name = "sponza", .path = "crytek_sponza/gltf/sponza.gltf", .outside = true},
           {.name = "institute", .path = "redeclipse_institute/institute.obj", .outside = true},
           {.name = "living_room", .path = "godot_living_room/living_room.glb", .outside = true}},
      .full = {.sizes = {{480, 270}}, .cameras = 20, .rounds = 1},
      .quick = {.sizes = {{320, 180}}, .cameras = 2, .rounds = 1},
      .surfaces = Surfaces::Plain,
      .measure = measure,
      .report = report};
}

}  // namespace lucerna::app::bench
