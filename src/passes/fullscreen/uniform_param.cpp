#include "passes/fullscreen/uniform_param.hpp"

#include <charconv>

#include "core/text.hpp"

namespace lucerna::passes {
namespace {

using graph::ParamDescription;
using graph::ParamType;

struct TypeInfo {
  std::string_view glsl;
  ParamType type;
  std::size_t size;
};
constexpr TypeInfo kTypes[] = {{"float", ParamType::Float, 1}, {"int", ParamType::Int, 1},
                               {"bool", ParamType::Bool, 1},   {"vec2", ParamType::Vector, 2},
                               {"vec3", ParamType::Vector, 3}, {"vec4", ParamType::Vector, 4}};

const TypeInfo* find(std::string_view glslType) {
  for (const TypeInfo& info : kTypes)
    if (info.glsl == glslType) return &info;
  return nullptr;
}

// A GLSL literal: "0.5", "-1.", "2e3f".
std::optional<double> numberOf(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.ends_with('f') || text.ends_with('F')) text.remove_suffix(1);
  double number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// "vec3(1, 2, 3)" or "vec3(1)" as `size` numbers.
std::optional<std::vector<double>> numbersOf(std::string_view text, const TypeInfo& info) {
  if (!text.starts_with(info.glsl) || !text.ends_with(')')) return std::nullopt;
  text.remove_prefix(info.glsl.size());
  if (!text.starts_with('(')) return std::nullopt;
  std::vector<double> numbers;
  for (const std::string& part : split(text.substr(1, text.size() - 2), ',')) {
    const auto number = numberOf(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() == 1) numbers.resize(info.size, numbers[0]);
  return numbers.size() == info.size ? std::optional(numbers) : std::nullopt;
}

// The value that the declaration gives, zero without one. None if it is not a literal.
std::optional<graph::Value> initialValue(const std::string& text, const TypeInfo& info) {
  switch (info.type) {
    case ParamType::Bool:
      if (text.empty() || text == "false") return graph::Value(false);
      return text == "true" ? std::optional(graph::Value(true)) : std::nullopt;
    case ParamType::Int: {
      const auto number = numberOf(text.empty() ? "0" : text);
      if (!number || text.find_first_of(".eEfF") != std::string::npos) return std::nullopt;
      return graph::Value(static_cast<std::int64_t>(*number));
    }
    case ParamType::Float: {
      const auto number = numberOf(text.empty() ? "0" : text);
      return number ? std::optional(graph::Value(*number)) : std::nullopt;
    }
    default: {
      if (text.empty()) return graph::Value(std::vector<double>(info.size, 0.0));
      const auto numbers = numbersOf(text, info);
      return numbers ? std::optional(graph::Value(*numbers)) : std::nullopt;
    }
  }
}

// "MIN to MAX UNIT: help", "color: help" or help alone.
void readComment(const std::string& comment, ParamDescription& param) {
  param.help = comment;
  const std::size_t colon = comment.find(':');
  if (colon == std::string::npos) return;
  const std::string head = comment.substr(0, colon);
  const std::vector<std::string> words = split(head, ' ');
  if (head == "color" && param.type == ParamType::Vector && param.size == 3) {
    param.type = ParamType::Color;
  } else if (words.size() >= 3 && words.size() <= 4 && words[1] == "to" && numberOf(words[0]) &&
             numberOf(words[2])) {
    param.min = numberOf(words[0]);
    param.max = numberOf(words[2]);
    if (words.size() == 4) param.unit = words[3];
  } else {
    return;
  }
  param.help = comment.substr(std::min(comment.find_first_not_of(' ', colon + 1), comment.size()));
}

}  // namespace

bool isParamType(std::string_view glslType) {
  return find(glslType) != nullptr;
}

std::optional<ParamDescription> paramOf(const ShaderInterface::Uniform& uniform,
                                        graph::ValueFault& fault) {
  const TypeInfo* info = find(uniform.type);
  CHECK(info, "'{}' is no type of a parameter", uniform.type);
  const auto value = initialValue(uniform.initial, *info);
  if (!value) {
    fault = {.found = fmt::format("'{}'", uniform.initial),
             .wanted = fmt::format("a literal of type {}", uniform.type),
             .remedy = "write the number out"};
    return std::nullopt;
  }
  ParamDescription param{
      .name = uniform.name, .type = info->type, .defaultValue = *value, .size = info->size};
  readComment(uniform.comment, param);
  const auto outside = graph::checkValue(param, *value);
  if (!outside) return param;
  fault = *outside;
  fault.remedy = "change the value or the range in its comment";
  return std::nullopt;
}

}  // namespace lucerna::passes
