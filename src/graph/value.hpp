// Parameter values as they travel: from JSON, scripts, `--set` and panels to a pass's Params struct.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::graph {

// Colours and vectors travel as lists of numbers, choices as their name.
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;
using ParamValues = std::map<std::string, Value, std::less<>>;

std::string toText(const Value& value);

}  // namespace lucerna::graph
