#include "core/html.hpp"

#include <fmt/format.h>

namespace lucerna {
namespace {

constexpr std::string_view kSharedStyle = R"css(
:root { color-scheme: light dark; --line: #8886; --faint: #8882; --quiet: #777; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 1.5rem auto; max-width: 80rem; padding: 0 1rem; }
h1 { font-size: 1.4rem; margin: 0 0 .4rem; } h2 { font-size: 1.1rem; margin: 1.6rem 0 .4rem; }
p { margin: .3rem 0; } .quiet { color: var(--quiet); }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: .15rem .7rem; text-align: right; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
)css";

}  // namespace

std::string escapedXml(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= ' ') result += c;
    }
  return result;
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(bytes.size() - i, 3);
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < 3; ++b)
      bits = bits << 8 | (b < count ? std::to_integer<std::uint32_t>(bytes[i + b]) : 0);
    for (std::size_t d = 0; d < 4; ++d)
      result += d <= count ? kDigits[bits >> (18 - 6 * d) & 63] : '=';
  }
  return result;
}

std::string dataUri(std::string_view mediaType, std::span<const std::byte> bytes) {
  return fmt::format("data:{};base64,{}", mediaType, base64(bytes));
}

std::string_view seriesColor(std::size_t i) {
  static constexpr std::string_view kColors[] = {"#56b4e9", "#e69f00", "#009e73", "#f0e442",
                                                 "#0072b2", "#d55e00", "#cc79a7"};
  return kColors[i % std::size(kColors)];
}

std::string htmlText(const HtmlPage& page) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}{}</style>\n</head>\n<body>\n{}",
      escapedXml(page.title), kSharedStyle, page.style, page.body);
  if (!page.script.empty()) text += fmt::format("<script>{}</script>\n", page.script);
  return text + "</body>\n</html>\n";
}

}  // namespace lucerna
