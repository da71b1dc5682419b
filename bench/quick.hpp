// What the tests ask of a benchmark: that it runs and its checks hold, not that its figures mean
// much.
#pragma once

#include <string_view>

inline bool isQuick(int count, char** words) {
  return count == 2 && std::string_view(words[1]) == "--quick";
}
