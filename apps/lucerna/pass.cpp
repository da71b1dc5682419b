// lucerna pass list|show

#include <memory>

#include "app/session.hpp"
#include "command_line.hpp"
#include "core/text.hpp"
#include "graph/value_check.hpp"
#include "render_flags.hpp"

namespace lucerna::cli {
namespace {

constexpr const char* kDirections[] = {"in", "out", "in and out"};
constexpr const char* kFrequencies[] = {"per scene", "per group of views", "per view"};

Json valueJson(const graph::Value& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

Json paramJson(const graph::ParamDescription& param) {
  Json json{{"name", param.name},
            {"type", graph::nameOf(param.type)},
            {"default", valueJson(param.defaultValue)}};
  if (param.min) json["min"] = *param.min;
  if (param.max) json["max"] = *param.max;
  if (!param.unit.empty()) json["unit"] = param.unit;
  if (!param.choices.empty()) json["choices"] = param.choices;
  json["rebuilds"] = graph::nameOf(param.rebuild);
  json["help"] = param.help;
  return json;
}

std::string standInText(const graph::StandIn& standIn) {
  using Kind = graph::StandIn::Kind;
  if (standIn.kind == Kind::None) return "";
  if (standIn.kind == Kind::PassThrough) return fmt::format("the input '{}'", standIn.input);
  return fmt::format("({:g}, {:g}, {:g}, {:g})", standIn.fill.x, standIn.fill.y, standIn.fill.z,
                     standIn.fill.w);
}

Json portJson(const graph::PortDescription& port) {
  Json json{
      {"name", port.name},        {"direction", kDirections[static_cast<int>(port.direction)]},
      {"type", port.type.text()}, {"optional", port.optional},
      {"history", port.history},  {"persistent", port.persistent},
      {"halo", port.halo}};
  if (!port.sameSizeAs.empty()) json["same_size_as"] = port.sameSizeAs;
  if (const std::string text = standInText(port.standIn); !text.empty())
    json["when_disabled"] = text;
  json["help"] = port.help;
  return json;
}

Json passJson(const graph::PassDescription& pass) {
  Json json{{"type", pass.type},
            {"summary", pass.summary},
            {"runs", kFrequencies[static_cast<int>(pass.frequency)]},
            {"features", pass.features},
            {"ports", Json::array()},
            {"params", Json::array()}};
  for (const graph::PortDescription& port : pass.ports) json["ports"].push_back(portJson(port));
  for (const graph::ParamDescription& param : pass.params)
    json["params"].push_back(paramJson(param));
  return json;
}

std::string paramText(const graph::ParamDescription& param) {
  std::string text = fmt::format("  {:20} {} = {}", param.name, graph::nameOf(param.type),
                                 graph::toText(param.defaultValue));
  if (param.min && param.max) text += fmt::format(", {:g} to {:g}", *param.min, *param.max);
  if (!param.unit.empty()) text += " " + param.unit;
  if (!param.choices.empty()) text += ", one of " + join(param.choices);
  return text + (param.help.empty() ? "\n" : fmt::format("\n  {:20} {}\n", "", param.help));
}

std::string passText(const graph::PassDescription& pass) {
  std::string text = fmt::format("{}: {}\nRuns {}.\n", pass.type, pass.summary,
                                 kFrequencies[static_cast<int>(pass.frequency)]);
  if (!pass.features.empty()) text += fmt::format("Needs {}.\n", join(pass.features));
  text += "\nPorts\n";
  for (const graph::PortDescription& port : pass.ports) {
    text += fmt::format(
        "  {:20} {}, {}{}{}\n", port.name, kDirections[static_cast<int>(port.direction)],
        port.type.text(), port.optional ? ", optional" : "",
        port.sameSizeAs.empty() ? "" : fmt::format(", as large as '{}'", port.sameSizeAs));
    if (!port.help.empty()) text += fmt::format("  {:20} {}\n", "", port.help);
    if (const std::string standIn = standInText(port.standIn); !standIn.empty())
      text += fmt::format("  {:20} When the pass is disabled: {}.\n", "", standIn);
  }
  text += pass.params.empty() ? "\nNo parameters.\n" : "\nParameters\n";
  for (const graph::ParamDescription& param : pass.params) text += paramText(param);
  return text;
}

struct Options {
  std::string type;  // of `show`
  std::vector<std::string> sets, plugins;
};

Result<int> list(const Options& options, bool json) {
  LUCERNA_TRY(registry, app::makeRegistry(options.plugins));
  Json document = Json::array();
  std::string text;
  for (const std::string& type : registry.typeNames()) {
    const graph::PassDescription pass = registry.find(type)->describe({});
    document.push_back({{"type", type}, {"summary", pass.summary}});
    text += fmt::format("{:20} {}\n", type, pass.summary);
  }
  if (json)
    printJson(document);
  else
    printText(text);
  return 0;
}

// The description of a row with these settings.
Result<graph::PassDescription> describe(const graph::Registry& registry, const Options& options) {
  graph::Pipeline pipeline;
  graph::PassRow& row = pipeline.passes.emplace_back();
  row.name = row.type = options.type;
  for (const std::string& set : options.sets)
    LUCERNA_TRY_VOID(graph::applySetting(pipeline, registry, options.type + "." + set));
  graph::PassDescription pass =
      graph::describeChecked(*registry.find(options.type), pipeline.passes[0].params);
  std::vector<std::string> faults;
  for (const graph::DescriptionFault& fault : pass.faults)
    faults.push_back(fmt::format("parameter '{}': found {}; wanted {}; {}", fault.param,
                                 fault.found, fault.wanted, fault.remedy));
  if (!faults.empty()) return error(ErrorKind::Pipeline, "{}", join(faults, "\n"));
  return pass;
}

Result<int> show(const Options& options, bool json) {
  const std::string& type = options.type;
  LUCERNA_TRY(registry, app::makeRegistry(options.plugins));
  if (!registry.find(type)) {
    const std::vector<std::string> names = registry.typeNames();
    return error(ErrorKind::Usage, "there is no pass '{}'{}; there are {}", type,
                 didYouMean(type, names), join(names));
  }
  LUCERNA_TRY(pass, describe(registry, options));
  if (json)
    printJson(passJson(pass));
  else
    printText(passText(pass));
  return 0;
}

}  // namespace

void addPass(CommandLine& line) {
  CLI::App* group = line.app.add_subcommand("pass", "the passes that pipelines are made of");
  auto options = std::make_shared<Options>();
  CLI::App* all = addCommand(line, *group, "list", "every pass and what it does",
                             [&line, options] { return list(*options, line.talk.json); });
  addPluginFlag(*all, options->plugins);
  CLI::App* one = addCommand(line, *group, "show", "ports and parameters of a pass",
                             [&line, options] { return show(*options, line.talk.json); });
  one->add_option("NAME", options->type, "type of the pass")->required();
  addPluginFlag(*one, options->plugins);
  addRepeatable(*one, "--set", options->sets,
                "param=value: for these values, on which ports may depend; repeatable");
}

}  // namespace lucerna::cli
