// Is a value one that a parameter takes? Used by validation, `--set` and the panels alike.
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "graph/description.hpp"

namespace lucerna::graph {

struct ValueFault {
  bool wrongType = false;  // else out of range
  std::string found, wanted, remedy;
};

// None if the value is of the parameter's type and in its range. Integers count as floats; NaN and
// infinities are out of every range.
std::optional<ValueFault> checkValue(const ParamDescription& param, const Value& value);

// "a number from 0.001 to 10000 (m)", "one of Clamp, Repeat".
std::string wantedText(const ParamDescription& param);

// A value written by hand: "0.5", "true", "Clamp", "1,0.5,0" (brackets allowed). Errors
// (ErrorKind::Usage) say what was wanted; the result has passed checkValue.
Result<Value> parseValue(const ParamDescription& param, const std::string& text);

class PassType;

// The pass's description for those of the row's values that pass checkValue; the others count as
// absent, so that a description never sees a value out of range.
PassDescription describeChecked(const PassType& type, const ParamValues& values);

}  // namespace lucerna::graph
