#include "app/profile_charts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/html.hpp"
#include "core/svg.hpp"

namespace lucerna::app {
namespace {

// Pixels.
constexpr double kNameWidth = 220, kBarsWidth = 640, kRowHeight = 30, kBarHeight = 13;
constexpr double kAxisWidth = 60, kColumnsWidth = 800, kChartHeight = 260, kWidest = 40;
constexpr double kMargin = 20;
constexpr std::size_t kMaxColumns = 400;

// What each pass took in the frames [begin, end), as a mean: in the order of the summary.
std::vector<double> columnOf(std::span<const graph::FrameProfile> frames,
                             const ProfileSummary& summary) {
  std::vector<double> gpuMs(summary.passes.size());
  for (const graph::FrameProfile& frame : frames)
    for (const graph::StepProfile& step : frame.steps) {
      const auto pass = std::ranges::find_if(summary.passes, [&](const PassCost& p) {
        return p.row == step.row && p.view == step.view;
      });
      gpuMs[static_cast<std::size_t>(pass - summary.passes.begin())] +=
          step.gpuMs / static_cast<double>(frames.size());
    }
  return gpuMs;
}

// Lines across, with their numbers of milliseconds at the left.
std::string frameAxis(double largest, double width) {
  std::string body;
  const double step = roundStep(largest);
  for (double ms = 0; ms <= largest; ms += step) {
    const double y = kMargin + kChartHeight * (1 - ms / largest);
    body += svgLine({kAxisWidth, y}, {width, y}, "class=\"axis\"");
    body += svgText({kAxisWidth - 6, y + 4}, "end", fmt::format("{:g} ms", ms));
  }
  return body;
}

struct Column {
  std::string frames;  // "frame 3", "frames 3 to 5"
  std::vector<double> gpuMs;
};

std::vector<Column> columnsOf(std::span<const graph::FrameProfile> frames,
                              const ProfileSummary& summary) {
  const std::size_t share = (frames.size() + kMaxColumns - 1) / kMaxColumns;
  std::vector<Column> columns;
  for (std::size_t f = 0; f < frames.size(); f += share) {
    const auto part = frames.subspan(f, std::min(share, frames.size() - f));
    const std::uint64_t first = part.front().frame, last = part.back().frame;
    columns.push_back({first == last ? fmt::format("frame {}", first)
                                     : fmt::format("frames {} to {}, mean", first, last),
                       columnOf(part, summary)});
  }
  return columns;
}

}  // namespace

std::string passChart(const ProfileSummary& summary, std::span<const std::string> names) {
  double largest = 1e-3;  // ms
  for (const PassCost& pass : summary.passes)
    largest = std::max({largest, pass.gpu.mean, pass.gpu.median, pass.cpu.mean, pass.cpu.median});
  std::string body;
  double y = 4;
  for (std::size_t p = 0; p < summary.passes.size(); ++p, y += kRowHeight) {
    const PassCost& pass = summary.passes[p];
    body += svgText({kNameWidth - 8, y + 13}, "end", names[p]);
    const auto bar = [&](const char* clock, const Milliseconds& time, std::string_view fill,
                         double top, double height) {
      const std::string title = fmt::format("{}: {} {:.3f} ms, median {:.3f} ms", names[p], clock,
                                            time.mean, time.median);
      const double width = kBarsWidth * time.mean / largest;
      const double median = kNameWidth + kBarsWidth * time.median / largest;
      body += svgRect({kNameWidth, top}, {width, height}, fill, title);
      body += svgLine({median, top - 1}, {median, top + height + 1}, "stroke=\"currentColor\"");
    };
    bar("GPU", pass.gpu, seriesColor(p), y, kBarHeight);
    bar("CPU", pass.cpu, "#999", y + kBarHeight + 1, kBarHeight / 2);
    const double end = kNameWidth + kBarsWidth * std::max(pass.gpu.mean, pass.gpu.median) / largest;
    body += svgText({end + 6, y + 11}, "start", fmt::format("{:.2f} ms", pass.gpu.mean));
  }
  return svgDrawing(kNameWidth + kBarsWidth + 90, y + 4, body);
}

std::string frameChart(std::span<const graph::FrameProfile> frames, const ProfileSummary& summary,
                       std::span<const std::string> names) {
  const auto drawn = warmFrames(frames);
  const std::vector<Column> columns = columnsOf(drawn, summary);
  double largest = 1e-3;  // ms
  for (const Column& column : columns) {
    double sum = 0;
    for (const double ms : column.gpuMs) sum += ms;
    largest = std::max(largest, sum);
  }
  const auto count = static_cast<double>(columns.size());
  const double pitch = std::min(kColumnsWidth / std::max(count, 1.0), kWidest);
  const double width = kAxisWidth + kColumnsWidth;
  std::string body = frameAxis(largest, width);
  double x = kAxisWidth;
  for (const Column& column : columns) {
    double y = kMargin + kChartHeight;
    for (std::size_t p = 0; p < column.gpuMs.size(); ++p) {
      const double height = kChartHeight * column.gpuMs[p] / largest;
      y -= height;
      body += svgRect({x, y}, {pitch * 0.9, height}, seriesColor(p),
                      fmt::format("{}: {} {:.3f} ms", column.frames, names[p], column.gpuMs[p]));
    }
    x += pitch;
  }
  const auto label = [&](double at, const char* anchor, const graph::FrameProfile& frame) {
    body +=
        svgText({at, kMargin + kChartHeight + 16}, anchor, fmt::format("frame {}", frame.frame));
  };
  if (!drawn.empty()) label(kAxisWidth, "start", drawn.front());
  if (drawn.size() > 1) label(std::max(x, kAxisWidth + 130), "end", drawn.back());
  return svgDrawing(width, kMargin + kChartHeight + 24, body);
}

}  // namespace lucerna::app
