#include "scene/builtin/options.hpp"

#include <charconv>
#include <cmath>

#include "core/text.hpp"

namespace lucerna::scene::builtin {
namespace {

template <typename T>
std::optional<T> parse(std::string_view text) {
  T value{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<float> parseWithin(std::string_view text, float low, float high) {
  const auto value = parse<float>(text);
  if (!value || !(*value >= low && *value <= high)) return std::nullopt;
  return value;
}

}  // namespace

OptionReader::OptionReader(std::string spec, std::string_view query) : spec_(std::move(spec)) {
  for (const std::string& part : query.empty() ? std::vector<std::string>{} : split(query, '&')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) {
      fault(part, "no value", "key=value");
      known_.push_back(part);
      continue;
    }
    const std::string key = part.substr(0, equals);
    for (const auto& [other, value] : given_)
      if (other == key) fault(key, "the key twice", "it once");
    given_.emplace_back(key, part.substr(equals + 1));
  }
}

std::optional<std::string> OptionReader::take(const std::string& key) {
  known_.push_back(key);
  for (const auto& [name, value] : given_)
    if (name == key) return value;
  return std::nullopt;
}

void OptionReader::fault(const std::string& key, const std::string& found,
                         const std::string& wanted) {
  faults_.push_back(fmt::format("{}: {}: found {}, wanted {}", spec_, key, found, wanted));
}

void OptionReader::number(const std::string& key, float& target, float low, float high) {
  if (const auto text = take(key)) {
    if (const auto value = parseWithin(*text, low, high))
      target = *value;
    else
      fault(key, "'" + *text + "'", fmt::format("a number from {} to {}", low, high));
  }
}

void OptionReader::integer(const std::string& key, std::uint32_t& target, std::uint32_t low,
                           std::uint32_t high) {
  if (const auto text = take(key)) {
    const auto value = parse<std::uint32_t>(*text);
    if (value && *value >= low && *value <= high)
      target = *value;
    else
      fault(key, "'" + *text + "'", fmt::format("a whole number from {} to {}", low, high));
  }
}

void OptionReader::flag(const std::string& key, bool& target) {
  std::uint32_t value = target;
  integer(key, value, 0, 1);
  target = value != 0;
}

void OptionReader::choice(const std::string& key, int& target, std::span<const std::string> words) {
  if (const auto text = take(key)) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] != *text) continue;
      target = static_cast<int>(i);
      return;
    }
    fault(key, "'" + *text + "'" + didYouMean(*text, words), "one of " + join(words));
  }
}

void OptionReader::pair(const std::string& key, std::optional<vec2>& target, vec2 low, vec2 high) {
  if (const auto text = take(key)) {
    const std::vector<std::string> parts = split(*text, ',');
    if (parts.size() == 2) {
      const auto x = parseWithin(parts[0], low.x, high.x);
      const auto y = parseWithin(parts[1], low.y, high.y);
      if (x && y) {
        target = vec2(*x, *y);
        return;
      }
    }
    fault(key, "'" + *text + "'",
          fmt::format("two numbers with a comma, {} to {} and {} to {}", low.x, high.x, low.y,
                      high.y));
  }
}

Status OptionReader::finish() {
  for (const auto& [key, value] : given_) {
    bool known = false;
    for (const std::string& name : known_) known = known || name == key;
    if (!known)
      faults_.push_back(fmt::format("{}: unknown key '{}'{}; this scene knows {}", spec_, key,
                                    didYouMean(key, known_), join(known_)));
  }
  if (faults_.empty()) return {};
  return Error{ErrorKind::Input, join(faults_, "\n")};
}

}  // namespace lucerna::scene::builtin
