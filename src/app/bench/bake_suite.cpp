// The baker: tables 6.2 to 6.4 of system B's thesis and its memory, beside Embree's bare rate on
// the same rays; the thesis' own engine on a sample of the same work; packing.
#include "app/bench/bake_suite.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "app/bench/bake_workloads.hpp"
#include "app/bench/process_memory.hpp"
#include "app/bench/suite.hpp"
#include "bake/bake.hpp"
#include "bake/bare_rays.hpp"
#include "bake/seconds.hpp"
#include "bake/stretch.hpp"
#include "core/random.hpp"

namespace lucerna::app::bench {
namespace {

namespace fs = std::filesystem;
using bake::Clock, bake::secondsSince;

// How much of each load engines share and rates are taken from.
struct Sampled {
  std::size_t rays;  // recorded, unless that takes longer than
  double recordingSeconds;
  double seconds;  // of both engines in turns
};
Sampled sampled(bool quick) {
  return quick ? Sampled{.rays = 200'000, .recordingSeconds = 2, .seconds = 1}
               : Sampled{.rays = 1'000'000, .recordingSeconds = 15, .seconds = 8};
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

// Asks whichever tracer has its turn, and keeps what it is asked if it is to.
class TurnTracer final : public bake::ShadowTracer {
 public:
  void trace(const bake::ShadowRays& rays, std::span<vec3> shares) const override {
    if (record) record->push_back(rays);
    now->trace(rays, shares);
  }
  const bake::ShadowTracer* now = nullptr;
  std::vector<bake::ShadowRays>* record = nullptr;  // null: nothing is kept
};

struct Cost {
  double sampling = 0, shading = 0, tracing = 0;  // s
  double rays = 0;
  double all() const { return sampling + shading + tracing; }
};

// One thread's work on a load, by both engines.
class Bench {
 public:
  Bench(const bake::Plan& plan, std::uint64_t seed)
      : plan_(plan),
        scene_(plan),
        embree_(std::move(scene_.tracer)),
        octree_(bake::makeOctreeTracer(plan.world)),
        order_(plan.units.size()) {
    auto turns = std::make_unique<TurnTracer>();
    turns_ = turns.get();
    turns_->now = embree_.get();
    scene_.tracer = std::move(turns);
    lighter_.emplace(plan, scene_);
    std::iota(order_.begin(), order_.end(), 0u);
    Random random(seed, 91);
    for (auto i = static_cast<std::uint32_t>(order_.size()); i > 1; --i)
      std::swap(order_[i - 1], order_[random.below(i)]);
  }

  // All units, in an order of chance.
  std::span<const std::uint32_t> units() const { return order_; }
  const bake::ShadowTracer& embree() const { return *embree_; }
  Cost light(std::uint32_t unit, const std::string& engine) {
    turns_->now = engine == kOctree ? octree_.get() : embree_.get();
    const bake::LightCounters before = lighter_->counters();
    const double sampling = lighter_->samplingSeconds;
    lighter_->light(plan_.units[unit]);
    const bake::LightCounters& after = lighter_->counters();
    return {.sampling = lighter_->samplingSeconds - sampling,
            .shading = after.shadingSeconds - before.shadingSeconds,
            .tracing = after.tracingSeconds - before.tracingSeconds,
            .rays = static_cast<double>(after.rays - before.rays)};
  }
  // Of the first units those with rays, until these are enough or time is up; and the rays.
  std::vector<std::uint32_t> record(const Sampled& wanted, std::vector<bake::ShadowRays>& lists) {
    turns_->record = &lists;
    const auto start = Clock::now();
    std::vector<std::uint32_t> units;
    std::size_t found = 0;
    for (const std::uint32_t unit : order_) {
      const bool late = found > 0 && secondsSince(start) > wanted.recordingSeconds;
      if (late || found >= wanted.rays || Progress::cancelled()) break;
      const auto rays = static_cast<std::size_t>(light(unit, kEmbree).rays);
      if (rays > 0) units.push_back(unit);
      found += rays;
    }
    turns_->record = nullptr;
    return units;
  }

 private:
  const bake::Plan& plan_;
  bake::LightScene scene_;
  std::unique_ptr<bake::ShadowTracer> embree_, octree_;
  TurnTracer* turns_ = nullptr;  // scene_ has it
  std::optional<bake::UnitLighter> lighter_;
  std::vector<std::uint32_t> order_;
};

double sumOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Both engines on the same units, in turns, for so long.
void measureEngines(SceneRun& run, const Load& load, const bake::Plan& plan, Bench& bench) {
  const double limit = sampled(run.results.context.quick).seconds;
  std::map<std::string, std::vector<double>> seconds, tracing;
  std::vector<double> rays;
  const auto start = Clock::now();
  for (const std::uint32_t unit : bench.units()) {
    if (Progress::cancelled() || (rays.size() > 1 && secondsSince(start) > limit)) break;
    const bool octreeFirst = rays.size() % 2 == 1;
    for (const std::string& engine :
         {octreeFirst ? kOctree : kEmbree, octreeFirst ? kEmbree : kOctree}) {
      const Cost cost = bench.light(unit, engine);
      seconds[engine].push_back(cost.all());
      tracing[engine].push_back(cost.tracing);
      if (engine == kEmbree) rays.push_back(cost.rays);
    }
  }
  const std::string name(load.name);
  const std::vector<double> allRays = run.results.samples({kLight, name, run.name}, "rays");
  for (const std::string& engine : {kEmbree, kOctree}) {
    Measurement& m = run.results.at({kEngine, engine, name, run.name});
    m.add(1e3 * sumOf(seconds[engine]), 1e3 * sumOf(seconds[engine]));
    m.count("units", static_cast<double>(rays.size()));
    m.count("rays", sumOf(rays));
    m.count("tracing_s", sumOf(tracing[engine]));
    if (allRays.empty()) continue;
    const Estimate all = estimateTotal(tracing[engine], rays, allRays.back(), plan.units.size());
    m.count("all_tracing_s", all.total);
    m.count("all_tracing_error_s", all.error);
    m.count("share", all.share);
  }
}

void addRate(SceneRun& run, const std::string& how, const Load& load, double rays, double seconds) {
  if (rays <= 0 || seconds <= 0) return;
  Measurement& m = run.results.at({kRate, how, std::string(load.name), run.name});
  m.add(1e3 * seconds, 1e3 * seconds);
  m.count("mrays_s", 1e-6 * rays / seconds);
  m.count("rays", rays);
}

// Rays of some units, once more by each, in turns.
void measureRates(SceneRun& run, const Load& load, const bake::Plan& plan, Bench& bench) {
  std::vector<bake::ShadowRays> lists;
  const std::vector<std::uint32_t> units = bench.record(sampled(run.results.context.quick), lists);
  const std::string instructions = bake::likeTracer().instructionSet;
  bake::BareRays bare(plan.world, lists), same(plan.world, lists, {.instructionSet = instructions}),
      like(plan.world, lists, bake::likeTracer());
  const auto rays = static_cast<double>(bare.count());
  std::vector<vec3> shares;
  const std::vector<std::function<void()>> turns{
      [&] { addRate(run, kBarePackets, load, rays, bare.packetSeconds()); },
      [&] { addRate(run, kSameInstructions, load, rays, same.packetSeconds()); },
      [&] { addRate(run, kLikeTracer, load, rays, like.packetSeconds()); },
      [&] { addRate(run, kBareSingle, load, rays, bare.singleSeconds()); },
      [&] {
        const auto start = Clock::now();
        for (const bake::ShadowRays& list : lists) {
          shares.resize(list.size());
          bench.embree().trace(list, shares);
        }
        addRate(run, kTracer, load, rays, secondsSince(start));
      },
      [&] {
        Cost sum;
        for (const std::uint32_t unit : units) {
          const Cost cost = bench.light(unit, kEmbree);
          sum.sampling += cost.sampling;
          sum.shading += cost.shading;
          sum.tracing += cost.tracing;
          sum.rays += cost.rays;
        }
        addRate(run, kTracing, load, sum.rays, sum.tracing);
        addRate(run, kShading, load, sum.rays, sum.tracing + sum.shading);
        addRate(run, kWhole, load, sum.rays, sum.all());
      }};
  for (int round = 0; round < run.extent.rounds && !Progress::cancelled(); ++round)
    for (const std::size_t i : turnOrder(turns.size(), static_cast<std::size_t>(round))) turns[i]();
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
  measureEngines(run, load, planned.plan, bench);
  measureRates(run, load, planned.plan, bench);
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
    if (!lit && load.lights == LoadLights::Lamps)
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
