// lucerna bake SCENE -o DIR

#include "bake/bake.hpp"

#include <map>
#include <memory>

#include "bake/bake_order.hpp"
#include "bake/estimate.hpp"
#include "bake/hints.hpp"
#include "bake/preflight.hpp"
#include "bake/seconds.hpp"
#include "command_line.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "scene/load.hpp"

namespace lucerna::cli {
namespace {

using bake::Clock, bake::secondsSince;

struct Options {
  std::string scene, folder, preset = "standard";
  bake::BakeSettings bake;
  bake::Asked asked;
  bake::Shard shard;
  bool resume = false, dryRun = false;
  int threads = 0;
};

// What the presets stand for.
const std::map<std::string, bake::Sampling>& presets() {
  static const std::map<std::string, bake::Sampling> known{
      {"preview", bake::kPreview}, {"standard", bake::kStandard}, {"final", bake::kFinal}};
  return known;
}

// "2/5"
Result<bake::Shard> shardFromText(const std::string& text) {
  bake::Shard shard;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%d/%d%c", &shard.index, &shard.count, &rest);
  if (read != 2 || shard.count < 1 || shard.count > 65536 || shard.index < 1 ||
      shard.index > shard.count)
    return error(ErrorKind::Usage, "found '{}', wanted i/N with i from 1 to N, as 2/5", text);
  return shard;
}

double millions(std::uint64_t count) {
  return static_cast<double>(count) / 1e6;
}

Json describe(const bake::Plan& plan) {
  return {{"scene", plan.world.scene->name},
          {"triangles", plan.world.triangleCount()},
          {"charts", plan.charts.charts.size()},
          {"texels", plan.texels()},
          {"maps", plan.packed.packing.maps},
          {"side", plan.settings.pack.side},
          {"occupancy",
           bake::occupancy(plan.packed.packing, plan.packed.masks, plan.settings.pack.side)},
          {"units", plan.units.size()},
          {"lights", bake::lightCount(plan)},
          {"groups", plan.groups.size() - 1}};
}

Json describe(const bake::SeamSteps& steps) {
  return {
      {"median", steps.median}, {"percentile_99", steps.percentile99}, {"largest", steps.largest}};
}

Json describe(const bake::SeamReport& seams) {
  Json encoded = Json::object();
  for (const bake::EncodedSteps& steps : seams.encoded)
    encoded[steps.encoding == bake::Encoding::Bc6h ? "bc6h" : "rgb9e5"] = describe(steps.after);
  return {{"edges", seams.seams},
          {"texels", seams.texels},
          {"samples", seams.samples},
          {"parts", seams.parts},
          {"most_iterations", seams.mostIterations},
          {"before", describe(seams.before)},
          {"after", describe(seams.after)},
          {"encoded", std::move(encoded)},
          {"seconds", seams.seconds}};
}

Json describe(const bake::BakeReport& report) {
  const bake::LightCounters& c = report.counters;
  return {{"units", report.units},
          {"units_before", report.unitsBefore},
          {"texels", report.texels},
          {"pairs", c.pairs},
          {"rays", c.rays},
          {"seams", describe(report.seams)},
          {"seconds",
           {{"prepare", report.seconds.prepare},
            {"light", report.seconds.light},
            {"finish", report.seconds.finish}}},
          {"cpu_seconds",
           {{"sampling", report.samplingSeconds},
            {"shading", c.shadingSeconds},
            {"tracing", c.tracingSeconds}}}};
}

void sayPlan(const bake::Plan& plan) {
  const Json d = describe(plan);
  log::info("{} triangles in {} charts, {:.1f} million texels in {} maps of {} x {}",
            d["triangles"].get<std::size_t>(), d["charts"].get<std::size_t>(),
            millions(plan.texels()), plan.packed.packing.maps, plan.settings.pack.side,
            plan.settings.pack.side);
}

void sayReport(const bake::BakeReport& report) {
  const bake::LightCounters& c = report.counters;
  log::info(
      "light {:.2f} s: {:.1f} million pairs of light and texel, {:.1f} million rays; of all "
      "threads "
      "{:.2f} s for samples, {:.2f} s for shading, {:.2f} s for rays ({:.1f} million a second)",
      report.seconds.light, millions(c.pairs), millions(c.rays), report.samplingSeconds,
      c.shadingSeconds, c.tracingSeconds, millions(c.rays) / std::max(c.tracingSeconds, 1e-9));
}

Json describe(const bake::Preflight& found) {
  return {{"not_finite", found.notFinite},
          {"huge", found.huge},
          {"degenerate", found.degenerate},
          {"duplicate", found.duplicate},
          {"larger_than_a_map", found.shrunk},
          {"unlit", found.unlit},
          {"moving", found.moving},
          {"bending", found.bending},
          {"lights_inside", found.buried}};
}

Json describe(const bake::Estimate& e) {
  return {{"sampled_units", e.units},        {"sampled_texels", e.texels},
          {"emitter_cells", e.emitterCells}, {"prepare_seconds", e.prepareSeconds},
          {"light_seconds", e.lightSeconds}, {"deviation", e.deviation},
          {"threads", threadCount()},        {"light_bytes", e.lightBytes},
          {"finish_bytes", e.finishBytes},   {"log_bytes", e.logBytes}};
}

std::string estimateText(const bake::Plan& plan, const bake::Estimate& e) {
  const std::size_t charts = plan.charts.charts.size();
  std::string text = fmt::format(
      "charts     {}\ntexels     {}\nmaps       {} of {} x {}, {:.0f} % covered\nlights     ",
      charts, plan.texels(), plan.packed.packing.maps, plan.settings.pack.side,
      plan.settings.pack.side,
      100. * bake::occupancy(plan.packed.packing, plan.packed.masks, plan.settings.pack.side));
  text += fmt::format("{}, in {} groups that switch; {} cells of surfaces that shine\n",
                      bake::lightCount(plan), plan.groups.size() - 1, e.emitterCells);
  text += fmt::format(
      "light      about {:.3g} s after {:.2g} s to prepare, give or take {:.2g} s, on {} threads: "
      "an "
      "estimate, by {} of {} units\n",
      e.lightSeconds, e.prepareSeconds, 2. * e.deviation, threadCount(), e.units,
      plan.units.size());
  if (e.lightBytes != 0)
    text += fmt::format("memory     about {} while lighting, {} while writing maps\n",
                        bytesText(e.lightBytes), bytesText(e.finishBytes));
  return text +
         fmt::format("logs       about {}, until the maps are written\n", bytesText(e.logBytes));
}

// How long the sample of --dry-run takes.
constexpr double kSampleSeconds = 1.;

Result<int> dryRun(const bake::Plan& plan, bool json) {
  const bake::Preflight found = bake::inspect(plan);
  for (const std::string& sentence : found.sentences()) log::warning("{}", sentence);
  LUCERNA_TRY(estimate, bake::estimate(plan, kSampleSeconds));
  if (json) {
    Json document = describe(plan);
    document["found"] = describe(found);
    document["estimate"] = describe(estimate);
    printJson(document);
  } else {
    printText(estimateText(plan, estimate));
  }
  return 0;
}

// With --resume: whether nothing is left to do.
Result<bool> isFinished(const Options& options, const bake::Plan& plan) {
  if (!options.resume) return false;
  const Result<bool> finished = bake::isFinished(plan, options.folder);
  if (finished && *finished) {
    if (!bake::isUnderWay(options.folder)) bake::removeWork(options.folder);
    log::info("'{}' is finished; nothing is left to do", options.folder);
    return true;
  }
  if (!finished && finished.error().kind == ErrorKind::Usage) return finished.error();
  if (!finished) log::warning("{}: it is baked again now", finished.error().message);
  return false;
}

Result<bake::BakeReport> lightAndFinish(const Options& options, const bake::Plan& plan,
                                        Clock::time_point start) {
  LUCERNA_TRY_VOID(bake::prepareFolder(options.folder, options.resume, options.shard));
  LUCERNA_TRY_VOID(bake::keepOrder(options.folder, bake::orderOf(plan, options.scene)));
  bake::BakeReport report;
  report.seconds.prepare = secondsSince(start);
  LUCERNA_TRY_VOID(bake::lightShard(plan, options.folder, options.shard, report));
  sayReport(report);
  if (options.shard.count == 1) LUCERNA_TRY_VOID(bake::finish(plan, options.folder, report));
  for (const std::string& warning : report.warnings) log::warning("{}", warning);
  log::info("{} in {:.1f} s",
            options.shard.count == 1
                ? fmt::format("wrote {}", options.folder)
                : fmt::format("finished shard {} of {} in {}", options.shard.index,
                              options.shard.count, options.folder),
            secondsSince(start));
  return report;
}

Status checkOutput(const Options& options) {
  if (options.folder.empty())
    return error(ErrorKind::Usage,
                 "-o: found no folder for the lightmap; wanted -o DIR, or --dry-run to write none");
  LUCERNA_TRY_VOID(bake::checkIsApart(options.folder, options.scene));
  return bake::checkFolder(options.folder, options.resume, options.shard);
}

Result<int> bakeScene(Options& options, bool json) {
  const auto start = Clock::now();
  setThreadCount(options.threads);
  options.bake.sampling = presets().at(options.preset);
  if (!options.dryRun) LUCERNA_TRY_VOID(checkOutput(options));
  LUCERNA_TRY(scene, scene::loadScene(options.scene));
  for (const std::string& warning : scene.warnings) log::warning("{}", warning);
  scene::animate(scene, 0.f);
  LUCERNA_TRY(settings, bake::withHints(options.bake, options.asked, scene));
  LUCERNA_TRY(plan, bake::makePlan(scene, settings));
  for (const std::string& warning : plan.warnings) log::warning("{}", warning);
  if (options.dryRun) return dryRun(plan, json);
  sayPlan(plan);
  Json document = describe(plan);
  LUCERNA_TRY(finished, isFinished(options, plan));
  if (finished) {
    document["finished"] = true;
  } else {
    LUCERNA_TRY(report, lightAndFinish(options, plan, start));
    document["finished"] = options.shard.count == 1;
    document["bake"] = describe(report);
  }
  if (json) printJson(document);
  return 0;
}

void addChartFlags(CLI::App& command, bake::BakeSettings& settings, bake::Asked& asked) {
  command.add_option("--density", settings.density, "texels a metre (10)")
      ->check(between(1e-3, 1e5, "texels/m"));
  command
      .add_option("--size", asked.side,
                  "texels along each side of a map (as the scene's bake hints say, or 2048)")
      ->check(wholeNumber(16, 16384));
  command.add_option("--most-maps", settings.pack.mostMaps, "more maps are an error (256)")
      ->check(wholeNumber(1, 4096));
  command.add_option("--padding", settings.pack.gap, "texels between charts (2)")
      ->check(wholeNumber(1, 64));
  command
      .add_option_function<std::string>(
          "--unwrap",
          [&](const std::string& value) {
            settings.unwrap = value == "pairs" ? bake::Unwrap::Pairs : bake::Unwrap::Charts;
          },
          "charts, or pairs of right-angled triangles as the thesis (charts)")
      ->check(oneOf({"charts", "pairs"}));
}

}  // namespace

void addBake(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App* command = addCommand(line, line.app, "bake", "bake a scene's lights into lightmaps",
                                 [&line, options] { return bakeScene(*options, line.talk.json); });
  command->add_option("SCENE", options->scene, sceneHelp())->required();
  command->add_option("-o,--output", options->folder, "folder of the lightmap");
  command->add_option("--preset", options->preset, "preview, standard or final (standard)")
      ->check(oneOf({"preview", "standard", "final"}));
  addChartFlags(*command, options->bake, options->asked);
  command->add_option("--reach", options->bake.reach, "m that lights reach at most (as they say)")
      ->check(between(0.01, 1e6, "m"));
  command
      ->add_option("--faintest", options->bake.faintest,
                   "brightness of a white surface, at the scene's exposure, where an emitting "
                   "surface's reach ends; 0: --reach alone counts (1/256)")
      ->check(between(0, 1));
  command
      ->add_option_function<std::vector<std::string>>(
          "--lights",
          [options](const std::vector<std::string>& groups) {
            options->asked.groups.emplace();
            if (groups != std::vector<std::string>{"all"}) options->asked.groups = groups;
          },
          "all, or GROUP,GROUP...; always-on is what has none (as the scene's bake hints say, or "
          "all)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--patch-tolerance", options->asked.patchTolerance,
                   "brightness of a white surface by which a group's patch may be off (as the "
                   "scene's bake hints say, or 1/1024 of white)")
      ->check(between(0, 8));
  command
      ->add_option_function<std::string>(
          "--engine",
          [options](const std::string& value) {
            options->bake.engine = value == "octree" ? bake::Engine::Octree : bake::Engine::Embree;
          },
          "embree, or octree as the thesis (embree)")
      ->check(oneOf({"embree", "octree"}));
  command
      ->add_option_function<std::vector<float>>(
          "--sky",
          [options](const std::vector<float>& values) {
            if (values.size() != 1 && values.size() != 3)
              throw CLI::ValidationError(
                  "--sky", fmt::format("found {} numbers, wanted one or R,G,B", values.size()));
            options->bake.sky =
                values.size() == 3 ? vec3(values[0], values[1], values[2]) : vec3(values[0]);
          },
          "R,G,B or one radiance of the sky all around (0: none)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(between(0, 1e6));
  command
      ->add_option_function<std::vector<std::string>>(
          "--encode",
          [options](const std::vector<std::string>& names) {
            for (const std::string& name : names)
              options->bake.encodings.push_back(name == "rgb9e5" ? bake::Encoding::Rgb9e5
                                                : name == "bc6h" ? bake::Encoding::Bc6h
                                                                 : bake::Encoding::Png);
          },
          "rgb9e5, bc6h (KTX2) and png copies of the maps, beside the EXR masters")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(oneOf({"rgb9e5", "bc6h", "png"}));
  command->add_flag("--resume", options->resume, "go on where an earlier run stopped");
  command->add_option_function<std::string>(
      "--shard",
      [options](const std::string& text) {
        options->shard = orUsageError("--shard", shardFromText(text));
      },
      "i/N: the i-th of N parts, which share DIR; then lucerna lightmap merge");
  command->add_flag("--dry-run", options->dryRun,
                    "write nothing; say what would be baked, what it would take and what is odd");
  command->add_option("--threads", options->threads, "CPU threads; 0: one a core (0)")
      ->check(wholeNumber(0, 1024));
}

}  // namespace lucerna::cli
