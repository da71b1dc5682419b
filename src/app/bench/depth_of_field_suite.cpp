// DepthOfField's methods by their settings: what they cost and how far they are from a picture that
// is traced through the same lens. The thesis has no such table.
#include <algorithm>
#include <map>

#include "app/bench/suite.hpp"
#include "image/metrics.hpp"
#include "passes/depth_of_field/depth_of_field.hpp"
#include "trace/reference.hpp"

namespace lucerna::app::bench {
namespace {

const std::string kNone = "none", kSeparable = "separable", kGather = "gather", kNoSetting = "-",
                  kSharp = "sharp pictures";
const std::map<std::string, std::string> kParam{{kSeparable, "scale"}, {kGather, "steps"}};
const std::map<std::string, std::vector<std::string>> kSettings{
    {kNone, {kNoSetting}},
    {kSeparable, {"0.375", "0.5", "0.75", "1"}},
    {kGather, {"2", "4", "6", "8", "12"}}};
const std::vector<std::string> kMethods{kNone, kSeparable, kGather};

// Focused before and behind most of what is seen. What is infinitely far is blurred over a disc of
// a tenth of the picture's height.
struct Lens {
  std::string name;
  Length focus, radius;
};
const std::vector<Lens> kLenses{
    {"focus before", {"focusDistance", 0.5f}, {"lensRadius", 0.5f * 0.045f}},
    {"focus behind", {"focusDistance", 1.5f}, {"lensRadius", 1.5f * 0.045f}}};

// Points of the lens that are traced.
int tracedSamples(const Results& results) {
  return results.context.quick ? 32 : 128;
}

Chain chainOf(const std::string& method, const std::string& setting, const Lens& lens) {
  Row row{"DepthOfField"};
  if (method != kNone)
    row = {"DepthOfField",
           {"method=" + method, kParam.at(method) + "=" + setting},
           {lens.focus, lens.radius}};
  return {{{"Cull"},
           {"GBuffer"},
           {"TiledLighting"},
           {"Background"},
           {"Transparency"},
           row,
           {"ToneMap", {"operator=linear"}}}};
}

// Null: all is sharp.
Result<Image> traced(const Run& run, const Lens* lens) {
  const uvec2 size = run.extent.sizes.front();
  const auto length = [&](const Length& wanted) {
    return static_cast<float>(run.stage.length("DepthOfField", wanted));
  };
  const trace::ReferencePicture picture = trace::renderReference(
      run.stage.scene(), {.size = size,
                          .view = run.stage.view(size),
                          .samples = lens ? tracedSamples(run.results) : 1,
                          .primary = trace::Primary::Centre,
                          .shadows = false,
                          .mirrors = 0,
                          .lensRadius = lens ? length(lens->radius) : 0.f,
                          .focusDistance = lens ? length(lens->focus) : 1.f});
  if (picture.cancelled) return error(ErrorKind::Cancelled, "cancelled while tracing");
  return asShown(picture.color);
}

const std::string kFlip = "flip", kPsnr = "psnr";
const std::string kOfSharp = "sharp_";  // before them: of the pictures without blur, both sharp

void compare(Measurement& m, const Image& truth, const Image& picture,
             const std::string& prefix = "") {
  m.count(prefix + kFlip, flipLdr(truth, picture).mean);
  m.count(prefix + kPsnr, pixelMetrics(truth, picture).psnr);
}

// Measurements are named by method, setting, scene and lens.
Status measure(Run& run) {
  for (const Lens& lens : kLenses)
    for (const std::string& method : kMethods)
      for (const std::string& setting : kSettings.at(method))
        run.add({method, setting, run.scene, lens.name}, {.chain = chainOf(method, setting, lens),
                                                          .size = run.extent.sizes.front(),
                                                          .profiled = true});
  std::map<std::string, Image> truths;  // by lens; "" is sharp
  return run.takeTurnsEverywhere(
      {.prepare = [&]() -> Status {
         LUCERNA_TRY(sharp, traced(run, nullptr));
         truths[""] = std::move(sharp);
         for (const Lens& lens : kLenses) {
           LUCERNA_TRY(blurred, traced(run, &lens));
           truths[lens.name] = std::move(blurred);
         }
         return {};
       },
       .take =
           [&](const Name& name, const Sample& sample) {
             const auto row =
                 std::ranges::find(sample.profile.steps, "DepthOfField", &graph::StepProfile::row);
             CHECK(row != sample.profile.steps.end());
             run.results.at(name).add(row->gpuMs, row->cpuMs);
           },
       .see =
           [&](const Name& name, const Image& picture) {
             const Image test = converted(picture, ComponentType::F32, 3);
             compare(run.results.at(name), truths[name.back()], test);
             if (name[0] == kNone && name.back() == kLenses.front().name)
               compare(run.results.at(name), truths[""], test, kOfSharp);
           }});
}

// The setting that the pass has by itself.
std::string defaultOf(const std::string& method) {
  const passes::DepthOfField::Params own;
  const std::string setting = method == kSeparable ? fmt::format("{}", own.scale)
                              : method == kGather  ? fmt::format("{}", own.steps)
                                                   : kNoSetting;
  CHECK(std::ranges::find(kSettings.at(method), setting) != kSettings.at(method).end(),
        "{} is not measured", setting);
  return setting;
}

Table errorTable(const Results& results, std::string title, const std::string& counter,
                 double Spread::* worst) {
  std::vector<std::string> columns = kMethods;
  columns.push_back(kSharp);
  const std::string all = "all";
  std::vector<std::string> scenes = results.parts(2);
  scenes.push_back(all);
  return tableOf(std::move(title), "scene", scenes, columns,
                 [&](const std::string& scene, const std::string& column) {
                   const bool sharp = column == kSharp;
                   const std::string& method = sharp ? kNone : column;
                   Name name{method, defaultOf(method)};
                   if (scene != all) name.push_back(scene);
                   return worstText(results.samples(name, sharp ? kOfSharp + counter : counter),
                                    worst);
                 });
}

Table settingsTable(const Results& results) {
  const std::string time = "ms: median (quartiles)", flip = "FLIP", psnr = "PSNR, dB";
  std::map<std::string, Name> names;
  std::vector<std::string> rows;
  for (const std::string& method : {kSeparable, kGather})
    for (const std::string& setting : kSettings.at(method)) {
      rows.push_back(fmt::format("{}, {} {}", method, kParam.at(method), setting));
      names[rows.back()] = {method, setting};
    }
  return tableOf("By setting, all scenes: median (worst)", "setting", rows, {time, flip, psnr},
                 [&](const std::string& row, const std::string& column) {
                   const Name& name = names.at(row);
                   if (column == time) return spreadText(results.times(name));
                   if (column == flip) return worstText(results.samples(name, kFlip));
                   return worstText(results.samples(name, kPsnr), &Spread::min);
                 });
}

// Of each setting, the median of time (x) and FLIP (y).
LinePlot errorOverTime(const Results& results) {
  LinePlot plot{.title = "Error against time, all scenes", .xLabel = "ms", .yLabel = "FLIP"};
  for (const std::string& method : {kSeparable, kGather}) {
    std::vector<glm::dvec2>& points = plot.curves.emplace_back(Curve{method}).points;
    for (const std::string& setting : kSettings.at(method))
      points.emplace_back(spreadOf(results.times({method, setting})).median,
                          spreadOf(results.samples({method, setting}, kFlip)).median);
    std::ranges::sort(points, {}, [](const glm::dvec2& point) { return point.x; });
  }
  return plot;
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(
      fmt::format("The distance from a picture that is traced through the same lens, with {} rays "
                  "through each pixel's centre and no shadows in either. Every place is seen with "
                  "two lenses: focused at half and at one and a half times the distance at which "
                  "things are seen. 'none' is the picture without blur; 'sharp pictures' is what "
                  "pictures without a lens differ by, which is no fault of the blur.",
                  tracedSamples(results)));
  blocks.emplace_back(
      errorTable(results, "FLIP by scene: median (worst picture)", kFlip, &Spread::max));
  blocks.emplace_back(
      errorTable(results, "PSNR in dB by scene: median (worst picture)", kPsnr, &Spread::min));
  blocks.emplace_back(settingsTable(results));
  blocks.emplace_back(errorOverTime(results));
  return blocks;
}

}  // namespace

Suite depthOfFieldSuite() {
  return {
      .name = "depth-of-field",
      .title = "depth of field, time and error by method",
      .scenes =
          {{.name = "atrium", .path = "builtin:atrium"},
           {.name = "nightcity", .path = "builtin:nightcity", .eyeHeight = 1.7f},
           {.name = "mirrors", .path = "builtin:mirrors"},
           {.name = "sponza", .path = "crytek_sponza/gltf/sponza.gltf", .outside = true},
           {.name = "institute", .path = "redeclipse_institute/institute.obj", .outside = true},
           {.name = "living_room", .path = "godot_living_room/living_room.glb", .outside = true}},
      .full = {.sizes = {{320, 180}}, .cameras = 20, .rounds = 1},
      .quick = {.sizes = {{160, 90}}, .cameras = 2, .rounds = 1},
      .measure = measure,
      .report = report};
}

}  // namespace lucerna::app::bench
