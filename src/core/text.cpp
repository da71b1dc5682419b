#include "core/text.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace lucerna {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool startsWithIgnoringCase(std::string_view text, std::string_view prefix) {
  return text.size() >= prefix.size() && equalIgnoringCase(text.substr(0, prefix.size()), prefix);
}

}  // namespace

int editDistance(std::string_view a, std::string_view b) {
  // Three rows of the dynamic programme: two above the current one, for transpositions.
  std::vector<int> twoAbove(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substitution = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + substitution});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], twoAbove[j - 2] + 1);
    }
    twoAbove.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

std::string closest(std::string_view word, std::span<const std::string> candidates) {
  // A third of the letters may be wrong, three at most; a beginning of the name also counts.
  const int allowed = std::clamp(static_cast<int>(word.size()) / 3, 1, 3);
  int best = std::min(allowed, static_cast<int>(word.size()) - 1) + 1;
  std::string result;
  for (const std::string& candidate : candidates) {
    const auto lengths = std::minmax({word.size(), candidate.size()});
    if (lengths.second - lengths.first >= static_cast<std::size_t>(best)) continue;
    if (const int distance = editDistance(word, candidate); distance < best) {
      best = distance;
      result = candidate;
    }
  }
  if (!result.empty() || word.size() < 3) return result;
  const auto longer = std::find_if(candidates.begin(), candidates.end(), [&](const auto& name) {
    return startsWithIgnoringCase(name, word);
  });
  return longer == candidates.end() ? "" : *longer;
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
  const std::string found = closest(word, candidates);
  return found.empty() ? "" : " (did you mean '" + found + "'?)";
}

std::string join(std::span<const std::string> words, std::string_view separator) {
  std::string result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) result += separator;
    result += words[i];
  }
  return result;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string bytesText(std::uint64_t bytes) {
  static constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
  return fmt::format("{:.4g} {}", value, kUnits[unit]);
}

bool equalIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace lucerna
