// lucerna doctor: can this machine render, and if not, what is missing.

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "command_line.hpp"
#include "core/parallel.hpp"
#include "core/version.hpp"
#include "gpu/context.hpp"
#include "gpu/device.hpp"
#include "script/script.hpp"

namespace lucerna::cli {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// Mesa's: a warm one makes the first frame several times faster.
std::string shaderCache() {
  const std::string disabled = environment("MESA_SHADER_CACHE_DISABLE");
  if (disabled == "1" || disabled == "true") return "off (MESA_SHADER_CACHE_DISABLE)";
  if (const std::string folder = environment("MESA_SHADER_CACHE_DIR"); !folder.empty())
    return folder;
  if (const std::string folder = environment("XDG_CACHE_HOME"); !folder.empty())
    return folder + "/mesa_shader_cache";
  return environment("HOME") + "/.cache/mesa_shader_cache";
}

// A pipeline script takes one round through its child process.
Json checkScripts() {
  const auto start = std::chrono::steady_clock::now();
  const auto pipeline = script::runPipelineSource("pass('Cull')", "doctor.js");
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  if (!pipeline) return {{"ok", false}, {"message", pipeline.error().message}};
  return {{"ok", true}, {"milliseconds", ms.count()}};
}

// "gl" is what `lucerna pipeline check --caps` reads.
Status checkGl(Json& document) {
  LUCERNA_TRY(context, gpu::Context::create());
  LUCERNA_TRY(device, gpu::Device::create(*context));
  document["gl"] = Json::parse(device->capabilities().toJson());
  document["driver"] = {
      {"description", device->description()},
      {"context", context->platform()},
      {"gpu_clock", device->timersUseCpuClock() ? "cpu-after-finish" : "gpu-timer"}};
  return {};
}

std::string text(const Json& document) {
  const Json& gl = document["gl"];
  const Json& driver = document["driver"];
  std::string result =
      fmt::format("lucerna       {}\nOpenGL        {}\n", document["version"].get<std::string>(),
                  driver["description"].get<std::string>());
  result +=
      fmt::format("context       {}\nGPU clock     {}\n", driver["context"].get<std::string>(),
                  driver["gpu_clock"].get<std::string>());
  for (const Json& feature : gl["features"])
    result += fmt::format("feature       {}\n", feature.get<std::string>());
  result += fmt::format("limits        texture side {}, layers {}, colour targets {}, samples {}\n",
                        gl["maxTextureSide"].get<int>(), gl["maxTextureLayers"].get<int>(),
                        gl["maxColorTargets"].get<int>(), gl["maxSamples"].get<int>());
  const Json& scripts = document["scripts"];
  result +=
      scripts["ok"].get<bool>()
          ? fmt::format("scripts       ok, {:.0f} ms\n", scripts["milliseconds"].get<double>())
          : fmt::format("scripts       {}\n", scripts["message"].get<std::string>());
  return result + fmt::format("shader cache  {}\nthreads       {}\n",
                              document["shader_cache"].get<std::string>(),
                              document["threads"].get<int>());
}

Result<int> doctor(bool json) {
  Json document{{"version", kVersion}};
  if (const Status gl = checkGl(document); !gl)
    return error(ErrorKind::NoGl,
                 "{}\nLucerna needs OpenGL 4.5 through EGL. On Debian: apt-get install libegl1 "
                 "libgl1-mesa-dri",
                 gl.error().message);
  document["scripts"] = checkScripts();
  document["shader_cache"] = shaderCache();
  document["threads"] = threadCount();
  if (json)
    printJson(document);
  else
    printText(text(document));
  return document["scripts"]["ok"].get<bool>() ? 0 : static_cast<int>(ErrorKind::Failed);
}

}  // namespace

void addDoctor(CommandLine& line) {
  addCommand(line, line.app, "doctor", "can this machine render, and what is missing",
             [&line] { return doctor(line.talk.json); });
}

}  // namespace lucerna::cli
