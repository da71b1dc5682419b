#include "command_line.hpp"

#include <charconv>
#include <cstdio>

#include "core/text.hpp"
#include "scene/builtin/builtin.hpp"

namespace lucerna::cli {
namespace {

std::string fullName(const CLI::App& app) {
  return app.get_parent() ? fullName(*app.get_parent()) + " " + app.get_name() : app.get_name();
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::vector<std::string> subcommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(subcommand->get_name());
  return names;
}

// About one word that nobody took.
std::string describeExtra(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> subcommands = subcommandNames(app);
  if (word.size() > 1 && word[0] == '-') {
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("unknown option '{}'{}", name, didYouMean(name, optionNames(app)));
  }
  if (!subcommands.empty())
    return fmt::format("unknown subcommand '{}'{}; there are {}", word,
                       didYouMean(word, subcommands), join(subcommands));
  return fmt::format("unexpected argument '{}'", word);
}

// What CLI11 found, without its jargon.
std::string describeFault(const CLI::ParseError& fault) {
  std::string text = fault.what();  // "--size: 1 required TEXT missing"
  if (!dynamic_cast<const CLI::ArgumentMismatch*>(&fault)) return text;
  const std::string option = text.substr(0, text.find(": "));
  return text.ends_with("missing") ? option + ": found nothing after it, wanted a value"
                                   : option + ": found more than one, wanted one";
}

}  // namespace

std::string sceneHelp() {
  return fmt::format("file, or builtin:NAME?key=value with NAME {}", join(scene::builtinNames()));
}

const CLI::App& chosenCommand(const CLI::App& app) {
  const auto subcommands = app.get_subcommands();
  return subcommands.empty() ? app : chosenCommand(*subcommands.front());
}

CLI::App* addCommand(CommandLine& line, CLI::App& parent, const std::string& name,
                     const std::string& help, Action action) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->add_flag("--json", line.talk.json, "print exactly one JSON document on stdout");
  command->add_flag("--quiet", line.talk.quiet, "only errors on stderr");
  command->add_flag("--verbose", line.talk.verbose, "more on stderr");
  command->callback([&line, action = std::move(action)] { line.action = action; });
  return command;
}

CLI::Validator oneOf(std::vector<std::string> choices) {
  const std::string description = "{" + join(choices, ",") + "}";
  const auto check = [choices = std::move(choices)](const std::string& value) -> std::string {
    if (std::find(choices.begin(), choices.end(), value) != choices.end()) return {};
    return fmt::format("'{}' is not a choice{}; wanted {}", value, didYouMean(value, choices),
                       join(choices, " or "));
  };
  return CLI::Validator(check, description);
}

CLI::Validator between(double min, double max, const std::string& unit) {
  const std::string wanted =
      fmt::format("{:g} to {:g}{}", min, max, unit.empty() ? "" : " " + unit);
  const auto check = [=](const std::string& text) -> std::string {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= min && value <= max) return {};
    return fmt::format("'{}' is not a number from {}", text, wanted);
  };
  return CLI::Validator(check, wanted);
}

CLI::Validator wholeNumber(std::uint64_t min, std::uint64_t max) {
  const std::string wanted = fmt::format("{} to {}", min, max);
  const auto check = [=](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [parsed, fault] = std::from_chars(text.data(), end, value);
    if (fault == std::errc() && parsed == end && value >= min && value <= max) return {};
    return fmt::format("'{}' is not a whole number from {}", text, wanted);
  };
  return CLI::Validator(check, wanted);
}

CLI::Validator trimmed() {
  const auto trim = [](std::string& value) -> std::string {
    CLI::detail::trim(value);
    return {};
  };
  return CLI::Validator(trim, "");
}

std::string helpText(const CLI::App& app) {
  const CLI::App& command = chosenCommand(app);
  return command.help(command.get_parent() ? fullName(*command.get_parent()) : "");
}

std::string usageMessage(const CLI::App& app, const CLI::ParseError& fault) {
  const CLI::App& command = chosenCommand(app);
  // A word that nobody took is the likely cause of whatever else is missing.
  const std::vector<std::string> words = command.remaining();
  const std::string what =
      words.empty() ? describeFault(fault) : describeExtra(command, words.front());
  return fmt::format("{}: {}\n`{} --help` shows how it is used", fullName(command), what,
                     fullName(command));
}

void printJson(const Json& document) {
  printText(document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void printText(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace lucerna::cli
