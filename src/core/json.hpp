// JSON text as values that know their lines: what the readers of every hand-written file stand on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.hpp"

namespace lucerna {

struct JsonMember;

// One value. Objects keep the order of the text.
struct JsonNode {
  using List = std::vector<JsonNode>;
  using Members = std::vector<JsonMember>;

  std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, List, Members> value;
  int line = 1;  // of the text, where the value starts

  template <typename T>
  const T* as() const {
    return std::get_if<T>(&value);
  }
  // The member of that name; null if there is none, or if this is no object.
  const JsonNode* find(std::string_view key) const;
};

struct JsonMember {
  std::string key;
  JsonNode value;
};

// A key that stands in its object a second time: find() gives the first.
struct JsonDuplicate {
  std::string key;
  int line = 1;
};

struct ParsedJson {
  JsonNode root;
  std::vector<JsonDuplicate> duplicates;
};

inline constexpr int kMaxJsonDepth = 64;  // of nested lists and objects: what walks them recurses
inline constexpr std::size_t kMaxJsonValues = 1'000'000;  // some 100 MB once parsed

// Comments (// and /* */) are skipped. Whatever is no JSON, or has more values or levels than the
// limits above, is an error of the given kind with "file:line:column: ...".
Result<ParsedJson> parseJson(std::string_view text, const std::string& file, ErrorKind kind);

}  // namespace lucerna
