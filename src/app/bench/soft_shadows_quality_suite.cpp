// How far soft shadows are from traced ones: whole frames, each light's visibility, and the widths
// of penumbrae that are known in closed form.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/bench/shadow_methods.hpp"
#include "app/bench/suite.hpp"
#include "app/bench/visibility_error.hpp"
#include "image/metrics.hpp"
#include "scene/builtin/penumbra.hpp"
#include "trace/reference.hpp"

namespace lucerna::app::bench {
namespace {

using scene::builtin::PenumbraEdge;
using scene::builtin::PenumbraOptions;

const std::string kAlone = "lighting alone", kUnblurred = "hard", kPcss = "pcss 5+11",
                  kLayered = "layered 11";
const std::vector<std::string> kMethods{kUnblurred,
                                        "pcf 5",
                                        kPcss,
                                        kLayered,
                                        "layered 11, search",
                                        "layered 11, full",
                                        "layered 11, published"};
// The reference once more, with other random numbers: what the comparison itself is worth.
const std::string kNoise = "reference";
constexpr double kNoiseFactor = 3;  // errors below so many times the noise are not told apart
constexpr int kNearEdge = 3;        // px

// Linear pictures; what stands behind translucent surfaces and where there are none is drawn, too.
const ShadowFrame kFrame{.afterLighting = {{"Background"}, {"Transparency"}}};

struct Tracing {
  int samples = 1;  // a pixel
  std::uint64_t seed = 0;
  bool shadows = true;
};

// Shading as the passes do, from the lights' centres, times the visibility of all of the light.
Result<trace::ReferencePicture> traced(const Run& run, const Tracing& tracing) {
  const uvec2 size = run.extent.sizes.front();
  trace::ReferencePicture picture =
      trace::renderReference(run.stage.scene(), {.size = size,
                                                 .view = run.stage.view(size),
                                                 .seed = tracing.seed,
                                                 .samples = tracing.samples,
                                                 .shading = trace::Shading::Point,
                                                 .primary = trace::Primary::Centre,
                                                 .shadows = tracing.shadows,
                                                 .mirrors = 0,
                                                 .visibility = true});
  if (picture.cancelled) return error(ErrorKind::Cancelled, "cancelled while tracing");
  return picture;
}

int tracedSamples(const Results& results) {
  return results.context.quick ? 128 : 1024;
}

// As a screen shows it, at the scene's exposure.
Image exposed(const Image& linear, float exposure) {
  Image picture = converted(linear, ComponentType::F32, 3);
  for (float& value : picture.as<float>()) value *= std::exp2(exposure);
  return asShown(picture);
}

// What stays the same for all methods at a camera.
struct Truth {
  trace::ReferencePicture picture;
  Image shown;
  Image nearEdge;              // nearDepthEdges()
  std::vector<Image> reached;  // of each light, 1 where it arrives without shadows
  std::vector<Image> lit;      // the same as the passes have it, where both do
};

using Visibilities = std::map<std::string, std::vector<Image>>;  // by method, of each light

// Pictures tell lights apart by their colours: three shine at once, red, green and blue, or one
// white one where translucent surfaces tint the light; all others so little that half floats do not
// see it, but they throw shadows.
constexpr float kDim = 1e-6f;
// Radiance below which half floats have too few digits.
constexpr float kFaint = 1e-3f;

// Finds each light's visibility: its picture as a share of that without shadows.
class Probe {
 public:
  explicit Probe(Run& run)
      : run_(run), ambient_(run.stage.scene().ambient), lights_(run.stage.scene().lights) {
    for (const scene::Object& object : run.stage.scene().objects)
      if (run.stage.scene().materials[object.material].alphaMode == scene::AlphaMode::Blend)
        atOnce_ = 1;
  }
  ~Probe() {
    run_.stage.relight([&](scene::Scene& scene) {
      scene.ambient = ambient_;
      scene.lights = lights_;
    });
  }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  // With all lights on. lit: of each light, where it arrives without shadows.
  Result<Visibilities> together(std::vector<Image>& lit) const {
    Visibilities visible;
    lit.clear();
    for (std::size_t first = 0; first < lights_.size(); first += atOnce_) {
      shine(first, atOnce_, kDim);
      const std::size_t count = std::min(atOnce_, lights_.size() - first);
      LUCERNA_TRY_VOID(draw(count, [](const Name&) { return true; }, visible, lit));
    }
    return visible;
  }

