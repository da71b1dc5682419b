// The baker: tables 6.2 to 6.4 of system B's thesis and its memory, beside Embree's bare rate on
// the same rays; the thesis' own engine on a sample of the same work; packing.
#include "app/bench/bake_suite.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>

#include "app/bench/bake_workloads.hpp"
#include "app/bench/process_memory.hpp"
#include "app/bench/suite.hpp"
#include "bake/bake.hpp"
#include "bake/bare_rays.hpp"
#include "bake/seconds.hpp"
#include "bake/stretch.hpp"
#include "bake/unit_light.hpp"
#include "core/random.hpp"

namespace lucerna::app::bench {
namespace {

namespace fs = std::filesystem;
using bake::Clock, bake::secondsSince;

// How much of each load engines share and rates are taken from.
struct Sampled {
  std::size_t rays;  // recorded of each engine; of Embree unless that takes longer than
  double recordingSeconds;
  double seconds;  // of both engines in turns
};
Sampled sampled(bool quick) {
  return quick ? Sampled{.rays = 200'000, .recordingSeconds = 2, .seconds = 1}
               : Sampled{.rays = 1'000'000, .recordingSeconds = 15, .seconds = 20};
}

// A folder for one bake, removed with the object.
class BakeFolder {
 public:
  BakeFolder(fs::path path) : path_(std::move(path)) {}
  ~BakeFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  BakeFolder(const BakeFolder&) = delete;
  BakeFolder& operator=(const BakeFolder&) = delete;
  const fs::path& path() const { return path_; }

  static Result<std::unique_ptr<BakeFolder>> make() {
    std::string pattern = (fs::temp_directory_path() / "lucerna-bench-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      return error(ErrorKind::Failed, "{}: no folder can be made for the maps", pattern);
    return std::make_unique<BakeFolder>(pattern);
  }

 private:
  fs::path path_;
};

double mib(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

// ---- the light stage in full ----

void count(Measurement& m, const LoadPlan& load, const bake::BakeReport& report) {
  const bake::Plan& plan = load.plan;
  const double maps = plan.packed.packing.maps, side = plan.settings.pack.side;
  m.count("lights", static_cast<double>(load.lights));
  m.count("maps", maps);
  m.count("texels", static_cast<double>(plan.texels()));
  m.count("pairs", static_cast<double>(report.counters.pairs));
  m.count("rays", static_cast<double>(report.counters.rays));
  m.count("thesis_pairs", static_cast<double>(load.lights) * maps * side * side);
  m.count("sampling_s", report.samplingSeconds);
  m.count("shading_s", report.counters.shadingSeconds);
  m.count("tracing_s", report.counters.tracingSeconds);
  m.count("finish_s", report.seconds.finish);
}

// before: bytes that the process held before the plan was made.
Status measureLight(SceneRun& run, const Load& load, const LoadPlan& planned,
                    std::uint64_t before) {
  LUCERNA_TRY(folder, BakeFolder::make());
  bake::BakeReport report;
  LUCERNA_TRY_VOID(bake::prepareFolder(folder->path(), false, {}));
  const auto since = [&](std::uint64_t bytes) { return mib(bytes - std::min(bytes, before)); };
  const bool known = forgetPeak();
  const double planMib = since(residentBytes());
  LUCERNA_TRY_VOID(bake::lightShard(planned.plan, folder->path(), {}, report));
  const double lightMib = since(peakResidentBytes());
  forgetPeak();
  LUCERNA_TRY_VOID(bake::finish(planned.plan, folder->path(), report));
  Measurement& m = run.results.at({kLight, std::string(load.name), run.name});
  m.add(1e3 * report.seconds.light, 1e3 * (report.samplingSeconds + report.counters.shadingSeconds +
                                           report.counters.tracingSeconds));
  count(m, planned, report);
  if (known) {
    m.count("plan_mib", planMib);
    m.count("light_peak_mib", lightMib);
    m.count("finish_peak_mib", since(peakResidentBytes()));
  }
  return {};
}

// ---- a sample of it, on one thread ----

// Passes rays on, and keeps them if it is to.
class RecordingTracer final : public bake::ShadowTracer {
 public:
  explicit RecordingTracer(std::unique_ptr<bake::ShadowTracer> tracer)
      : tracer_(std::move(tracer)) {}
  void trace(const bake::ShadowRays& rays, std::span<vec3> shares) const override {
    if (record && calls_++ % every == 0 && kept_ < most) {
      record->push_back(rays);
      kept_ += rays.size();
    }
    tracer_->trace(rays, shares);
  }
  std::vector<bake::ShadowRays>* record = nullptr;             // null: nothing is kept
  std::size_t every = 1;                                       // so many lists one is kept
  std::size_t most = std::numeric_limits<std::size_t>::max();  // rays

 private:
  std::unique_ptr<bake::ShadowTracer> tracer_;
  mutable std::size_t calls_ = 0, kept_ = 0;
};

struct Cost {
  double sampling = 0, shading = 0, tracing = 0;  // s
  double pairs = 0, rays = 0;
  double all() const { return sampling + shading + tracing; }
};

// One thread's work on a load by one engine.
class EngineWork {
 public:
  EngineWork(const bake::Plan& plan, bake::Engine engine) : plan_(plan), scene_(plan, engine) {
    auto tracer = std::make_unique<RecordingTracer>(std::move(scene_.tracer));
    recorder = tracer.get();
    scene_.tracer = std::move(tracer);
    lighter_.emplace(plan, scene_);
  }
  Cost light(std::uint32_t unit) {
    const bake::LightCounters before = lighter_->counters();
    const double sampling = lighter_->samplingSeconds;
    lighter_->light(plan_.units[unit]);
    const bake::LightCounters& after = lighter_->counters();
    return {.sampling = lighter_->samplingSeconds - sampling,
            .shading = after.shadingSeconds - before.shadingSeconds,
            .tracing = after.tracingSeconds - before.tracingSeconds,
            .pairs = static_cast<double>(after.pairs - before.pairs),
            .rays = static_cast<double>(after.rays - before.rays)};
  }
  RecordingTracer* recorder = nullptr;  // scene_ has it

 private:
  const bake::Plan& plan_;
  bake::LightScene scene_;
  std::optional<bake::UnitLighter> lighter_;
};

// Both engines, and all units in an order of chance.
struct Bench {
  Bench(const bake::Plan& plan, std::uint64_t seed)
      : embree(plan, bake::Engine::Embree),
        octree(plan, bake::Engine::Octree),
        units(plan.units.size()) {
    std::iota(units.begin(), units.end(), 0u);
    Random random(seed, 91);
    for (auto i = static_cast<std::uint32_t>(units.size()); i > 1; --i)
      std::swap(units[i - 1], units[random.below(i)]);
  }
  EngineWork embree, octree;
  std::vector<std::uint32_t> units;
};

// Of the first units those that Embree has rays in, until these are enough or time is up; and the
// rays.
std::vector<std::uint32_t> record(Bench& bench, const Sampled& wanted,
                                  std::vector<bake::ShadowRays>& lists) {
  bench.embree.recorder->record = &lists;
  const auto start = Clock::now();
  std::vector<std::uint32_t> units;
  std::size_t found = 0;
  for (const std::uint32_t unit : bench.units) {
    const bool late = found > 0 && secondsSince(start) > wanted.recordingSeconds;
    if (late || found >= wanted.rays || Progress::cancelled()) break;
    const auto rays = static_cast<std::size_t>(bench.embree.light(unit).rays);
    if (rays > 0) units.push_back(unit);
    found += rays;
  }
  bench.embree.recorder->record = nullptr;
  return units;
}

double sumOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// One engine's work on each unit of a sample.
struct Sample {
  std::vector<double> seconds, shading, tracing, pairs, rays;
  void add(const Cost& cost) {
    seconds.push_back(cost.all());
    shading.push_back(cost.shading);
    tracing.push_back(cost.tracing);
    pairs.push_back(cost.pairs);
    rays.push_back(cost.rays);
  }
};

// What tracing takes goes with Embree's pairs, all else with the texels.
struct Sizes {
  std::vector<double> pairs, texels;  // of the units of the sample
  double allPairs = 0, allTexels = 0;
  std::size_t units = 0;
};

void addEstimate(Measurement& m, const std::string& name, const Estimate& estimate) {
  m.count("all_" + name, estimate.total);
  m.count("all_" + name + "_error", estimate.error);
}

void addEngine(Measurement& m, const Sample& sample, const Sizes& sizes) {
  m.add(1e3 * sumOf(sample.seconds), 1e3 * sumOf(sample.seconds));
  m.count("units", static_cast<double>(sample.seconds.size()));
  m.count("pairs", sumOf(sample.pairs));
  m.count("rays", sumOf(sample.rays));
  m.count("tracing_s", sumOf(sample.tracing));
  m.count("shading_s", sumOf(sample.shading));
  if (sizes.allPairs <= 0) return;
  const auto byPairs = [&](std::span<const double> cost) {
    return estimateTotal(cost, sizes.pairs, sizes.allPairs, sizes.units);
  };
  addEstimate(m, "tracing_s", byPairs(sample.tracing));
  addEstimate(m, "rays", byPairs(sample.rays));
  addEstimate(m, "shading_s",
              estimateTotal(sample.shading, sizes.texels, sizes.allTexels, sizes.units));
  m.count("share", byPairs(sample.tracing).share);
}

// Both engines on the same units, in turns, for so long. Keeps rays of the octree's.
void measureEngines(SceneRun& run, const Load& load, const bake::Plan& plan, Bench& bench,
                    std::vector<bake::ShadowRays>& octreeRays) {
  const Sampled wanted = sampled(run.results.context.quick);
  bench.octree.recorder->record = &octreeRays;
  bench.octree.recorder->every = 16;
  bench.octree.recorder->most = wanted.rays;
  const std::string name(load.name);
  Sizes sizes{.pairs = {},
              .texels = {},
              .allTexels = static_cast<double>(plan.texels()),
              .units = plan.units.size()};
  if (const auto all = run.results.samples({kLight, name, run.name}, "pairs"); !all.empty())
    sizes.allPairs = all.back();
  Sample embree, octree;
  const auto start = Clock::now();
  for (const std::uint32_t unit : bench.units) {
    if (Progress::cancelled() || (sizes.pairs.size() > 1 && secondsSince(start) > wanted.seconds))
      break;
    const bool octreeFirst = sizes.pairs.size() % 2 == 1;
    if (octreeFirst) octree.add(bench.octree.light(unit));
    const Cost cost = bench.embree.light(unit);
    embree.add(cost);
    if (!octreeFirst) octree.add(bench.octree.light(unit));
    sizes.pairs.push_back(cost.pairs);
    sizes.texels.push_back(plan.units[unit].texels);
  }
  bench.octree.recorder->record = nullptr;
  addEngine(run.results.at({kEngine, kEmbree, name, run.name}), embree, sizes);
  addEngine(run.results.at({kEngine, kOctree, name, run.name}), octree, sizes);
}

void addRate(SceneRun& run, const std::string& how, const Load& load, double rays, double seconds) {
  if (rays <= 0 || seconds <= 0) return;
  Measurement& m = run.results.at({kRate, how, std::string(load.name), run.name});
  m.add(1e3 * seconds, 1e3 * seconds);
  m.count("mrays_s", 1e-6 * rays / seconds);
  m.count("rays", rays);
}

double traceSeconds(const bake::ShadowTracer& tracer, std::span<const bake::ShadowRays> lists) {
  std::vector<vec3> shares;
  const auto start = Clock::now();
  for (const bake::ShadowRays& list : lists) {
    shares.resize(list.size());
    tracer.trace(list, shares);
  }
  return secondsSince(start);
}

void takeTurns(const SceneRun& run, std::span<const std::function<void()>> turns) {
  for (int round = 0; round < run.extent.rounds && !Progress::cancelled(); ++round)
    for (const std::size_t i : turnOrder(turns.size(), static_cast<std::size_t>(round))) turns[i]();
}

// Embree's rays of some units, once more by each, in turns.
void measureRates(SceneRun& run, const Load& load, const bake::Plan& plan, Bench& bench) {
  std::vector<bake::ShadowRays> lists;
  const std::vector<std::uint32_t> units = record(bench, sampled(run.results.context.quick), lists);
  bake::BareRays bare(plan.world, lists), like(plan.world, lists, bake::likeTracer());
  const auto rays = static_cast<double>(bare.count());
  const auto tracer = bake::makeEmbreeTracer(plan.world);
  const auto lightStage = [&] {
    Cost sum;
    for (const std::uint32_t unit : units) {
      const Cost cost = bench.embree.light(unit);
      sum.sampling += cost.sampling;
      sum.shading += cost.shading;
      sum.tracing += cost.tracing;
      sum.rays += cost.rays;
    }
    addRate(run, kTracing, load, sum.rays, sum.tracing);
    addRate(run, kShading, load, sum.rays, sum.tracing + sum.shading);
    addRate(run, kWhole, load, sum.rays, sum.all());
  };
  takeTurns(run, std::vector<std::function<void()>>{
                     [&] { addRate(run, kBarePackets, load, rays, bare.packetSeconds()); },
                     [&] { addRate(run, kLikeTracer, load, rays, like.packetSeconds()); },
                     [&] { addRate(run, kBareSingle, load, rays, bare.singleSeconds()); },
                     [&] { addRate(run, kTracer, load, rays, traceSeconds(*tracer, lists)); },
                     lightStage});
}

// The same rays in an order of chance, in one list.
bake::ShadowRays shuffled(std::span<const bake::ShadowRays> lists, std::uint64_t seed) {
  std::vector<std::array<float, 6>> rays;
  for (const bake::ShadowRays& r : lists)
    for (std::size_t i = 0; i < r.size(); ++i)
      rays.push_back({r.fromX[i], r.fromY[i], r.fromZ[i], r.toX[i], r.toY[i], r.toZ[i]});
  Random random(seed, 92);
  for (auto i = static_cast<std::uint32_t>(rays.size()); i > 1; --i)
    std::swap(rays[i - 1], rays[random.below(i)]);
  bake::ShadowRays result;
  result.resize(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto& r = rays[i];
    result.fromX[i] = r[0], result.fromY[i] = r[1], result.fromZ[i] = r[2];
    result.toX[i] = r[3], result.toY[i] = r[4], result.toZ[i] = r[5];
  }
  return result;
}

// The octree's rays, once more by it and by Embree, in turns.
void measureOctree(SceneRun& run, const Load& load, const bake::Plan& plan,
                   std::span<const bake::ShadowRays> lists) {
  const auto tracer = bake::makeOctreeTracer(plan.world),
             plain = bake::makeOctreeTracer(plan.world, {.mailboxes = false});
  bake::BareRays bare(plan.world, lists);
  const std::vector unsorted{shuffled(lists, run.results.context.seed)};
  const auto rays = static_cast<double>(bare.count());
  takeTurns(run,
            std::vector<std::function<void()>>{
                [&] { addRate(run, kOctreeBare, load, rays, bare.singleSeconds()); },
                [&] { addRate(run, kOctreeRays, load, rays, traceSeconds(*tracer, lists)); },
                [&] { addRate(run, kNoMailboxes, load, rays, traceSeconds(*plain, lists)); },
                [&] { addRate(run, kUnsorted, load, rays, traceSeconds(*tracer, unsorted)); }});
}

// ---- packing ----

// The larger of how much lengths grow and shrink, of all triangles but needles.
double worstStretch(const bake::World& world, const bake::Charts& charts) {
  double worst = 1;
  for (const bake::Chart& chart : charts.charts) {
    const auto indices = world.indicesOf(world.objects[chart.object]);
    const double side = std::max(chart.size.x, chart.size.y) / static_cast<double>(chart.density);
    for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
      std::array<glm::dvec3, 3> inSpace;
      std::array<glm::dvec2, 3> flat;
      for (std::size_t k = 0; k < 3; ++k) {
        inSpace[k] = world.positions[indices[3 * std::size_t{chart.triangles[i]} + k]];
        flat[k] = glm::dvec2(chart.corners[i][k]) / static_cast<double>(chart.density);
      }
      const glm::dvec3 a = inSpace[1] - inSpace[0], b = inSpace[2] - inSpace[0];
      const double longest =
          std::max({glm::length(a), glm::length(b), glm::length(inSpace[2] - inSpace[1])});
      if (glm::length(glm::cross(a, b)) < 1e-5 * side * longest) continue;  // as floats hold it
      const bake::Stretch stretch = bake::stretchOf(inSpace, flat);
      worst = std::max({worst, stretch.most, stretch.least > 0 ? 1 / stretch.least : 1.});
    }
  }
  return worst;
}

void addPacking(SceneRun& run, const std::string& how, const bake::Packing& packing,
                std::span<const bake::TexelMask> masks, int side, double seconds) {
  Measurement& m = run.results.at({kPacking, how, run.name});
  m.add(1e3 * seconds, 1e3 * seconds);
  m.count("charts", static_cast<double>(masks.size()));
  m.count("maps", packing.maps);
  m.count("occupancy", bake::occupancy(packing, masks, side));
}

Status measurePacking(SceneRun& run, float density) {
  const bake::World world = bake::makeWorld(run.scene);
  const bake::PackSettings settings;
  auto start = Clock::now();
  const bake::Charts charts =
      bake::makeCharts(world, {.density = density, .gap = settings.gap, .mostSide = settings.side});
  const double charting = secondsSince(start);
  std::vector<bake::TexelMask> masks;
  std::vector<ivec2> sizes;
  for (const bake::Chart& chart : charts.charts) {
    masks.push_back(bake::coverageOf(chart.corners).mask);
    sizes.push_back(masks.back().size());
  }
  start = Clock::now();
  LUCERNA_TRY(tight, bake::packMasks(masks, settings));
  addPacking(run, kMasks, tight, masks, settings.side, secondsSince(start));
  Measurement& m = run.results.at({kPacking, kMasks, run.name});
  m.count("density", static_cast<double>(density));
  m.count("charting_s", charting);
  m.count("worst_stretch", worstStretch(world, charts));
  start = Clock::now();
  LUCERNA_TRY(loose, bake::pack(sizes, settings));
  addPacking(run, kRectangles, loose, masks, settings.side, secondsSince(start));
  return {};
}

// ---- all of it ----

// inFull: the whole light stage, too. False: the scene has no such lights.
Result<bool> measureLoad(SceneRun& run, const Load& load, float density, bool inFull) {
  forgetPeak();
  const std::uint64_t before = residentBytes();
  const std::uint64_t seed = run.results.context.seed;
  LUCERNA_TRY(planned, planLoad(run.scene, load, density, seed));
  if (planned.lights == 0) return false;
  if (inFull) LUCERNA_TRY_VOID(measureLight(run, load, planned, before));
  Bench bench(planned.plan, seed);
  std::vector<bake::ShadowRays> octreeRays;
  measureEngines(run, load, planned.plan, bench, octreeRays);
  measureRates(run, load, planned.plan, bench);
  measureOctree(run, load, planned.plan, octreeRays);
  if (Progress::cancelled()) return error(ErrorKind::Cancelled, "cancelled while baking");
  return true;
}

Status measure(SceneRun& run) {
  const BakeScene scene = bakeSceneOf(run.name, run.scene);
  const float density = scene.density * (run.results.context.quick ? 0.5f : 1.f);
  const auto loads = scene.tables ? thesisLoads() : thesisLoads().first(scene.rates ? 1 : 0);
  const double share = 1.0 / static_cast<double>(loads.size() + 1);
  LUCERNA_TRY_VOID(measurePacking(run, density));
  run.advance(share);
  for (const Load& load : loads) {
    if (run.results.context.quick && !load.quick) continue;
    LUCERNA_TRY(lit, measureLoad(run, load, density, scene.tables));
    if (!lit && load.lights == LoadLights::Lamps && !load.points)
      LUCERNA_TRY_VOID(measureLoad(run, addedLights(), density, scene.tables));
    run.advance(share);
  }
  return {};
}

}  // namespace

Suite bakeSuite() {
  return {.name = "bake",
          .title = "the baker: light stage, engines, rays a second, packing, memory",
          .scenes = {{.name = "nightcity", .path = "builtin:nightcity"},
                     {.name = "nightcity, turned", .path = "builtin:nightcity?rotate=17&jitter=1"},
                     {.name = "atrium", .path = "builtin:atrium"},
                     {.name = "sponza", .path = "crytek_sponza/gltf/sponza.gltf", .outside = true},
                     {.name = "street-1", .path = "torcs_street-1/street-1.gltf", .outside = true},
                     {.name = "institute",
                      .path = "redeclipse_institute/institute.obj",
                      .outside = true,
                      .quick = false}},
          .full = {.sizes = {}, .rounds = 5},
          .quick = {.sizes = {}, .rounds = 3},
          .measureScene = measure,
          .report = bakeReport};
}

}  // namespace lucerna::app::bench
