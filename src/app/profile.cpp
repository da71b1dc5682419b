#include "app/profile.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/file.hpp"

namespace lucerna::app {
namespace {

using Json = nlohmann::ordered_json;

// A CSV field; row names may hold anything.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

// Of a step or of a frame.
template <typename Cost>
Json costJson(const Cost& cost) {
  return {{"cpu_ms", cost.cpuMs},
          {"gpu_ms", cost.gpuMs},
          {"draws", cost.counters.draws},
          {"primitives", cost.counters.primitives},
          {"texture_bytes", cost.textureBytes}};
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
  // Of a step or of the frame.
  const auto add = [&](std::uint64_t frame, const std::string& what, const auto& cost) {
    text +=
        fmt::format("{},{},{:.4f},{:.4f},{},{},{},{}\n", frame, what, cost.cpuMs, cost.gpuMs,
                    cost.counters.draws, cost.counters.primitives, cost.textureBytes, gpuClock_);
  };
  for (const graph::FrameProfile& frame : frames_) {
    for (const graph::StepProfile& step : frame.steps)
      add(frame.frame, fmt::format("{},{}", quoted(step.row), step.view), step);
    add(frame.frame, "(frame),", frame);
  }
  return text;
}

std::string ProfileLog::json() const {
  Json frames = Json::array();
  for (const graph::FrameProfile& frame : frames_) {
    Json passes = Json::array();
    for (const graph::StepProfile& step : frame.steps) {
      Json pass{{"pass", step.row}, {"view", step.view}};
      pass.update(costJson(step));
      passes.push_back(std::move(pass));
    }
    Json json{{"frame", frame.frame}};
    json.update(costJson(frame));
    json["passes"] = std::move(passes);
    frames.push_back(std::move(json));
  }
  const Json document{
      {"lucerna", "profile/1"}, {"gpu_clock", gpuClock_}, {"frames", std::move(frames)}};
  return document.dump(1) + "\n";
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
  Mean whole;
  const auto addLine = [&](const Mean& mean, const std::string& name, const std::string& view) {
    text += fmt::format("{:24} {:>4} {:9.2f} {:9.2f} {:8.0f} {:11.0f} {:8.1f}\n", name, view,
                        mean.cpuMs, mean.gpuMs, mean.draws, mean.primitives,
                        static_cast<double>(mean.textureBytes) / (1 << 20));
  };
  for (const Mean& mean : means) {
    whole.cpuMs += mean.cpuMs;
    whole.gpuMs += mean.gpuMs;
    whole.draws += mean.draws;
    whole.primitives += mean.primitives;
    addLine(mean, mean.row, std::to_string(mean.view));
  }
  whole.textureBytes = frames_.empty() ? 0 : frames_.back().textureBytes;
  addLine(whole, "all", "");
  return text + fmt::format("mean of {} frame{}{}; GPU clock: {}\n", frames_.size() - first,
                            count > 1 ? "s" : "", first > 0 ? " (the first left out)" : "",
                            gpuClock_);
}

Status ProfileLog::checkPath(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".csv" || extension == ".json") return checkFolderOf(path, "--profile");
  return error(ErrorKind::Usage, "--profile: '{}' ends in '{}'; wanted .csv or .json", path,
               extension);
}

Status ProfileLog::write(const std::string& path) const {
  LUCERNA_TRY_VOID(checkPath(path));
  return writeText(path, path.ends_with(".csv") ? csv() : json());
}

}  // namespace lucerna::app
