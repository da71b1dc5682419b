// lucerna bake SCENE -o DIR

#include "bake/bake.hpp"

#include <algorithm>
#include <memory>

#include "bake/bake_order.hpp"
#include "bake/estimate.hpp"
#include "bake/hints.hpp"
#include "bake/map_copies.hpp"
#include "bake/own_files.hpp"
#include "bake/preflight.hpp"
#include "bake/seconds.hpp"
#include "bake_talk.hpp"
#include "command_line.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/time_text.hpp"
#include "lightmap/lightmap.hpp"
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
  std::string left = "nothing was written";  // by this run, if Ctrl-C ends it now
};

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

// Removes what a finished bake has left of its work, not what one of other settings goes on with;
// nothing while others bake there, or where nothing can be removed.
void clearWork(const Options& options, const bake::Plan& plan) {
  const auto lock = bake::FolderLock::take(options.folder, bake::FolderLock::Use::Write);
  if (lock && bake::isOwnWork(plan, options.folder)) bake::removeWork(options.folder);
}

// What a finished bake lacks of the copies. False: it is damaged.
Result<bool> addCopies(Options& options, const bake::Plan& plan) {
  options.left = fmt::format(
      "the lightmap in '{}' is as it was, and some copies lie beside it: the same command writes "
      "them all",
      options.folder);
  const Result<bake::AddedCopies> added = bake::addCopies(plan, options.folder);
  if (!added && added.error().kind != ErrorKind::Input) return added.error();
  if (!added)
    log::warning("{}; this bakes it again", lightmap::faultOf(added.error()));
  else if (added->maps > 0)
    log::info("wrote copies ({}) of {}", bake::copiesText(added->copies),
              counted(added->maps, "map"));
  return added.operator bool();
}

Result<bool> isFinishedWith(Options& options, const bake::Plan& plan,
                            const std::vector<bake::Encoding>& beside) {
  LUCERNA_TRY(sound, addCopies(options, plan));
  if (!sound) return false;
  const Result<bool> finished = bake::isFinished(plan, options.folder);
  if (finished && *finished) {
    clearWork(options, plan);
    log::info("'{}' is finished{}; nothing is left to do", options.folder,
              beside.empty() ? "" : ", and also has copies " + bake::copiesText(beside));
    return true;
  }
  if (!finished && finished.error().kind == ErrorKind::Usage) return finished.error();
  if (!finished) log::warning("{}; this bakes it again", lightmap::faultOf(finished.error()));
  return false;
}

// With --resume: whether nothing is left to do. Copies that are there and not asked for stay; if
// it is baked again, they go.
Result<bool> isFinished(Options& options, bake::Plan& plan) {
  if (!options.resume) return false;
  std::vector<bake::Encoding> all = plan.settings.encodings;
  const std::vector<bake::Encoding> beside = bake::copiesBeside(plan, options.folder);
  all.insert(all.end(), beside.begin(), beside.end());
  std::ranges::sort(all);
  std::swap(all, plan.settings.encodings);
  auto finished = isFinishedWith(options, plan, beside);
  std::swap(all, plan.settings.encodings);
  return finished;
}

Status light(Options& options, const bake::Plan& plan, bake::BakeReport& report) {
  LUCERNA_TRY(lock, bake::prepareFolder(options.folder, options.resume, options.shard));
  LUCERNA_TRY_VOID(bake::keepOrder(options.folder, bake::orderOf(plan, options.scene)));
  options.left = fmt::format("what is lit is kept in '{}': the same command with --resume goes on",
                             options.folder);
  return bake::lightShard(plan, options.folder, options.shard, report);
}

Status finish(const Options& options, const bake::Plan& plan, bake::BakeReport& report) {
  LUCERNA_TRY(lock, bake::FolderLock::take(options.folder, bake::FolderLock::Use::Write));
  // Another process may have finished it between its light and this, and removed the work.
  std::error_code none;
  if (!std::filesystem::exists(bake::orderPath(options.folder), none))
    if (const auto finished = bake::isFinished(plan, options.folder); finished && *finished)
      return {};
  return bake::finish(plan, options.folder, report);
}

Result<bake::BakeReport> lightAndFinish(Options& options, const bake::Plan& plan,
                                        Clock::time_point start) {
  bake::BakeReport report;
  report.seconds.prepare = secondsSince(start);
  LUCERNA_TRY_VOID(light(options, plan, report));
  sayReport(report);
  if (options.shard.count == 1) LUCERNA_TRY_VOID(finish(options, plan, report));
  for (const std::string& warning : report.warnings) log::warning("{}", warning);
  log::info("{} in {}",
            options.shard.count == 1
                ? fmt::format("wrote {}", options.folder)
                : fmt::format("finished shard {} of {} in {}", options.shard.index,
                              options.shard.count, options.folder),
            secondsText(secondsSince(start)));
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
  for (const bake::Preset& preset : bake::kPresets)
    if (options.preset == preset.name) options.bake.sampling = preset.sampling;
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
  document["folder"] = options.folder;
  LUCERNA_TRY(finished, isFinished(options, plan));
  if (finished) {
    document["finished"] = true;
  } else {
    LUCERNA_TRY(report, lightAndFinish(options, plan, start));
    document["finished"] = options.shard.count == 1;
    document["shard"] = fmt::format("{}/{}", options.shard.index, options.shard.count);
    document["bake"] = describe(report);
  }
  if (json) printJson(document);
  return 0;
}

