// Drawings for the pages of core/html.hpp: elements of SVG as text. Lengths in px, y down.
#pragma once

#include <string>
#include <string_view>

#include "core/math/math.hpp"

namespace lucerna {

// CSS that a page with drawings needs: text in the page's colour, class "axis" for faint lines.
extern const std::string_view kSvgStyle;

// <svg> of that size, which shrinks with a narrow window.
std::string svgDrawing(double width, double height, const std::string& body);

// Shows `title` under the pointer.
std::string svgRect(glm::dvec2 corner, glm::dvec2 size, std::string_view fill,
                    std::string_view title);
// attributes: further ones, as they stand in the element.
std::string svgLine(glm::dvec2 from, glm::dvec2 to, std::string_view attributes);
// anchor: "start", "middle" or "end" of the text lies at x.
std::string svgText(glm::dvec2 at, std::string_view anchor, std::string_view text);

// 1, 2.5 or 5 times a power of ten of which `largest` (above 0) holds two to five: where an axis
// has its lines.
double roundStep(double largest);

}  // namespace lucerna
