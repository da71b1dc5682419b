#include "app/bench/suite.hpp"

#include <algorithm>
#include <filesystem>

#include "core/file.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "scene/load.hpp"

namespace lucerna::app::bench {
namespace {

constexpr std::uint64_t kSceneUnits = 1000;  // of progress
constexpr std::string_view kBuiltin = "builtin:";

SceneChoice chosenByUser(const std::string& path) {
  if (path.starts_with(kBuiltin)) return {.name = path.substr(kBuiltin.size()), .path = path};
  return {.name = std::filesystem::path(path).stem().string(), .path = path};
}

// The scenes to measure; what is left out is noted.
std::vector<SceneChoice> scenesOf(const Suite& suite, const BenchOptions& options,
                                  Results& results) {
  std::vector<SceneChoice> scenes;
  for (const std::string& path : options.scenes) {
    // One of its own it measures as ever.
    const auto own = std::ranges::find(suite.scenes, path, &SceneChoice::path);
    const bool known = own != suite.scenes.end() && !own->outside;
    scenes.push_back(known ? *own : chosenByUser(path));
  }
  if (!scenes.empty()) return scenes;
  for (SceneChoice scene : suite.scenes) {
    if (options.quick && !scene.quick) continue;
    if (scene.outside) {
      const std::string file = scene.path;
      scene.path = (std::filesystem::path(options.sceneFolder) / file).string();
      if (options.sceneFolder.empty() || !std::filesystem::exists(scene.path)) {
        results.note(fmt::format("Skipped: {}, as {}", scene.name,
                                 options.sceneFolder.empty()
                                     ? "no --scene-folder says where scenes of others are"
                                     : scene.path + " is not there"));
        continue;
      }
    }
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

// Of a scene, or of the suite where scenes do not say otherwise.
Extent extentOf(const Suite& suite, const BenchOptions& options, const SceneChoice& scene = {}) {
  Extent extent = options.quick ? suite.quick : suite.full;
  if (const auto& sizes = options.quick ? scene.quickSizes : scene.sizes; !sizes.empty())
    extent.sizes = sizes;
  if (!options.sizes.empty()) extent.sizes = options.sizes;
  extent.cameras = options.cameras.value_or(extent.cameras);
  extent.rounds = options.rounds.value_or(extent.rounds);
  return extent;
}

// What is there is measured as it stands when its animations begin.
Status measureUndrawn(const Suite& suite, const SceneChoice& choice, const BenchOptions& options,
                      Results& results, Progress& progress) {
  setThreadCount(options.render.threads);
  LUCERNA_TRY(scene, scene::loadScene(choice.path));
  for (const std::string& warning : scene.warnings) log::warning("{}", warning);
  scene::animate(scene, 0.f);
  double done = 0;
  const auto units = [&] { return static_cast<std::uint64_t>(done * kSceneUnits); };
  SceneRun run{.scene = scene,
               .results = results,
               .name = choice.name,
               .path = choice.path,
               .extent = extentOf(suite, options, choice),
               .advance = [&](double share) {
                 const std::uint64_t before = units();
                 done += share;
                 progress.advance(units() - before);
               }};
  return suite.measureScene(run);
}

Status measure(const Suite& suite, const SceneChoice& scene, const BenchOptions& options,
               Results& results, Progress& progress) {
  if (suite.measureScene) return measureUndrawn(suite, scene, options, results, progress);
  const Extent extent = extentOf(suite, options, scene);
  StageSettings settings{.render = options.render,
                         .lighting = suite.lighting,
                         .elevationDegrees = scene.elevationDegrees,
                         .azimuthDegrees = scene.azimuthDegrees,
                         .surfaces = suite.surfaces,
                         .moving = scene.moving};
  if (scene.translucent && suite.surfaces == Surfaces::Plain)
    settings.surfaces = Surfaces::PlainAndTranslucent;
  settings.render.scene = scene.path;
  LUCERNA_TRY(stage, Stage::open(settings));
  results.context.driver = stage->device().description();
  results.context.timers = stage->device().timersUseCpuClock() ? "cpu-after-finish" : "gpu-timer";
  Run run(*stage, results, scene.name, extent, progress);
  run.cameras = suite.places == Places::Own
                    ? ownCameras(stage->scene(), extent.cameras)
                    : seededCameras(stage->scene(), {.count = extent.cameras,
                                                     .seed = options.render.seed,
                                                     .eyeHeight = scene.eyeHeight});
  return suite.measure(run);
}

}  // namespace

void Run::add(Name name, const Variant& variant) {
  if (const auto number = stage.add(variant))
    lanes_.push_back({std::move(name), *number});
  else
    results.fail(join(name, ", "), number.error());
}

Result<std::optional<Sample>> Run::draw(Lane& lane, Image* picture) {
  std::optional<Sample> sample;
  if (!lane.works) return sample;
  auto drawn = stage.draw(lane.variant, picture);
  if (drawn) {
    sample = *std::move(drawn);
  } else if (drawn.error().kind == ErrorKind::Cancelled) {
    return drawn.error();
  } else {
    lane.works = false;
    results.fail(join(lane.name, ", "), drawn.error());
  }
  return sample;
}

Status Run::takeTurns(const Turns& turns, double share) {
  const auto pixelsOf = [&](const Lane& lane) {
    const uvec2 size = stage.variant(lane.variant).size;
    return static_cast<double>(size.x) * static_cast<double>(size.y);
  };
  double pixels = 0;
  for (const Lane& lane : lanes_) pixels += pixelsOf(lane) * (extent.rounds + 1);
  if (turns.prepare) LUCERNA_TRY_VOID(turns.prepare());
  for (Lane& lane : lanes_) {
    Image picture;
    LUCERNA_TRY(warm, draw(lane, turns.see ? &picture : nullptr));
    if (warm && turns.see) turns.see(lane.name, picture);
    advance(share * pixelsOf(lane) / pixels);
  }
  for (int round = 0; round < extent.rounds; ++round)
    for (const std::size_t i : turnOrder(lanes_.size(), rounds_++)) {
      LUCERNA_TRY(sample, draw(lanes_[i]));
      if (sample) turns.take(lanes_[i].name, *sample);
      advance(share * pixelsOf(lanes_[i]) / pixels);
    }
  return {};
}

Status Run::takeTurnsEverywhere(const Turns& turns) {
  for (const SeededCamera& camera : cameras) {
    LUCERNA_TRY_VOID(stage.look(camera.pose, camera.sight));
    LUCERNA_TRY_VOID(takeTurns(turns, 1.0 / static_cast<double>(cameras.size())));
  }
  return {};
}

Status Run::drawEach(const std::function<bool(const Name& name)>& wanted,
                     const std::function<void(const Name& name, const Image& picture)>& see) {
  for (Lane& lane : lanes_) {
    if (!wanted(lane.name)) continue;
    Image picture;
    LUCERNA_TRY(sample, draw(lane, &picture));
    if (sample) see(lane.name, picture);
  }
  return {};
}

void Run::clear() {
  lanes_.clear();
  stage.clear();
}

void Run::advance(double share) {
  const auto units = [&] { return static_cast<std::uint64_t>(done_ * kSceneUnits); };
  const std::uint64_t before = units();
  done_ += share;
  progress_.advance(units() - before);
}

std::vector<std::size_t> turnOrder(std::size_t count, std::size_t round) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = i % 2 == 1 ? (i + 1) / 2 : count - i / 2;  // 0, 1, -1, 2, -2, ...
    order.push_back((place + round) % count);
  }
  const bool secondTime = count > 0 && round / count % 2 == 1;
  if (count % 2 == 1 && secondTime) std::ranges::reverse(order);
  return order;
}

std::span<const Suite> suites() {
  static const std::vector<Suite> all{
      passesSuite(),     forwardSuite(),      sraaSuite(),        ssaoSamplesSuite(),
      shadowSizeSuite(), depthOfFieldSuite(), softShadowsSuite(), softShadowsQualitySuite(),
      bakeSuite()};
  return all;
}

Status checkScenes(const BenchOptions& options) {
  std::vector<std::string> names;
  for (const std::string& path : options.scenes) {
    if (!path.starts_with(kBuiltin) && !std::filesystem::exists(path))
      return error(ErrorKind::Input, "{}: no such file; wanted a scene", path);
    names.push_back(chosenByUser(path).name);
  }
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice == names.end()) return {};
  return error(ErrorKind::Usage, "--scene: two are called '{}' in the tables; rename a file",
               *twice);
}

