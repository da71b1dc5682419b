// Parameter values as they travel: from JSON, scripts, `--set` and panels to a pass's Params
// struct.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::graph {

// Colours and vectors travel as lists of numbers, choices as their name.
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;
using ParamValues = std::map<std::string, Value, std::less<>>;

// As JSON writes it; a text without quotes.
std::string toText(const Value& value);

// An integer or a float as a float; none for everything else.
std::optional<double> asNumber(const Value& value);

// The double that prints as the float does: 0.1f gives 0.1, not 0.10000000149.
double decimalOf(float value);

}  // namespace lucerna::graph
