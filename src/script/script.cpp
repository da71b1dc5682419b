#include "script/script.hpp"

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "core/child_process.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/text.hpp"

namespace lucerna::script {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxSourceBytes = 4ull << 20;
constexpr ChildLimits kLimits{
    .time = std::chrono::seconds(5), .residentBytes = 512ull << 20, .outputBytes = 16ull << 20};

std::string remedyFor(ChildOutput::End end) {
  using End = ChildOutput::End;
  if (end == End::TimedOut || end == End::OutOfMemory || end == End::TooMuchOutput)
    return fmt::format(
        "a script may take {} s, {} MiB of memory and {} MiB of output: look for a loop that does "
        "not end",
        kLimits.time.count() / 1000, kLimits.residentBytes >> 20, kLimits.outputBytes >> 20);
  return "the script engine needs about 1 GiB of address space; is there a limit (ulimit -v), or "
         "too little memory?";
}

// Params that were given but that the script never asked for.
Status checkAllUsed(const ScriptInput& input, const std::vector<std::string>& declared,
                    const std::string& name) {
  for (const auto& [param, value] : input.params) {
    if (std::find(declared.begin(), declared.end(), param) != declared.end()) continue;
    return error(ErrorKind::Usage, "{}: the script has no parameter '{}'{}; it has {}", name, param,
                 didYouMean(param, declared),
                 declared.empty() ? std::string("none") : join(declared));
  }
  return {};
}

Result<graph::Pipeline> fromAnswer(Json answer, const std::string& name, const ScriptInput& input) {
  if (answer.contains("error"))
    return error(ErrorKind::Pipeline, "{}", answer["error"].get<std::string>());
  LUCERNA_TRY_VOID(checkAllUsed(input, answer.at("params").get<std::vector<std::string>>(), name));
  Json& rows = answer.at("pipeline").at("passes");
  const auto lines = answer.at("places").get<std::vector<int>>();
  if (lines.size() != rows.size())
    return error(
        ErrorKind::Pipeline,
        "{}: the script changed what the engine itself uses and came back with {} rows and {} "
        "places; leave the built-in prototypes alone",
        name, rows.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    rows.at(i)["place"] = fmt::format("{}:{}", name, lines[i]);
  LUCERNA_TRY(pipeline, graph::pipelineFromJson(answer["pipeline"].dump(), name));
  if (pipeline.name.empty()) pipeline.name = std::filesystem::path(name).stem().string();
  return pipeline;
}

}  // namespace

Result<graph::Pipeline> runPipelineScript(const std::string& path, const ScriptInput& input) {
  LUCERNA_TRY(source, readText(path, kMaxSourceBytes));
  return runPipelineSource(source, path, input);
}

Result<graph::Pipeline> runPipelineSource(const std::string& source, const std::string& name,
                                          const ScriptInput& input) {
  const Json request{
      {"source", source}, {"file", name}, {"params", input.params}, {"seed", input.seed}};
  // A file that is not UTF-8 still runs: what is not text becomes U+FFFD.
  const std::string text = request.dump(-1, ' ', false, Json::error_handler_t::replace);
  const ChildOutput child =
      runChild(workerProgram(), {"--worker", "script"}, std::as_bytes(std::span(text)), kLimits);
  for (const std::string& line : split(child.err, '\n'))
    if (!line.empty()) log::info("{}: {}", name, line);
  if (child.end == ChildOutput::End::Cancelled)
    return error(ErrorKind::Cancelled, "{}: cancelled", name);
  if (child.end != ChildOutput::End::Exited || child.status != 0)
    return error(ErrorKind::Pipeline, "{}: the script {}; {}", name, describeEnd(child, kLimits),
                 remedyFor(child.end));
  Json answer = Json::parse(reinterpret_cast<const char*>(child.out.data()),
                            reinterpret_cast<const char*>(child.out.data() + child.out.size()),
                            nullptr, false);
  // The script shares its process with the code that answers, so the answer is not trusted.
  if (answer.is_discarded() || !answer.is_object())
    return error(ErrorKind::Pipeline, "{}: the script's process gave no readable answer", name);
  try {
    return fromAnswer(std::move(answer), name, input);
  } catch (const Json::exception& e) {
    return error(ErrorKind::Pipeline, "{}: the script's process gave a damaged answer ({})", name,
                 e.what());
  }
}

}  // namespace lucerna::script
