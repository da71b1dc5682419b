// lucerna bench SUITE -o results/

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/bench/suite.hpp"
#include "command_line.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "render_flags.hpp"

namespace lucerna::cli {
namespace {

using app::bench::Results;
using app::bench::Suite;

const std::string kAll = "all";

struct Options {
  std::string suite, output;
  app::bench::BenchOptions bench;
};

int list(bool json) {
  Json document = Json::array();
  std::string text;
  for (const Suite& suite : app::bench::suites()) {
    document.push_back({{"suite", suite.name}, {"title", suite.title}});
    text += fmt::format("{:14} {}\n", suite.name, suite.title);
  }
  text += fmt::format("{:14} one after the other\n", kAll);
  if (json)
    printJson(document);
  else
    printText(text);
  return 0;
}

Result<std::vector<Suite>> chosen(const std::string& name) {
  std::vector<std::string> names{kAll};
  std::vector<Suite> found;
  for (const Suite& suite : app::bench::suites()) {
    names.emplace_back(suite.name);
    if (name == kAll || name == suite.name) found.push_back(suite);
  }
  if (!found.empty()) return found;
  return error(ErrorKind::Usage, "there is no suite '{}'{}; there are {}", name,
               didYouMean(name, names), join(names));
}

Status checkOutput(const std::string& folder) {
  if (folder.empty())
    return error(ErrorKind::Usage, "bench: --output is required: a folder for the tables");
  std::error_code noFolder;
  std::filesystem::create_directories(folder, noFolder);
  if (!noFolder) return {};
  return error(ErrorKind::Usage, "--output: '{}' cannot be made a folder: {}", folder,
               noFolder.message());
}

bool nothingMeasured(const std::vector<Results>& results) {
  return std::ranges::all_of(results, [](const Results& r) { return r.measurements.empty(); });
}

std::optional<ErrorKind> firstFailure(const std::vector<Results>& results) {
  for (const Results& r : results)
    if (r.failed) return r.failed;
  return std::nullopt;
}

int exitCode(const std::vector<Results>& results) {
  if (results.back().cancelled) {
    log::error("cancelled; the tables hold the scenes measured so far");
    return static_cast<int>(ErrorKind::Cancelled);
  }
  const auto failure = firstFailure(results);
  if (!failure) return 0;
  return static_cast<int>(nothingMeasured(results) ? *failure : ErrorKind::Failed);
}

Result<int> bench(const Options& options, bool json) {
  if (options.suite.empty()) return list(json);
  LUCERNA_TRY(suites, chosen(options.suite));
  LUCERNA_TRY_VOID(checkScenes(options.bench));
  LUCERNA_TRY_VOID(checkOutput(options.output));
  std::vector<Results> results;
  std::vector<std::string> files;
  for (const Suite& suite : suites) {
    results.push_back(run(suite, options.bench));
    const bool cancelled = results.back().cancelled;
    if (!cancelled && nothingMeasured(results) && firstFailure(results)) continue;
    LUCERNA_TRY(written, writeResults(options.output, options.suite, results));
    files = std::move(written);
    if (cancelled) break;
  }
  const int code = exitCode(results);
  if (files.empty()) return code;
  if (json)
    printJson({{"files", files},
               {"cancelled", results.back().cancelled},
               {"failed", firstFailure(results).has_value()}});
  else
    log::info("wrote {}", join(files));
  return code;
}

}  // namespace

void addBench(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      addCommand(line, line.app, "bench", "measure passes: times, counts and errors",
                 [&line, options] { return bench(*options, line.talk.json); });
  app::bench::BenchOptions& bench = options->bench;
  command->add_option("SUITE", options->suite, "which, or all; without it they are listed");
  command->add_option("-o,--output", options->output,
                      "folder for SUITE.json, SUITE.md and SUITE.html");
  command->add_flag("--quick", bench.quick, "small pictures, few cameras, fewer scenes");
  addRepeatable(*command, "--scene", bench.scenes, sceneHelp() + ", instead of the suite's");
  command
      ->add_option("--scene-folder", bench.sceneFolder,
                   "where the suites' scenes lie that do not come with Lucerna")
      ->envname("LUCERNA_SCENE_FOLDER");
  command
      ->add_option_function<std::vector<std::string>>(
          "--size",
          [&bench](const std::vector<std::string>& sizes) {
            for (const std::string& size : sizes)
              bench.sizes.push_back(orUsageError("--size", app::sizeFromText(size)));
          },
          "WIDTHxHEIGHT instead of the suite's; repeatable")
      ->allow_extra_args(false);
  command
      ->add_option_function<int>(
          "--cameras", [&bench](int count) { bench.cameras = count; }, "places to look from")
      ->check(wholeNumber(1, 1000));
  command
      ->add_option_function<int>(
          "--rounds", [&bench](int count) { bench.rounds = count; },
          "turns of every variant at each place, after one to warm up")
      ->check(wholeNumber(1, 1000));
  command->add_option("--seed", bench.render.seed, "seed of the cameras and of all else random (0)")
      ->check(wholeNumber(0, std::numeric_limits<std::uint64_t>::max()));
  command->add_option("--threads", bench.render.threads, "CPU threads; 0: one a core (0)")
      ->check(wholeNumber(0, 1024));
  command->add_option("--shaders", bench.render.shaderFolder,
                      "folder like src/ whose shaders go before the built-in ones");
}

}  // namespace lucerna::cli
