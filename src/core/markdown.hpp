// Text for Markdown files.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lucerna {

// Any text as Markdown that shows it as it is. Control characters are left out.
std::string escapedMarkdown(std::string_view text);

// A table; every row has as many cells as the head. Cells are escaped here. The first column is
// left-aligned, the others, which hold numbers, right.
std::string markdownTable(const std::vector<std::string>& head,
                          std::span<const std::vector<std::string>> rows);

}  // namespace lucerna
