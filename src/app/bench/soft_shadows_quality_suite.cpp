// How far soft shadows are from traced ones: whole frames, each light's visibility, and the widths
// of penumbrae that are known in closed form.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/bench/light_probe.hpp"
#include "app/bench/shadow_methods.hpp"
#include "app/bench/soft_shadows_quality.hpp"
#include "app/bench/suite.hpp"
#include "app/bench/visibility_error.hpp"
#include "image/metrics.hpp"
#include "trace/reference.hpp"

namespace lucerna::app::bench {
namespace quality {

int tracedSamples(const Results& results) {
  return results.context.quick ? 128 : 1024;
}

const std::vector<KnownScene>& knownScenes() {
  using Case = scene::builtin::PenumbraOptions::Case;
  static const std::vector<KnownScene> all{
      {"half-plane", "case=half-plane", {.which = Case::HalfPlane}},
      {"cards", "case=cards", {.which = Case::Cards}},
      {"fence", "case=fence", {.which = Case::Fence}},
      {"pole", "case=pole", {.which = Case::Pole}},
      {"grazing", "case=grazing", {.which = Case::Grazing}},
      {"overlap 4", "case=overlap&k=4", {.which = Case::Overlap, .lights = 4}},
      {"overlap 8", "case=overlap&k=8", {.which = Case::Overlap, .lights = 8}},
      {"overlap 16", "case=overlap&k=16", {.which = Case::Overlap, .lights = 16}},
      {"overlap 32", "case=overlap&k=32", {.which = Case::Overlap, .lights = 32}},
      {"panes", "case=panes", {.which = Case::Panes}}};
  return all;
}

std::vector<std::string> allMethods() {
  std::vector<std::string> all{kAlone};
  all.insert(all.end(), kMethods.begin(), kMethods.end());
  return all;
}

}  // namespace quality

namespace {

using namespace quality;

using scene::builtin::PenumbraEdge;

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

std::vector<PenumbraEdge> knownEdges(const std::string& scene) {
  for (const KnownScene& known : knownScenes())
    if (known.name == scene) return scene::builtin::expectedPenumbrae(known.options);
  return {};
}

// Which share of the light it is between what reaches both ends of an edge.
Image betweenEnds(const Image& visibility, const PenumbraEdge& edge) {
  const auto mean = [](vec3 color) { return (color.x + color.y + color.z) / 3.f; };
  const float lit = mean(edge.litTransmittance), dark = mean(edge.darkTransmittance);
  Image share = visibility;
  for (float& value : share.as<float>()) value = (value - dark) / (lit - dark);
  return share;
}

// Widths behind edges, where the reference finds them: other things may stand before.
void countWidths(Measurement& m, const Run& run, const Truth& truth,
                 const std::vector<Image>& visible) {
  const scene::View view = run.stage.view(run.extent.sizes.front());
  for (const PenumbraEdge& edge : knownEdges(run.scene)) {
    const auto widthIn = [&](const std::vector<Image>& pictures) {
      return penumbraWidth(betweenEnds(pictures[edge.light], edge), view, edge.litW, edge.darkW);
    };
    const auto known = static_cast<double>(edge.width());
    const auto reference = widthIn(truth.picture.visibility);
    if (!reference || std::abs(*reference / known - 1) > 0.1) continue;
    const auto width = widthIn(visible);
    // Those of panes apart: what a bar is set for are shadows.
    const bool ofPane = edge.darkTransmittance != vec3(0);
    m.count(ofPane ? kPaneWidths : kWidths, width ? 100 * std::abs(*width / known - 1) : 100);
  }
}

constexpr std::array kSizeFactors{0.5f, 0.7071f, 1.f, 1.4142f, 2.f};

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
    const LightProbe probe(run, kAlone);
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

void addVariant(Run& run, const std::string& method, const ShadowFrame& frame,
                const std::string& output) {
  Chain chain = chainOf(shadowMethod(method), frame);
  chain.output = output;
  run.add({method, run.scene},
          {.chain = chain, .size = run.extent.sizes.front(), .profiled = true});
}

void addVariants(Run& run, const ShadowFrame& frame, const std::string& output) {
  for (const std::string& method : allMethods()) addVariant(run, method, frame, output);
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

// Whether other lights may change what is seen of one.
bool disturbs(const std::string& method) {
  return !shadowMethod(method).rows.empty();
}

Status measureLights(Run& run, Truth& truth) {
  addVariants(run, {}, "TiledLighting.color");
  std::optional<LightProbe> probe(std::in_place, run, kAlone);
  std::vector<Image> lit;
  LUCERNA_TRY(together, probe->together(lit));
  LUCERNA_TRY(alone, probe->alone(disturbs));
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

// Of what moves, how unsteadily each method's pictures change. Methods one after another, so that
// maps follow what moves.
Status measureFlicker(Run& run) {
  constexpr int kFrames = 120;
  constexpr double kFramesASecond = 30;
  const float exposure = run.stage.scene().exposure;
  for (const std::string& method : allMethods()) {
    addVariant(run, method, kFrame, "");
    std::vector<Image> last;
    for (int frame = 0; frame < kFrames; ++frame) {
      run.stage.at(frame / kFramesASecond);
      LUCERNA_TRY_VOID(run.drawEach([](const Name&) { return true; },
                                    [&](const Name& name, const Image& picture) {
                                      last.push_back(exposed(picture, exposure));
                                      if (last.size() < 3) return;
                                      run.results.at(name).count(
                                          "flicker", 255 * flickerOf(last[0], last[1], last[2]));
                                      last.erase(last.begin());
                                    }));
    }
    run.clear();
  }
  run.stage.at(0);
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
    if (run.scene == kMoving) LUCERNA_TRY_VOID(measureFlicker(run));
  }
  return {};
}

}  // namespace

Suite softShadowsQualitySuite() {
  std::vector<SceneChoice> scenes{
      {.name = kHall, .path = "builtin:atrium", .quickSizes = {{640, 360}}},
      {.name = kManyLights, .path = "builtin:atrium?lights=64"},
      {.name = "atrium, 256 lights", .path = "builtin:atrium?lights=256", .quick = false},
      {.name = kMoving, .path = "builtin:atrium?moving=0.1", .quick = false, .moving = true}};
  for (const KnownScene& known : knownScenes())
    scenes.push_back({.name = known.name,
                      .path = "builtin:penumbra?" + known.query,
                      .quick = known.name != "overlap 8" && known.name != "overlap 16",
                      .translucent = known.name == "panes"});
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
          .report = quality::report};
}

}  // namespace lucerna::app::bench
