// Pages that stand alone: one HTML file that a browser shows without any other file or a network.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lucerna {

// For the text and the quoted attributes of HTML, SVG and XML. Control characters are left out.
std::string escapedXml(std::string_view text);

std::string base64(std::span<const std::byte> bytes);  // RFC 4648, padded

// What `src` needs to hold a file: "data:image/png;base64,...".
std::string dataUri(std::string_view mediaType, std::span<const std::byte> bytes);

// "#rrggbb" of the i-th of things drawn side by side: seven colours, told apart also by people who
// see few (Okabe and Ito, 2008), again and again.
std::string_view seriesColor(std::size_t i);

struct HtmlPage {
  std::string_view title{};   // escaped here
  std::string_view style{};   // CSS, after the style that all pages share
  std::string_view body{};    // HTML: what stands in <body>
  std::string_view script{};  // JavaScript that runs when the body is there; may be empty
};
std::string htmlText(const HtmlPage& page);

}  // namespace lucerna