  // With one on at a time, of methods whose lights might disturb each other.
  Result<Visibilities> alone() const {
    const auto wanted = [](const Name& name) {
      return name[0] == kAlone || !shadowMethod(name[0]).rows.empty();
    };
    Visibilities visible;
    std::vector<Image> lit;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      shine(i, 1, 0.f);
      LUCERNA_TRY_VOID(draw(1, wanted, visible, lit));
    }
    return visible;
  }

 private:
  // Those that shine; one alone is white.
  void shine(std::size_t first, std::size_t count, float others) const {
    run_.stage.relight([&](scene::Scene& scene) {
      scene.ambient = vec3(0);
      scene.lights = lights_;
      for (std::size_t i = 0; i < lights_.size(); ++i) {
        scene::Light& light = scene.lights[i];
        const bool shines = i >= first && i < first + count;
        light.color = vec3(shines && count == 1 ? 1.f : others);
        if (shines && count > 1) light.color[static_cast<int>(i - first)] = 1.f;
        light.ambientIntensity = 0;
        light.on = light.on && light.color != vec3(0);
      }
    });
  }

  Status draw(std::size_t count, const std::function<bool(const Name& name)>& wanted,
              Visibilities& visible, std::vector<Image>& lit) const {
    Image unshadowed;
    return run_.drawEach(wanted, [&](const Name& name, const Image& picture) {
      const Image linear = converted(picture, ComponentType::F32, 3);
      if (name[0] == kAlone) unshadowed = linear;
      for (std::size_t light = 0; light < count; ++light) {
        const std::size_t first = light, end = atOnce_ == 1 ? 3 : light + 1;  // channels
        if (name[0] == kAlone)
          lit.push_back(litIn(linear, first));
        else
          visible[name[0]].push_back(shareOf(linear, unshadowed, first, end));
      }
    });
  }

  static Image litIn(const Image& linear, std::size_t channel) {
    Image mask(linear.width(), linear.height(), 1, ComponentType::U8);
    const auto values = linear.as<float>();
    const auto out = mask.as<std::uint8_t>();
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = values[3 * i + channel] > kFaint ? 255 : 0;
    return mask;
  }

  // Mean over the channels from `first` to before `end`.
  static Image shareOf(const Image& shadowed, const Image& unshadowed, std::size_t first,
                       std::size_t end) {
    Image result(shadowed.width(), shadowed.height(), 1, ComponentType::F32);
    const auto part = shadowed.as<float>(), whole = unshadowed.as<float>();
    const auto out = result.as<float>();
    for (std::size_t i = 0; i < out.size(); ++i)
      for (std::size_t at = 3 * i + first; at < 3 * i + end; ++at)
        if (whole[at] > 0.f)
          out[i] += std::min(part[at] / whole[at], 1.f) / static_cast<float>(end - first);
    return result;
  }

  Run& run_;
  vec3 ambient_;
  std::vector<scene::Light> lights_;
  std::size_t atOnce_ = 3;
};

void countErrors(Measurement& m, const Truth& truth, const std::vector<Image>& visible) {
  ShadowFaults faults;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const VisibilityPair pair{truth.picture.visibility[i], visible[i], truth.lit[i]};
    if (const auto error = penumbraError(pair)) {
      m.count("penumbra_flip", error->flip);
      m.count("penumbra_psnr", error->psnr);
      m.count("penumbra_ssim", error->ssim);
    }
    faults.add(shadowFaults(pair, truth.nearEdge));
  }
  m.count("leak", faults.leakPercent());
  m.count("false_shadow", faults.falseShadowPercent());
  m.count("halo", faults.haloPercent());
}

