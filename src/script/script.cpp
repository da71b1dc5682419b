#include "script/script.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <span>

#include "core/file.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "core/worker_program.hpp"
#include "script/script_answer.hpp"

namespace lucerna::script {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxSourceBytes = 4ull << 20;
constexpr ChildLimits kLimits{
    .time = std::chrono::seconds(5), .residentBytes = 512ull << 20, .outputBytes = 16ull << 20};

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
  const WorkerAnswer answer = runWorker(
      {.arguments = {"script"},
       .input = std::as_bytes(std::span(text)),
       .limits = kLimits,
       .name = name + ": the script",
       .kind = ErrorKind::Pipeline,
       .remedy = "the script engine needs about 1 GiB of address space; is there a limit (ulimit "
                 "-v), or too little memory?",
       .remedyAtLimit = fmt::format(
           "a script may take {} s, {} MiB of memory and {} MiB of output: look for a loop that "
           "does not end",
           kLimits.time.count() / 1000, kLimits.residentBytes >> 20, kLimits.outputBytes >> 20)});
  for (const std::string& line : split(answer.err, '\n'))
    if (!line.empty()) log::info("{}: {}", name, line);
  LUCERNA_TRY_VOID(answer.status);
  return pipelineFromAnswer({reinterpret_cast<const char*>(answer.out.data()), answer.out.size()},
                            name, input);
}

}  // namespace lucerna::script
