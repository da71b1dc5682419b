#include "app/profile.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/file.hpp"

namespace lucerna::app {
namespace {

// A CSV field; row names may hold anything.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

struct Mean {
  std::string row;
  int view = 0;
  double cpuMs = 0, gpuMs = 0, draws = 0, primitives = 0;
  std::uint64_t textureBytes = 0;
};

}  // namespace

std::string ProfileLog::csv() const {
  std::string text = "frame,pass,view,cpu_ms,gpu_ms,draws,primitives,texture_bytes,gpu_clock\n";
  for (const graph::FrameProfile& frame : frames_)
    for (const graph::StepProfile& step : frame.steps)
      text += fmt::format("{},{},{},{:.4f},{:.4f},{},{},{},{}\n", frame.frame, quoted(step.row),
                          step.view, step.cpuMs, step.gpuMs, step.counters.draws,
                          step.counters.primitives, step.textureBytes, gpuClock_);
  return text;
}

std::string ProfileLog::json() const {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const graph::FrameProfile& frame : frames_) {
    nlohmann::ordered_json passes = nlohmann::ordered_json::array();
    for (const graph::StepProfile& step : frame.steps)
      passes.push_back({{"pass", step.row},
                        {"view", step.view},
                        {"cpu_ms", step.cpuMs},
                        {"gpu_ms", step.gpuMs},
                        {"draws", step.counters.draws},
                        {"primitives", step.counters.primitives},
                        {"texture_bytes", step.textureBytes}});
    frames.push_back({{"frame", frame.frame},
                      {"cpu_ms", frame.cpuMs},
                      {"gpu_ms", frame.gpuMs},
                      {"passes", std::move(passes)}});
  }
  return nlohmann::ordered_json{
             {"lucerna", "profile/1"}, {"gpu_clock", gpuClock_}, {"frames", std::move(frames)}}
             .dump(1) +
         "\n";
}

std::string ProfileLog::table() const {
  const std::size_t first = frames_.size() > 1 ? 1 : 0;
  const auto count = static_cast<double>(frames_.size() - first);
  std::vector<Mean> means;
  for (std::size_t f = first; f < frames_.size(); ++f)
    for (const graph::StepProfile& step : frames_[f].steps) {
      auto mean = std::find_if(means.begin(), means.end(), [&](const Mean& m) {
        return m.row == step.row && m.view == step.view;
      });
      if (mean == means.end())
        mean = means.insert(means.end(), {.row = step.row, .view = step.view});
      mean->cpuMs += step.cpuMs / count;
      mean->gpuMs += step.gpuMs / count;
      mean->draws += static_cast<double>(step.counters.draws) / count;
      mean->primitives += static_cast<double>(step.counters.primitives) / count;
      mean->textureBytes = step.textureBytes;
    }
  std::string text = fmt::format("{:24} {:>4} {:>9} {:>9} {:>8} {:>11} {:>8}\n", "pass", "view",
                                 "CPU ms", "GPU ms", "draws", "primitives", "MiB");
  double cpu = 0, gpu = 0;
  for (const Mean& mean : means) {
    cpu += mean.cpuMs;
    gpu += mean.gpuMs;
    text += fmt::format("{:24} {:4} {:9.2f} {:9.2f} {:8.0f} {:11.0f} {:8.1f}\n", mean.row,
                        mean.view, mean.cpuMs, mean.gpuMs, mean.draws, mean.primitives,
                        static_cast<double>(mean.textureBytes) / (1 << 20));
  }
  return text + fmt::format("{:24} {:4} {:9.2f} {:9.2f}   mean of {} frame{}{}; GPU clock: {}\n",
                            "all", "", cpu, gpu, frames_.size() - first, count > 1 ? "s" : "",
                            first > 0 ? " (the first left out)" : "", gpuClock_);
}

Status ProfileLog::checkPath(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".csv" || extension == ".json") {
    std::error_code noFolder;
    const auto folder = std::filesystem::path(path).parent_path();
    if (folder.empty() || std::filesystem::is_directory(folder, noFolder)) return {};
    return error(ErrorKind::Usage, "--profile: the folder '{}' does not exist; make it first",
                 folder.string());
  }
  return error(ErrorKind::Usage, "--profile: '{}' ends in '{}'; wanted .csv or .json", path,
               extension);
}

Status ProfileLog::write(const std::string& path) const {
  LUCERNA_TRY_VOID(checkPath(path));
  return writeText(path, path.ends_with(".csv") ? csv() : json());
}

}  // namespace lucerna::app
