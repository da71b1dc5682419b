#include "app/profile.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/profile_report.hpp"
#include "app/profile_summary.hpp"
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

struct Form {
  const char* extension;
  std::string (*text)(const ProfileLog& log);
};
constexpr Form kForms[] = {{".csv", [](const ProfileLog& log) { return log.csv(); }},
                           {".json", [](const ProfileLog& log) { return log.json(); }},
                           {".md", profileMarkdown},
                           {".html", profileHtml}};

const Form* formOf(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  const auto form = std::ranges::find(kForms, extension, &Form::extension);
  return form == std::end(kForms) ? nullptr : form;
}

}  // namespace

std::string ProfileSubject::sizeText() const {
  const std::size_t views = plan.places.size();
  const std::size_t eyes = views == 0 ? 1 : static_cast<std::size_t>(plan.eyes());
  std::string text = eyes == 1 ? "" : fmt::format("{} eyes of ", eyes);
  text += fmt::format("{} x {} pixels", size.x, size.y);
  if (plan.picture != uvec2(0) && plan.picture != size)
    text += fmt::format(", rendered at {} x {}", plan.picture.x, plan.picture.y);
  if (views > eyes)
    text +=
        fmt::format(", in {} tiles drawn at {} x {}", views / eyes, plan.window.x, plan.window.y);
  return text;
}

std::string ProfileLog::csv() const {
  std::string text = "frame,pass,view,cpu_ms,gpu_ms,draws,primitives,texture_bytes,gpu_clock\n";
  // Of a step or of the frame.
  const auto add = [&](std::uint64_t frame, const std::string& what, const auto& cost) {
    text += fmt::format("{},{},{:.4f},{:.4f},{},{},{},{}\n", frame, what, cost.cpuMs, cost.gpuMs,
                        cost.counters.draws, cost.counters.primitives, cost.textureBytes,
                        subject_.gpuClock);
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
      {"lucerna", "profile/1"}, {"gpu_clock", subject_.gpuClock}, {"frames", std::move(frames)}};
  return document.dump(1) + "\n";
}

std::string ProfileLog::table() const {
  const ProfileSummary summary = summarised(frames_);
  std::string text = fmt::format("{:24} {:>4} {:>9} {:>9} {:>8} {:>11} {:>8}\n", "pass", "view",
                                 "CPU ms", "GPU ms", "draws", "primitives", "MiB");
  const auto addLine = [&](const PassCost& cost, const std::string& name, const std::string& view) {
    text += fmt::format("{:24} {:>4} {:9.2f} {:9.2f} {:8.0f} {:11.0f} {:8.1f}\n", name, view,
                        cost.cpu.mean, cost.gpu.mean, cost.draws, cost.primitives,
                        static_cast<double>(cost.textureBytes) / (1 << 20));
  };
  for (const PassCost& pass : summary.passes) addLine(pass, pass.row, std::to_string(pass.view));
  addLine(summary.frame, "all", "");
  return text + fmt::format("mean of {} frame{}{}; GPU clock: {}\n", summary.frames,
                            summary.frames > 1 ? "s" : "",
                            summary.firstLeftOut ? " (the first left out)" : "", subject_.gpuClock);
}

Status ProfileLog::checkPath(const std::string& path) {
  if (formOf(path)) return checkFolderOf(path, "--profile");
  return error(ErrorKind::Usage, "--profile: '{}' ends in '{}'; wanted .csv, .json, .md or .html",
               path, std::filesystem::path(path).extension().string());
}

Status ProfileLog::write(const std::string& path) const {
  LUCERNA_TRY_VOID(checkPath(path));
  return writeText(path, formOf(path)->text(*this));
}

}  // namespace lucerna::app
