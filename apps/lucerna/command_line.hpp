// What the subcommands share: how they are declared, and how their results reach the shell.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace lucerna::cli {

using Json = nlohmann::ordered_json;

// What the chosen subcommand does; the value is the exit code.
using Action = std::function<Result<int>()>;

struct Talk {
  bool json = false, quiet = false, verbose = false;
};

// Collected while the command line is declared and parsed.
struct CommandLine {
  CLI::App app;
  Talk talk;
  Action action;  // set by the subcommand that was chosen
};

// Makes a subcommand of `parent` with --json, --quiet and --verbose that runs `action` when chosen.
CLI::App* addCommand(CommandLine& line, CLI::App& parent, const std::string& name,
                     const std::string& help, Action action);

// One file each.
void addRender(CommandLine& line);
void addReference(CommandLine& line);
void addCompare(CommandLine& line);
void addBake(CommandLine& line);
void addLightmap(CommandLine& line);
void addBench(CommandLine& line);
void addInfo(CommandLine& line);
void addDoctor(CommandLine& line);
void addPass(CommandLine& line);
void addPipeline(CommandLine& line);

// Fails with "found, wanted, did you mean" unless the value is one of `choices`.
CLI::Validator oneOf(std::vector<std::string> choices);

// Fail with "found, wanted" unless the value is a number in the range; NaN is in none.
CLI::Validator between(double min, double max, const std::string& unit = "");
CLI::Validator wholeNumber(std::uint64_t min, std::uint64_t max);

// Takes away spaces around the value, as of "a, b".
CLI::Validator trimmed();

// Throws CLI::ValidationError, which becomes exit code 2.
template <typename T>
T orUsageError(const std::string& option, Result<T> result) {
  if (!result) throw CLI::ValidationError(option, result.error().message);
  return std::move(result).value();
}

// What the argument SCENE may be.
std::string sceneHelp();

// The innermost subcommand that was chosen, or the program itself.
const CLI::App& chosenCommand(const CLI::App& app);

// The help of that one.
std::string helpText(const CLI::App& app);

// The message for a command line that CLI11 refused: subcommand, what was found, did you mean.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& fault);

void printJson(const Json& document);     // stdout
void printText(const std::string& text);  // stdout

}  // namespace lucerna::cli