// Steps of eight bits by which a light's visibility changes when the others go on, at most.
void countTransparency(Measurement& m, const Truth& truth, const std::vector<Image>& together,
                       const std::vector<Image>& alone) {
  double largest = 0;
  for (std::size_t i = 0; i < together.size(); ++i)
    largest = std::max(largest, largestDifference(together[i], alone[i], truth.lit[i]));
  m.count("others_steps", 255 * largest);
}

// builtin:penumbra, whose penumbrae are known.
struct KnownScene {
  std::string name, query;
  PenumbraOptions options;
};
const std::vector<KnownScene>& knownScenes() {
  using Case = PenumbraOptions::Case;
  static const std::vector<KnownScene> all{
      {"half-plane", "case=half-plane", {.which = Case::HalfPlane}},
      {"cards", "case=cards", {.which = Case::Cards}},
      {"fence", "case=fence", {.which = Case::Fence}},
      {"pole", "case=pole", {.which = Case::Pole}},
      {"grazing", "case=grazing", {.which = Case::Grazing}},
      {"overlap 4", "case=overlap&k=4", {.which = Case::Overlap, .lights = 4}},
      {"overlap 8", "case=overlap&k=8", {.which = Case::Overlap, .lights = 8}},
      {"overlap 16", "case=overlap&k=16", {.which = Case::Overlap, .lights = 16}},
      {"overlap 32", "case=overlap&k=32", {.which = Case::Overlap, .lights = 32}}};
  return all;
}

std::vector<PenumbraEdge> knownEdges(const std::string& scene) {
  for (const KnownScene& known : knownScenes())
    if (known.name == scene) return scene::builtin::expectedPenumbrae(known.options);
  return {};
}

// Widths behind edges, where the reference finds them: other things may stand before.
void countWidths(Measurement& m, const Run& run, const Truth& truth,
                 const std::vector<Image>& visible) {
  const scene::View view = run.stage.view(run.extent.sizes.front());
  for (const PenumbraEdge& edge : knownEdges(run.scene)) {
    const auto widthIn = [&](const std::vector<Image>& pictures) {
      return penumbraWidth(pictures[edge.light], view, edge.litW, edge.darkW);
    };
    const auto known = static_cast<double>(edge.width());
    const auto reference = widthIn(truth.picture.visibility);
    if (!reference || std::abs(*reference / known - 1) > 0.1) continue;
    const auto width = widthIn(visible);
    m.count("width_error", width ? 100 * std::abs(*width / known - 1) : 100);
  }
}

constexpr std::array kSizeFactors{0.5f, 0.7071f, 1.f, 1.4142f, 2.f};
const std::string kExponents = "half-plane";  // the scene that they are measured in

// By which power of the light's size widths grow, of each edge.
Status measureExponents(Run& run) {
  const std::vector<PenumbraEdge> edges = knownEdges(run.scene);
  const scene::View view = run.stage.view(run.extent.sizes.front());
  std::map<std::string, std::vector<std::vector<glm::dvec2>>> points;  // by method, of each edge
  const std::vector<scene::Light> lights = run.stage.scene().lights;
  const auto resize = [&](float factor) {
    run.stage.relight([&](scene::Scene& scene) {
      scene.lights = lights;
      for (scene::Light& light : scene.lights) light.radius *= factor;
    });
  };
  for (const float factor : kSizeFactors) {
    resize(factor);
    const Probe probe(run);
    std::vector<Image> lit;
    LUCERNA_TRY(visible, probe.together(lit));
    for (const auto& [method, pictures] : visible) {
      points[method].resize(edges.size());
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const vec3 middleW = 0.5f * (edges[i].litW + edges[i].darkW);
        const auto width =
            penumbraWidth(pictures[edges[i].light], view, glm::mix(middleW, edges[i].litW, factor),
                          glm::mix(middleW, edges[i].darkW, factor));
        if (width) points[method][i].emplace_back(std::log(factor), std::log(*width));
      }
    }
  }
  resize(1.f);
  for (const auto& [method, ofEdges] : points)
    for (const auto& ofEdge : ofEdges)
      if (ofEdge.size() == kSizeFactors.size())
        run.results.at({method, run.scene}).count("exponent", slopeOf(ofEdge));
  return {};
}

