// The drawings of a report.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/bench/report.hpp"
#include "core/html.hpp"
#include "core/svg.hpp"

namespace lucerna::app::bench {
namespace {

using glm::dvec2;

// px
constexpr dvec2 kOrigin{70, 290};  // of the axes: the lower left corner
constexpr dvec2 kExtent{560, 270};
constexpr double kLegendLeft = 650, kLegendWidth = 330, kLegendLine = 18;
constexpr double kNameWidth = 180, kBarsWidth = 640, kRowHeight = 26, kBarHeight = 17;

struct Axis {
  double min = 0, max = 1;
  bool logarithmic = false;
  std::vector<double> ticks;

  double place(double value) const {  // 0 to 1 along the axis
    return logarithmic ? std::log(value / min) / std::log(max / min) : (value - min) / (max - min);
  }
};

Axis linearAxis(double max) {
  Axis axis{.min = 0, .max = max > 0 ? max : 1, .logarithmic = false, .ticks = {}};
  const double step = roundStep(axis.max);
  for (double tick = 0; tick <= axis.max; tick += step) axis.ticks.push_back(tick);
  return axis;
}

// Between the nearest of 1, 2 and 5 times powers of ten.
Axis logarithmicAxis(double min, double max) {
  Axis axis{.min = min, .max = max, .logarithmic = true, .ticks = {}};
  for (double power = std::pow(10, std::floor(std::log10(min))); power <= 10 * max; power *= 10)
    for (const double digit : {1.0, 2.0, 5.0}) axis.ticks.push_back(digit * power);
  const auto below = std::ranges::upper_bound(axis.ticks, min * (1 + 1e-9)) - 1;
  const auto above = std::ranges::lower_bound(axis.ticks, max * (1 - 1e-9));
  axis.ticks = {below, std::max(above, below + 1) + 1};
  axis.min = axis.ticks.front();
  axis.max = axis.ticks.back();
  return axis;
}

Axis axisOf(const LinePlot& plot, int component) {
  double min = std::numeric_limits<double>::infinity(), max = -min;
  for (const Curve& curve : plot.curves)
    for (const dvec2& point : curve.points) {
      min = std::min(min, point[component]);
      max = std::max(max, point[component]);
    }
  return plot.logarithmic && 0 < min && min <= max ? logarithmicAxis(min, max) : linearAxis(max);
}

std::string axesSvg(const LinePlot& plot, const Axis& x, const Axis& y) {
  std::string body;
  for (const double tick : y.ticks) {
    const double at = kOrigin.y - kExtent.y * y.place(tick);
    body += svgLine({kOrigin.x, at}, {kOrigin.x + kExtent.x, at}, "class=\"axis\"");
    body += svgText({kOrigin.x - 6, at + 4}, "end", fmt::format("{:g}", tick));
  }
  for (const double tick : x.ticks) {
    const double at = kOrigin.x + kExtent.x * x.place(tick);
    body += svgLine({at, kOrigin.y}, {at, kOrigin.y + 5}, "class=\"axis\"");
    body += svgText({at, kOrigin.y + 18}, "middle", fmt::format("{:g}", tick));
  }
  body += svgText({kOrigin.x + kExtent.x / 2, kOrigin.y + 38}, "middle", plot.xLabel);
  return body + svgText({4, 12}, "start", plot.yLabel);
}

std::string curveSvg(const Curve& curve, const Axis& x, const Axis& y, std::string_view color) {
  std::string line, points;
  for (const dvec2& point : curve.points) {
    const dvec2 at = kOrigin + kExtent * dvec2(x.place(point.x), -y.place(point.y));
    line += fmt::format("{:.1f},{:.1f} ", at.x, at.y);
    points += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"><title>{}: {:g}, {:.4g}</title>"
        "</circle>\n",
        at.x, at.y, color, escapedXml(curve.name), point.x, point.y);
  }
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
                     line, color) +
         points;
}

std::string legendSvg(const std::vector<std::string>& names, double left, double top) {
  std::string body;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double y = top + static_cast<double>(i) * kLegendLine;
    body += svgRect({left, y}, {12, 12}, seriesColor(i), names[i]);
    body += svgText({left + 18, y + 10}, "start", names[i]);
  }
  return body;
}

double heightOfLegend(std::size_t lines) {
  return 24 + kLegendLine * static_cast<double>(lines);
}

}  // namespace

std::string svgOf(const LinePlot& plot) {
  const Axis x = axisOf(plot, 0), y = axisOf(plot, 1);
  std::string body = axesSvg(plot, x, y);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    body += curveSvg(plot.curves[i], x, y, seriesColor(i));
    names.push_back(plot.curves[i].name);
  }
  body += legendSvg(names, kLegendLeft, 20);
  return svgDrawing(kLegendLeft + kLegendWidth,
                    std::max(kOrigin.y + 46, heightOfLegend(names.size())), body);
}

std::string svgOf(const BarPlot& plot) {
  double largest = 0;
  for (const auto& row : plot.values) {
    double sum = 0;
    for (const double value : row) sum += value;
    largest = std::max(largest, sum);
  }
  if (largest <= 0) largest = 1;
  std::string body;
  double y = 4;
  for (std::size_t r = 0; r < plot.rows.size(); ++r, y += kRowHeight) {
    body += svgText({kNameWidth - 8, y + 13}, "end", plot.rows[r]);
    double sum = 0;
    for (std::size_t p = 0; p < plot.parts.size(); ++p) {
      const double value = plot.values[r][p];
      body += svgRect(
          {kNameWidth + kBarsWidth * sum / largest, y}, {kBarsWidth * value / largest, kBarHeight},
          seriesColor(p),
          fmt::format("{}, {}: {} {}", plot.rows[r], plot.parts[p], numberText(value), plot.unit));
      sum += value;
    }
    body += svgText({kNameWidth + kBarsWidth * sum / largest + 6, y + 13}, "start",
                    fmt::format("{} {}", numberText(sum), plot.unit));
  }
  body += legendSvg(plot.parts, kNameWidth, y + 8);
  return svgDrawing(kNameWidth + kBarsWidth + 90, y + heightOfLegend(plot.parts.size()), body);
}

}  // namespace lucerna::app::bench
