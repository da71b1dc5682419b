// Small text helpers for messages.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lucerna {

// Restricted Damerau-Levenshtein distance (optimal string alignment), case-insensitive.
int editDistance(std::string_view a, std::string_view b);

// The nearest candidate if it is near enough to be a likely typo, else "".
std::string closest(std::string_view word, std::span<const std::string> candidates);

// " (did you mean 'X'?)" or "".
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

std::string join(std::span<const std::string> words, std::string_view separator = ", ");
std::vector<std::string> split(std::string_view text, char separator);
// "1 map", "3 maps"; of nouns that take an s.
std::string counted(std::uint64_t count, std::string_view noun);
// "3 GiB", "1.5 MiB", "999 B".
std::string bytesText(std::uint64_t bytes);
bool equalIgnoringCase(std::string_view a, std::string_view b);

}  // namespace lucerna
