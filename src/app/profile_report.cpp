#include "app/profile_report.hpp"

#include <algorithm>

#include "app/profile_charts.hpp"
#include "app/profile_summary.hpp"
#include "core/html.hpp"
#include "core/markdown.hpp"
#include "core/svg.hpp"

namespace lucerna::app {
namespace {

constexpr std::size_t kBarLength = 20;  // characters of the longest

constexpr std::string_view kStyle =
    "tfoot td { font-weight: 600; } i { display: inline-block; width: .8em; height: .8em; "
    "margin-right: .4em; }\n";

double mebibytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1 << 20);
}

std::string nameOf(const PassCost& pass, bool manyViews) {
  return manyViews ? fmt::format("{}, view {}", pass.row, pass.view) : pass.row;
}

bool hasManyViews(const ProfileSummary& summary) {
  return std::ranges::any_of(summary.passes, [](const PassCost& p) { return p.view > 0; });
}

std::string whatWasMeasured(const ProfileSummary& summary, const ProfileSubject& subject) {
  return fmt::format("{}, pipeline {}, {}, {} frame{}{}", subject.scene, subject.pipeline,
                     subject.sizeText(), summary.frames, summary.frames == 1 ? "" : "s",
                     summary.firstLeftOut ? " after the first" : "");
}

std::string howGpuTimeWasMeasured(const ProfileSubject& subject) {
  return fmt::format("{}; GPU time by {}", subject.renderer,
                     subject.gpuClock == "gpu-timer"
                         ? "the GPU's timer"
                         : "the CPU's clock, waiting for each pass to finish");
}

// The bar's eighths are characters of their own.
std::string barOf(double share) {
  static constexpr const char* kEighths[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const auto eighths = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * kBarLength * 8 + 0.5);
  std::string bar;
  for (std::size_t i = 0; i < eighths / 8; ++i) bar += "█";
  return bar + kEighths[eighths % 8];
}

std::string markdownRow(const PassCost& cost, const std::string& name, const std::string& bar) {
  return fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.1f} | {} |\n",
                     name, cost.cpu.mean, cost.cpu.median, cost.gpu.mean, cost.gpu.median,
                     cost.draws, cost.primitives, mebibytes(cost.textureBytes), bar);
}

std::string htmlRow(const PassCost& cost, const std::string& name) {
  return fmt::format(
      "<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.0f}</td>"
      "<td>{:.0f}</td><td>{:.1f}</td></tr>\n",
      name, cost.cpu.mean, cost.cpu.median, cost.gpu.mean, cost.gpu.median, cost.draws,
      cost.primitives, mebibytes(cost.textureBytes));
}

std::string htmlTable(const ProfileSummary& summary, bool manyViews) {
  std::string text =
      "<table>\n<thead><tr><th>pass</th><th>CPU ms, mean</th><th>median</th><th>GPU ms, mean</th>"
      "<th>median</th><th>draws</th><th>primitives</th><th>MiB "
      "written</th></tr></thead>\n<tbody>\n";
  for (std::size_t p = 0; p < summary.passes.size(); ++p)
    text +=
        htmlRow(summary.passes[p], fmt::format("<i style=\"background: {}\"></i>{}", seriesColor(p),
                                               escapedXml(nameOf(summary.passes[p], manyViews))));
  return text + "</tbody>\n<tfoot>\n" + htmlRow(summary.frame, "whole frame") +
         "</tfoot>\n</table>\n";
}

constexpr std::string_view kMemoryNote =
    "Memory of a pass is the textures that it writes; of the frame, all textures that the pipeline "
    "holds, which is less than the sum where passes share them.";

}  // namespace

std::string profileMarkdown(const ProfileLog& log) {
  const ProfileSummary summary = summarised(log.frames());
  const bool manyViews = hasManyViews(summary);
  double longest = 0;
  for (const PassCost& pass : summary.passes) longest = std::max(longest, pass.gpu.mean);
  std::string text = fmt::format(
      "# Cost of a frame\n\n{}.\n{}.\n\n"
      "| pass | CPU ms, mean | median | GPU ms, mean | median | draws | primitives | MiB written | "
      "GPU time |\n|---|--:|--:|--:|--:|--:|--:|--:|---|\n",
      escapedMarkdown(whatWasMeasured(summary, log.subject())),
      escapedMarkdown(howGpuTimeWasMeasured(log.subject())));
  for (const PassCost& pass : summary.passes)
    text += markdownRow(pass, escapedMarkdown(nameOf(pass, manyViews)),
                        barOf(longest > 0 ? pass.gpu.mean / longest : 0));
  text += markdownRow(summary.frame, "**whole frame**", "");
  return fmt::format("{}\n{}\n", text, kMemoryNote);
}

std::string profileHtml(const ProfileLog& log) {
  const ProfileSummary summary = summarised(log.frames());
  const bool manyViews = hasManyViews(summary);
  std::vector<std::string> names;
  for (const PassCost& pass : summary.passes) names.push_back(nameOf(pass, manyViews));
  const std::string body = fmt::format(
      "<h1>Cost of a frame</h1>\n<p>{}</p>\n<p class=\"quiet\">{}</p>\n{}"
      "<p class=\"quiet\">{}</p>\n<h2>By pass: mean GPU time, and CPU time in grey; a line marks "
      "the median</h2>\n{}"
      "<h2>Frame by frame: GPU time</h2>\n{}",
      escapedXml(whatWasMeasured(summary, log.subject())),
      escapedXml(howGpuTimeWasMeasured(log.subject())), htmlTable(summary, manyViews), kMemoryNote,
      passChart(summary, names), frameChart(log.frames(), summary, names));
  return htmlText({.title = "Cost of a frame: " + log.subject().scene,
                   .style = std::string(kSvgStyle) + std::string(kStyle),
                   .body = body});
}

}  // namespace lucerna::app