std::vector<std::string> allMethods() {
  std::vector<std::string> all{kAlone};
  all.insert(all.end(), kMethods.begin(), kMethods.end());
  return all;
}

void addVariants(Run& run, const ShadowFrame& frame, const std::string& output) {
  for (const std::string& method : allMethods()) {
    Chain chain = chainOf(shadowMethod(method), frame);
    chain.output = output;
    run.add({method, run.scene},
            {.chain = chain, .size = run.extent.sizes.front(), .profiled = true});
  }
}

// Lighting and all that is there for its shadows, but their maps.
void addFilterTime(Measurement& m, const graph::FrameProfile& profile) {
  std::vector<std::string> others{"ShadowMaps"};
  for (const Row& row : chainOf(shadowMethod(kAlone), kFrame).rows)
    if (row.pass != "TiledLighting") others.push_back(row.pass);
  double real = 0, cpu = 0;
  for (const graph::StepProfile& step : profile.steps)
    if (std::ranges::find(others, step.row) == others.end()) {
      real += step.gpuMs;
      cpu += step.cpuMs;
    }
  m.add(real, cpu);
}

// The reference, that with other random numbers, and where each light arrives.
Result<Truth> makeTruth(Run& run) {
  const std::uint64_t seed = run.results.context.seed;
  const int samples = tracedSamples(run.results);
  const float exposure = run.stage.scene().exposure;
  Truth truth;
  LUCERNA_TRY(picture, traced(run, {.samples = samples, .seed = seed}));
  truth.picture = std::move(picture);
  truth.shown = exposed(truth.picture.color, exposure);
  LUCERNA_TRY(open, traced(run, {.shadows = false}));
  truth.reached = std::move(open.visibility);
  LUCERNA_TRY(number, run.stage.add({.chain = {{{"Cull"}, {"GBuffer"}}, "GBuffer.depth"},
                                     .size = run.extent.sizes.front()}));
  Image depth;
  LUCERNA_TRY_VOID(run.stage.draw(number, &depth));
  truth.nearEdge = nearDepthEdges(depth, kNearEdge);
  return truth;
}

// Where both the passes and the reference say that a light arrives.
void setLit(Truth& truth, std::vector<Image> lit) {
  truth.lit = std::move(lit);
  for (std::size_t i = 0; i < truth.lit.size(); ++i) {
    const auto reached = truth.reached[i].as<float>();
    const auto out = truth.lit[i].as<std::uint8_t>();
    for (std::size_t p = 0; p < out.size(); ++p)
      if (reached[p] == 0.f) out[p] = 0;
  }
}

Status measureFrames(Run& run, const Truth& truth, double share) {
  addVariants(run, kFrame, "");
  const float exposure = run.stage.scene().exposure;
  return run.takeTurns(
      {.take = [&](const Name& name,
                   const Sample& sample) { addFilterTime(run.results.at(name), sample.profile); },
       .see =
           [&](const Name& name, const Image& picture) {
             run.results.at(name).count("flip",
                                        flipLdr(truth.shown, exposed(picture, exposure)).mean);
           }},
      share);
}