// With the next step after Ctrl-C.
Result<int> bakeOrCancel(Options& options, bool json) {
  auto result = bakeScene(options, json);
  if (result || result.error().kind != ErrorKind::Cancelled) return result;
  return error(ErrorKind::Cancelled, "cancelled; {}", options.left);
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

void addLightFlags(CLI::App& command, Options& options) {
  command.add_option("--reach", options.bake.reach, "m that lights reach at most (as they say)")
      ->check(between(0.01, 1e6, "m"));
  command
      .add_option("--faintest", options.bake.faintest,
                  "brightness of a white surface, at the scene's exposure, where an emitting "
                  "surface's reach ends; 0: --reach alone counts (1/256)")
      ->check(between(0, 1));
  command
      .add_option_function<std::vector<std::string>>(
          "--lights",
          [&options](const std::vector<std::string>& groups) {
            options.asked.groups.emplace();
            if (groups != std::vector<std::string>{"all"}) options.asked.groups = groups;
          },
          "all, or GROUP,GROUP...; always-on is what has none (as the scene's bake hints say, or "
          "all)")
      ->delimiter(',')
      ->transform(trimmed())
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--engine",
          [&options](const std::string& value) {
            options.bake.engine = value == "octree" ? bake::Engine::Octree : bake::Engine::Embree;
          },
          "embree, or octree as the thesis (embree)")
      ->check(oneOf({"embree", "octree"}));
  command
      .add_option_function<std::vector<float>>(
          "--sky",
          [&options](const std::vector<float>& values) {
            if (values.size() != 1 && values.size() != 3)
              throw CLI::ValidationError(
                  "--sky", fmt::format("found {} numbers, wanted one or R,G,B", values.size()));
            options.bake.sky =
                values.size() == 3 ? vec3(values[0], values[1], values[2]) : vec3(values[0]);
          },
          "R,G,B or one radiance of the sky all around (0: none)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(between(0, 1e6));
}

void addFileFlags(CLI::App& command, Options& options) {
  command
      .add_option("--patch-tolerance", options.asked.patchTolerance,
                  "brightness of a white surface, before exposure, by which a group's patch may be "
                  "off (as the scene's bake hints say, or 1/1024 of what shows as white)")
      ->check(between(0, 8));
  command
      .add_option_function<std::vector<std::string>>(
          "--encode",
          [&options](const std::vector<std::string>& names) {
            for (const std::string& name : names)
              options.bake.encodings.push_back(name == "rgb9e5" ? bake::Encoding::Rgb9e5
                                               : name == "bc6h" ? bake::Encoding::Bc6h
                                                                : bake::Encoding::Png);
          },
          "rgb9e5 or bc6h (KTX2) or png copies of the maps beside the EXR masters; several joined "
          "by commas: rgb9e5,png")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Validator(
          [](const std::string& name) {
            const std::string fault = oneOf({"rgb9e5", "bc6h", "png"})(name);
            return fault.empty() ? fault : fault + "; several are joined by commas: rgb9e5,png";
          },
          "{rgb9e5,bc6h,png}"));
}

void addRunFlags(CLI::App& command, Options& options) {
  command.add_flag("--resume", options.resume, "go on where an earlier run stopped");
  command.add_option_function<std::string>(
      "--shard",
      [&options](const std::string& text) {
        options.shard = orUsageError("--shard", shardFromText(text));
      },
      "i/N: the i-th of N parts, which share DIR; then lucerna lightmap merge");
  command.add_flag("--dry-run", options.dryRun,
                   "write nothing; say what would be baked, what it would take and what is odd");
  command.add_option("--threads", options.threads, "CPU threads; 0: one a core (0)")
      ->check(wholeNumber(0, 1024));
}

}  // namespace

void addBake(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      addCommand(line, line.app, "bake", "bake a scene's lights into lightmaps",
                 [&line, options] { return bakeOrCancel(*options, line.talk.json); });
  command->add_option("SCENE", options->scene, sceneHelp())->required();
  command->add_option("-o,--output", options->folder, "folder of the lightmap");
  command->add_option("--preset", options->preset, "preview, standard or final (standard)")
      ->check(oneOf({"preview", "standard", "final"}));
  addChartFlags(*command, options->bake, options->asked);
  addLightFlags(*command, *options);
  addFileFlags(*command, *options);
  addRunFlags(*command, *options);
}

}  // namespace lucerna::cli
