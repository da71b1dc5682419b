#include "app/profile_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/html.hpp"
#include "core/math/math.hpp"

namespace lucerna::app {
namespace {

using glm::dvec2;

// Pixels.
constexpr double kNameWidth = 220, kBarsWidth = 640, kRowHeight = 30, kBarHeight = 13;
constexpr double kAxisWidth = 60, kColumnsWidth = 800, kChartHeight = 260, kWidest = 40;
constexpr double kMargin = 20;
constexpr std::size_t kMaxColumns = 400;

// A round number of at least a third and at most all of `largest`: where the axis has its lines.
double roundStep(double largest) {
  const double power = std::pow(10, std::floor(std::log10(largest)));
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power <= largest) return digit * power / 2;
  return power;
}

std::string rectText(dvec2 corner, dvec2 size, std::string_view fill, const std::string& title) {
  return fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"><title>{}"
      "</title></rect>\n",
      corner.x, corner.y, size.x, size.y, fill, escapedXml(title));
}

std::string lineText(dvec2 from, dvec2 to, std::string_view attributes) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", from.x,
                     from.y, to.x, to.y, attributes);
}

std::string svgText(double width, double height, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\">\n{2}</svg>\n",
      width, height, body);
}

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
    body += lineText({kAxisWidth, y}, {width, y}, "class=\"axis\"");
    body += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{:g} ms</text>\n",
                        kAxisWidth - 6, y + 4, ms);
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
    body += fmt::format("<text x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n",
                        kNameWidth - 8, y + 13, escapedXml(names[p]));
    const auto bar = [&](const char* clock, const Milliseconds& time, std::string_view fill,
                         double top, double height) {
      const std::string title = fmt::format("{}: {} {:.3f} ms, median {:.3f} ms", names[p], clock,
                                            time.mean, time.median);
      const double width = kBarsWidth * time.mean / largest;
      const double median = kNameWidth + kBarsWidth * time.median / largest;
      body += rectText({kNameWidth, top}, {width, height}, fill, title);
      body += lineText({median, top - 1}, {median, top + height + 1}, "stroke=\"currentColor\"");
    };
    bar("GPU", pass.gpu, seriesColor(p), y, kBarHeight);
    bar("CPU", pass.cpu, "#999", y + kBarHeight + 1, kBarHeight / 2);
    body += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\">{:.2f} ms</text>\n",
        kNameWidth + kBarsWidth * std::max(pass.gpu.mean, pass.gpu.median) / largest + 6, y + 11,
        pass.gpu.mean);
  }
  return svgText(kNameWidth + kBarsWidth + 90, y + 4, body);
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
      body += rectText({x, y}, {pitch * 0.9, height}, seriesColor(p),
                       fmt::format("{}: {} {:.3f} ms", column.frames, names[p], column.gpuMs[p]));
    }
    x += pitch;
  }
  const auto label = [&](double at, const char* anchor, const graph::FrameProfile& frame) {
    body += fmt::format("<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"{}\">frame {}</text>\n", at,
                        kMargin + kChartHeight + 16, anchor, frame.frame);
  };
  if (!drawn.empty()) label(kAxisWidth, "start", drawn.front());
  if (drawn.size() > 1) label(std::max(x, kAxisWidth + 130), "end", drawn.back());
  return svgText(width, kMargin + kChartHeight + 24, body);
}

}  // namespace lucerna::app