Results run(const Suite& suite, const BenchOptions& options) {
  const Extent extent = extentOf(suite, options);
  Results results{.suite = std::string(suite.name), .context = contextOfMachine()};
  results.context.quick = options.quick;
  results.ownCameras = suite.places == Places::Own;
  results.cameras = suite.measureScene ? 0 : extent.cameras;
  results.rounds = extent.rounds;
  results.context.seed = options.render.seed;
  const std::vector<SceneChoice> scenes = scenesOf(suite, options, results);
  for (const SceneChoice& scene : suite.measureScene ? std::vector<SceneChoice>{} : scenes)
    for (const uvec2 size : extentOf(suite, options, scene).sizes)
      if (const std::string name = sizeName(size);
          std::ranges::find(results.sizes, name) == results.sizes.end())
        results.sizes.push_back(name);
  for (const std::string& note : results.notes) log::info("{}", note);
  Progress progress(std::string(suite.name), kSceneUnits * scenes.size());
  for (const SceneChoice& scene : scenes) {
    log::debug("{}: {}", suite.name, scene.name);
    Results withScene = results;
    const Status measured = measure(suite, scene, options, withScene, progress);
    if (!measured) withScene.measurements = std::move(results.measurements);
    results = std::move(withScene);
    if (measured) continue;
    results.cancelled = measured.error().kind == ErrorKind::Cancelled;
    if (results.cancelled) break;
    results.fail(scene.name, measured.error());
  }
  return results;
}