Status measureLights(Run& run, Truth& truth) {
  addVariants(run, {}, "TiledLighting.color");
  std::optional<Probe> probe(run);
  std::vector<Image> lit;
  LUCERNA_TRY(together, probe->together(lit));
  LUCERNA_TRY(alone, probe->alone());
  probe.reset();
  setLit(truth, std::move(lit));
  LUCERNA_TRY(other, traced(run, {.samples = tracedSamples(run.results),
                                  .seed = run.results.context.seed + 1}));
  together[kNoise] = std::move(other.visibility);
  Measurement& noise = run.results.at({kNoise, run.scene});
  noise.count("flip", flipLdr(truth.shown, exposed(other.color, run.stage.scene().exposure)).mean);
  for (const auto& [method, visible] : together) {
    Measurement& m = run.results.at({method, run.scene});
    countErrors(m, truth, visible);
    countWidths(m, run, truth, visible);
  }
  for (const auto& [method, visible] : alone)
    countTransparency(run.results.at({method, run.scene}), truth, together[method], visible);
  if (run.scene == kExponents) LUCERNA_TRY_VOID(measureExponents(run));
  return {};
}

// Measurements are named by method and scene.
Status measure(Run& run) {
  for (const SeededCamera& camera : run.cameras) {
    LUCERNA_TRY_VOID(run.stage.look(camera.pose));
    LUCERNA_TRY(truth, makeTruth(run));
    LUCERNA_TRY_VOID(measureFrames(run, truth, 1.0 / static_cast<double>(run.cameras.size())));
    run.clear();
    LUCERNA_TRY_VOID(measureLights(run, truth));
    run.clear();
  }
  return {};
}

// The reports' columns: the methods, and the noise.
std::vector<std::string> columns(bool withAlone) {
  std::vector<std::string> all = withAlone ? allMethods() : kMethods;
  all.push_back(kNoise);
  return all;
}

Table errorTable(const Results& results, const std::string& title, const std::string& counter,
                 double Spread::* worst, bool withAlone = false) {
  return tableOf(title, "scene", results.parts(1), columns(withAlone),
                 [&](const std::string& scene, const std::string& method) {
                   return worstText(results.samples({method, scene}, counter), worst);
                 });
}

double noiseOf(const Results& results, const std::string& scene) {
  return spreadOf(results.samples({kNoise, scene}, "flip")).max;
}

// FLIP that is lost in the noise is not told.
Table flipTable(const Results& results) {
  return tableOf("FLIP of the frame: median (worst)", "scene", results.parts(1), columns(true),
                 [&](const std::string& scene, const std::string& method) {
                   const auto flips = results.samples({method, scene}, "flip");
                   const double bound = kNoiseFactor * noiseOf(results, scene);
                   if (method != kNoise && !flips.empty() && spreadOf(flips).median < bound)
                     return "below " + numberText(bound);
                   return worstText(flips);
                 });
}

double filterMs(const Results& results, const std::string& method, const std::string& scene) {
  return spreadOf(results.times({method, scene})).median -
         spreadOf(results.times({kAlone, scene})).median;
}

// What is wanted of layered shadows; the others stand beside, and what is not blurred should miss
// it.
struct Bar {
  enum class Of { Value, ShareOfPcss, AbovePcss, FromOne };
  std::string what, scene, counter;  // scene "": all
  double bound;
  bool atLeast = false;
  Of of = Of::Value;
};

const std::string kHall = "atrium, 16 lights", kManyLights = "atrium, 64 lights",
                  kFilter = "filter";

std::vector<Bar> bars() {
  using Of = Bar::Of;
  std::vector<Bar> all{
      {"FLIP", kHall, "flip", 0.025},
      {"FLIP, share of pcss's", kHall, "flip", 0.8, false, Of::ShareOfPcss},
      {"filter time, share of pcss's", kHall, kFilter, 0.5, false, Of::ShareOfPcss},
      {"FLIP", kManyLights, "flip", 0.03}};
  for (const std::string& scene : {kHall, kManyLights})
    all.insert(all.end(),
               {{"PSNR in penumbrae, dB", scene, "penumbra_psnr", 28, true},
                {"PSNR above pcss's, dB", scene, "penumbra_psnr", 0, true, Of::AbovePcss},
                {"leak, %", scene, "leak", 0.5},
                {"false shadow, %", scene, "false_shadow", 0.5},
                {"halo pixels, %", scene, "halo", 0.3}});
  all.insert(all.end(), {{"error of widths, %", "", "width_error", 10},
                         {"exponent of the size, from 1", "", "exponent", 0.03, false, Of::FromOne},
                         {"others' steps of 255", "overlap 32", "others_steps", 2}});
  return all;
}

