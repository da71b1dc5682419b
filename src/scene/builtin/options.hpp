// The "key=value&..." part of a built-in scene's name.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/math/math.hpp"
#include "core/result.hpp"

namespace lucerna::scene::builtin {

// Each call names one key that the scene knows and its target; finish() then reports every key
// that nobody asked for and every value that does not fit, one per line.
class OptionReader {
 public:
  OptionReader(std::string spec, std::string_view query);

  void number(const std::string& key, float& target, float low, float high);
  void integer(const std::string& key, std::uint32_t& target, std::uint32_t low,
               std::uint32_t high);
  void flag(const std::string& key, bool& target);
  // One of the words; target becomes its index.
  void choice(const std::string& key, int& target, std::span<const std::string> words);
  // Two numbers with a comma, each within [low, high].
  void pair(const std::string& key, std::optional<vec2>& target, vec2 low, vec2 high);
  Status finish();

 private:
  // The value of the key if it was given, which then counts as known.
  std::optional<std::string> take(const std::string& key);
  void fault(const std::string& key, const std::string& found, const std::string& wanted);

  std::string spec_;
  std::vector<std::pair<std::string, std::string>> given_;
  std::vector<std::string> known_;
  std::vector<std::string> faults_;
};

}  // namespace lucerna::scene::builtin