Result<std::vector<std::string>> writeResults(const std::string& folder, const std::string& name,
                                              const std::vector<Results>& results) {
  std::vector<Report> reports;
  for (const Results& r : results) {
    const auto suite = std::ranges::find(suites(), r.suite, &Suite::name);
    reports.push_back({.title = fmt::format("{}: {}", suite->name, suite->title)});
    if (!r.measurements.empty()) reports.back().blocks = suite->report(r);
  }
  const std::vector<std::pair<std::string, std::string>> texts{
      {".json", googleBenchmarkJson(results)},
      {".md", benchMarkdown(results, reports)},
      {".html", benchHtml(results, reports)}};
  std::vector<std::string> files;
  for (const auto& [extension, text] : texts) {
    files.push_back((std::filesystem::path(folder) / (name + extension)).string());
    LUCERNA_TRY_VOID(writeText(files.back(), text));
  }
  return files;
}

std::string sizeName(uvec2 size) {
  return fmt::format("{}x{}", size.x, size.y);
}

Image asShown(const Image& linear) {
  Image encoded = linear;
  for (float& value : encoded.as<float>()) value = srgbFromLinear(value);
  return converted(converted(encoded, ComponentType::U8, 3), ComponentType::F32, 3);
}

// TestScene, Forza, Crytek Sponza, Conference with the dragon, Fabia2; and two of ours.
std::vector<SceneChoice> thesisScenes() {
  return {{.name = "materials", .path = "builtin:materials"},
          {.name = "street-1", .path = "torcs_street-1/street-1.gltf", .outside = true},
          {.name = "sponza", .path = "crytek_sponza/gltf/sponza.gltf", .outside = true},
          {.name = "dragon", .path = "stanford_dragon/dragon_871k.glb", .outside = true},
          {.name = "nightcity", .path = "builtin:nightcity?blocks=24"},
          {.name = "atrium", .path = "builtin:atrium"},
          {.name = "mirrors", .path = "builtin:mirrors"}};
}

}  // namespace lucerna::app::bench