std::optional<double> valueOf(const Results& results, const Bar& bar, const std::string& method) {
  if (bar.counter == kFilter) {
    if (results.times({method, bar.scene}).empty()) return std::nullopt;
    return filterMs(results, method, bar.scene);
  }
  Name name{method};
  if (!bar.scene.empty()) name.push_back(bar.scene);
  const auto samples = results.samples(name, bar.counter);
  return samples.empty() ? std::nullopt : std::optional(spreadOf(samples).median);
}

std::string judged(const Results& results, const Bar& bar, const std::string& method) {
  auto value = valueOf(results, bar, method);
  if (!value) return "-";
  if (bar.of == Bar::Of::FromOne) *value = std::abs(*value - 1);
  if (bar.of == Bar::Of::ShareOfPcss || bar.of == Bar::Of::AbovePcss) {
    const auto pcss = valueOf(results, bar, kPcss);
    if (!pcss) return "-";
    *value = bar.of == Bar::Of::ShareOfPcss ? *value / *pcss : *value - *pcss;
  }
  const bool met = bar.atLeast ? *value >= bar.bound : *value <= bar.bound;
  return numberText(*value) + (met ? ", met" : ", missed");
}

Table barsTable(const Results& results) {
  Table table{.title =
                  "What is wanted of layered shadows, medians; 'hard' is what they are "
                  "without blur",
              .head = {"", "scene", "wanted"}};
  table.head.insert(table.head.end(), kMethods.begin(), kMethods.end());
  for (const Bar& bar : bars()) {
    if (!valueOf(results, bar, kLayered)) continue;
    std::vector<std::string> row{
        bar.what, bar.scene.empty() ? "all that are known" : bar.scene,
        fmt::format("at {} {}", bar.atLeast ? "least" : "most", bar.bound)};
    for (const std::string& method : kMethods) row.push_back(judged(results, bar, method));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table widthsTable(const Results& results) {
  const std::string all = "all: median, wanted at most 10",
                    exponent = "exponent of the light's size, wanted 1.00 +- 0.03";
  std::vector<std::string> rows;
  for (const KnownScene& known : knownScenes())
    if (!results.samples({kNoise, known.name}, "width_error").empty()) rows.push_back(known.name);
  rows.insert(rows.end(), {all, exponent});
  return tableOf("Error of penumbrae's widths against the closed form, %: median (worst)", "scene",
                 rows, columns(false), [&](const std::string& row, const std::string& method) {
                   if (row == all) return worstText(results.samples({method}, "width_error"));
                   if (row == exponent)
                     return spreadText(results.samples({method, kExponents}, "exponent"));
                   return worstText(results.samples({method, row}, "width_error"));
                 });
}

Table filterTable(const Results& results) {
  const std::string flip = "FLIP, layered / pcss", time = "filter time, layered / pcss";
  std::vector<std::string> columnNames = kMethods;
  columnNames.insert(columnNames.end(), {flip, time});
  return tableOf(
      "Filter time in ms, beyond lighting alone, maps kept; and FLIP beside it (wanted at 16 "
      "lights: FLIP at most 0.80 at no more than 0.50 of the time)",
      "scene", results.parts(1), columnNames,
      [&](const std::string& scene, const std::string& column) -> std::string {
        if (column == flip)
          return ratioText(pairedRatios(results.samples({kLayered, scene}, "flip"),
                                        results.samples({kPcss, scene}, "flip")));
        if (column == time) {
          const double pcss = filterMs(results, kPcss, scene);
          return pcss > 0 ? fmt::format("{:.2f}", filterMs(results, kLayered, scene) / pcss) : "-";
        }
        return results.times({column, scene}).empty()
                   ? "-"
                   : numberText(filterMs(results, column, scene));
      });
}

BarPlot flipPlot(const Results& results, const std::string& scene) {
  BarPlot plot{.title = "FLIP of the frame, " + scene + ", medians",
               .unit = "",
               .rows = columns(true),
               .parts = {"FLIP"}};
  for (const std::string& method : plot.rows)
    plot.values.push_back({spreadOf(results.samples({method, scene}, "flip")).median});
  return plot;
}

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(fmt::format(
      "The distance from a picture that is traced in the same process with {} rays a light and "
      "pixel through each pixel's centre, shaded from the lights' centres; all surfaces are plain. "
      "'{}' is that picture once more with other random numbers: the noise; nothing is told of "
      "FLIP below {} times it. A light's visibility is its own picture as a share of that without "
      "shadows, all lights on; its penumbra the pixels where the reference has 0.02 to 0.98. Leak "
      "is the mean visibility where the reference has none, false shadow what is missing where it "
      "has all, halo pixels those wrong by more than 0.1 within {} pixels of an edge of depth, of "
      "all that the light reaches.",
      tracedSamples(results), kNoise, kNoiseFactor, kNearEdge));
  blocks.emplace_back(barsTable(results));
  blocks.emplace_back(flipTable(results));
  blocks.emplace_back(filterTable(results));
  blocks.emplace_back(errorTable(results,
                                 "PSNR in dB inside each light's penumbra: median (worst light)",
                                 "penumbra_psnr", &Spread::min));
  blocks.emplace_back(errorTable(results, "SSIM inside each light's penumbra: median (worst light)",
                                 "penumbra_ssim", &Spread::min));
  blocks.emplace_back(errorTable(results, "FLIP inside each light's penumbra: median (worst light)",
                                 "penumbra_flip", &Spread::max));
  blocks.emplace_back(errorTable(results, "Leak, %", "leak", &Spread::max));
  blocks.emplace_back(errorTable(results, "False shadow, %", "false_shadow", &Spread::max));
  blocks.emplace_back(errorTable(results, "Halo pixels, %", "halo", &Spread::max));
  blocks.emplace_back(errorTable(
      results, "How far other lights change a light's visibility, most of all pixels, steps of 255",
      "others_steps", &Spread::max));
  blocks.emplace_back(widthsTable(results));
  blocks.emplace_back(flipPlot(results, results.parts(1).front()));
  return blocks;
}

}  // namespace

Suite softShadowsQualitySuite() {
  std::vector<SceneChoice> scenes{
      {.name = kHall, .path = "builtin:atrium", .quickSizes = {{640, 360}}},
      {.name = kManyLights, .path = "builtin:atrium?lights=64"}};
  for (const KnownScene& known : knownScenes())
    scenes.push_back({.name = known.name,
                      .path = "builtin:penumbra?" + known.query,
                      .quick = known.name != "overlap 8" && known.name != "overlap 16"});
  scenes.push_back({.name = "panes", .path = "builtin:penumbra?case=panes", .translucent = true});
  scenes.push_back(
      {.name = "nightcity, lamps and sun", .path = "builtin:nightcity?sun=35,40", .quick = false});
  return {.name = "soft-shadows-quality",
          .title = "soft shadows, error against traced ones",
          .scenes = std::move(scenes),
          .full = {.sizes = {{640, 360}}, .cameras = 1, .rounds = 3},
          .quick = {.sizes = {{480, 270}}, .cameras = 1, .rounds = 1},
          .lighting = Lighting::Own,
          .places = Places::Own,
          .surfaces = Surfaces::Plain,
          .measure = measure,
          .report = report};
}

}  // namespace lucerna::app::bench
