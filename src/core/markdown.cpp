#include "core/markdown.hpp"

#include "core/check.hpp"

namespace lucerna {
namespace {

std::string lineOf(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + escapedMarkdown(cell) + " |";
  return line + "\n";
}

}  // namespace

std::string escapedMarkdown(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("\\`*_{}[]<>#|~&").find(c) != std::string_view::npos) result += '\\';
    if (static_cast<unsigned char>(c) >= ' ') result += c;
  }
  return result;
}

std::string markdownTable(const std::vector<std::string>& head,
                          std::span<const std::vector<std::string>> rows) {
  std::string text = lineOf(head) + "|---|";
  for (std::size_t i = 1; i < head.size(); ++i) text += "--:|";
  text += "\n";
  for (const auto& row : rows) {
    CHECK(row.size() == head.size(), "a row of {} cells under {}", row.size(), head.size());
    text += lineOf(row);
  }
  return text;
}

}  // namespace lucerna
