// lucerna pipeline list|check|print|graph

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/session.hpp"
#include "command_line.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "graph/schedule.hpp"
#include "render_flags.hpp"
#include "script/shipped.hpp"

namespace lucerna::cli {
namespace {

struct Options {
  std::string pipeline, caps, output;
  std::vector<std::string> sets, plugins;
  uvec2 size{1280, 720};
};

struct Checked {
  graph::Pipeline pipeline;
  graph::Validation validation;
};

Result<Checked> checkPipeline(const Options& options) {
  LUCERNA_TRY(registry, app::makeRegistry(options.plugins));
  LUCERNA_TRY(pipeline, app::readPipeline(registry, options.pipeline, options.sets, 0));
  gpu::Capabilities capabilities = gpu::Capabilities::baseline();
  if (!options.caps.empty()) {
    LUCERNA_TRY(text, readText(options.caps));
    LUCERNA_TRY(read, gpu::Capabilities::fromJson(text, options.caps));
    capabilities = std::move(read);
  }
  graph::Validation validation = graph::validate(pipeline, registry, capabilities);
  return Checked{std::move(pipeline), std::move(validation)};
}

Json faultJson(const graph::Fault& fault) {
  return {{"kind", graph::nameOf(fault.kind)},
          {"severity", fault.severity == graph::Severity::Error ? "error" : "warning"},
          {"place", fault.place},
          {"found", fault.found},
          {"wanted", fault.wanted},
          {"remedy", fault.remedy}};
}

Result<int> check(const Options& options, bool json) {
  LUCERNA_TRY(checked, checkPipeline(options));
  const graph::Validation& validation = checked.validation;
  if (json) {
    Json document{
        {"pipeline", checked.pipeline.name}, {"ok", validation.ok()}, {"faults", Json::array()}};
    for (const graph::Fault& fault : validation.faults)
      document["faults"].push_back(faultJson(fault));
    printJson(document);
    return validation.ok() ? 0 : static_cast<int>(ErrorKind::Pipeline);
  }
  if (!validation.ok()) return error(ErrorKind::Pipeline, "{}", validation.text());
  for (const graph::Fault& fault : validation.faults) log::warning("{}", fault.text());
  const auto running =
      std::ranges::count(validation.plan->rows, false, &graph::ResolvedRow::culled);
  printText(fmt::format("{}: valid, {} of {} passes run\n", checked.pipeline.name, running,
                        checked.pipeline.passes.size()));
  return 0;
}

// What `print` and `graph` need beside the pipeline.
Result<Checked> checkedOrError(const Options& options) {
  LUCERNA_TRY(checked, checkPipeline(options));
  if (!checked.validation.ok()) return error(ErrorKind::Pipeline, "{}", checked.validation.text());
  return checked;
}

Result<int> print(const Options& options, bool json) {
  LUCERNA_TRY(checked, checkedOrError(options));
  const graph::Plan& plan = *checked.validation.plan;
  const graph::Schedule schedule = graph::makeSchedule(plan, options.size);
  std::string text = json ? graph::wiringJson(checked.pipeline, plan, schedule)
                          : graph::printWiring(checked.pipeline, plan, schedule);
  if (!text.ends_with('\n')) text += '\n';
  printText(text);
  return 0;
}

Result<int> graph(const Options& options, bool json) {
  LUCERNA_TRY(checked, checkedOrError(options));
  const graph::Plan& plan = *checked.validation.plan;
  const graph::Schedule schedule = graph::makeSchedule(plan, options.size);
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension != ".svg" && extension != ".dot")
    return error(ErrorKind::Usage, "-o: '{}' ends in '{}'; wanted .svg or .dot", options.output,
                 extension);
  LUCERNA_TRY_VOID(checkFolderOf(options.output, "-o"));
  const auto draw = extension == ".svg" ? graph::toSvg : graph::toDot;
  LUCERNA_TRY_VOID(writeText(options.output, draw(checked.pipeline, plan, schedule)));
  if (json)
    printJson({{"files", {options.output}}, {"pipeline", checked.pipeline.name}});
  else
    log::info("wrote {}", options.output);
  return 0;
}

// The names that --pipeline takes, each with the first line of its comment.
Result<int> list(bool json) {
  Json names = Json::array();
  for (const script::EmbeddedText& pipeline : script::shippedPipelines()) {
    const std::string name = std::filesystem::path(pipeline.name).stem().string();
    names.push_back(name);
    std::string_view comment = pipeline.text.substr(0, pipeline.text.find('\n'));
    if (comment.starts_with("// ")) comment.remove_prefix(3);
    if (!json) printText(fmt::format("{:<18}{}\n", name, comment));
  }
  if (json) printJson({{"pipelines", names}});
  return 0;
}

}  // namespace

void addPipeline(CommandLine& line) {
  CLI::App* group = line.app.add_subcommand("pipeline", "list, check, print or draw pipelines");
  addCommand(line, *group, "list", "the shipped pipelines",
             [&line] { return list(line.talk.json); });
  auto options = std::make_shared<Options>();
  const auto add = [&](const char* name, const char* help,
                       Result<int> (*run)(const Options&, bool)) {
    CLI::App* command = addCommand(line, *group, name, help,
                                   [&line, options, run] { return run(*options, line.talk.json); });
    command->add_option("PIPELINE", options->pipeline, "shipped name, FILE.js or FILE.json")
        ->required();
    addRepeatable(*command, "--set", options->sets, "as of `lucerna render`");
    addPluginFlag(*command, options->plugins);
    command->add_option("--caps", options->caps,
                        "FILE.json: check for this driver (OpenGL 4.5 baseline)");
    command->add_option_function<std::string>(
        "--size",
        [options](const std::string& text) {
          options->size = orUsageError("--size", app::sizeFromText(text));
        },
        "WIDTHxHEIGHT for sizes of textures (1280x720)");
    return command;
  };
  add("check", "every fault at once, with what to do", check);
  add("print", "who reads what from whom, and the textures", print);
  add("graph", "draw passes, textures and their lifetimes", graph)
      ->add_option("-o,--output", options->output, "FILE.svg or FILE.dot")
      ->required();
}

}  // namespace lucerna::cli
