#include "core/svg.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/html.hpp"

namespace lucerna {

using glm::dvec2;

const std::string_view kSvgStyle = R"css(
svg { display: block; max-width: 100%; height: auto; font: 12px system-ui, sans-serif; }
svg text { fill: currentColor; } .axis { stroke: var(--line); }
)css";

std::string svgDrawing(double width, double height, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\">\n{2}</svg>\n",
      width, height, body);
}

std::string svgRect(dvec2 corner, dvec2 size, std::string_view fill, std::string_view title) {
  return fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"><title>{}"
      "</title></rect>\n",
      corner.x, corner.y, size.x, size.y, fill, escapedXml(title));
}

std::string svgLine(dvec2 from, dvec2 to, std::string_view attributes) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", from.x,
                     from.y, to.x, to.y, attributes);
}

std::string svgText(dvec2 at, std::string_view anchor, std::string_view text) {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\">{}</text>\n", at.x, at.y,
                     anchor, escapedXml(text));
}

double roundStep(double largest) {
  const double power = std::pow(10, std::floor(std::log10(largest)));
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power <= largest) return digit * power / 2;
  return power;
}

}  // namespace lucerna
