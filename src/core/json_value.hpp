// Reading a JSON file that people write by hand: all faults at once, each with file, line, JSON
// pointer (RFC 6901), what was found and what was wanted.
//
//   LUCERNA_TRY(document, JsonDocument::parse(text, "lamp.json", ErrorKind::Input));
//   const JsonValue root = document.root();
//   if (root.object({"power"})) root.read("power", power, kNotNegative);
//   return document.status();
#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/math/math.hpp"

namespace lucerna {

struct JsonFault {
  std::string place;          // "lamp.json:3: /power"
  std::string found, wanted;  // without `wanted`, `found` is the whole complaint
  bool operator==(const JsonFault&) const = default;
  std::string text() const;  // "lamp.json:3: /power: found -1, wanted a number of at least 0"
};

class JsonFaults {
 public:
  explicit JsonFaults(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  void add(JsonFault fault);
  // Enough for one day: further faults are only counted.
  bool full() const { return list_.size() >= kMostFaults; }
  // The last entry says how many more there are, if so.
  std::vector<JsonFault> list() const;

 private:
  static constexpr std::size_t kMostFaults = 100;

  std::string file_;
  std::vector<JsonFault> list_;
  std::size_t uncounted_ = 0;
};

struct NumberRange {
  float min = -1e30f, max = 1e30f;
  const char* unit = "";
};
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kNotNegative{0.f, 1e30f, ""};
inline constexpr NumberRange kUnitRange{0.f, 1.f, ""};

// A value and its place. The read functions leave `out` alone and return false when the key is
// absent, or is wrong, which they report.
class JsonValue {
 public:
  JsonValue(const JsonNode& node, std::string pointer, JsonFaults& faults)
      : node_(&node), pointer_(std::move(pointer)), faults_(&faults) {}

  const JsonNode& node() const { return *node_; }
  const std::string& pointer() const { return pointer_; }
  std::string place() const;                    // "lamp.json:3", or where placedAt() says
  JsonValue placedAt(std::string place) const;  // this value and what is in it come from there
  void fault(std::string complaint) const;      // "PLACE: complaint"
  void wrong(const std::string& wanted) const;  // "PLACE: found THIS, wanted ..."
  void wrong(std::string found, std::string wanted) const;
  std::string found() const;  // the value, shortened

  // Reports and returns false if this is no object; reports keys that are not among `known`.
  bool object(std::initializer_list<const char*> known) const;
  // Reports the keys that are not there.
  void require(std::initializer_list<const char*> keys) const;
  // Reports a "lucerna" that is not `format` ("scene/1").
  void format(const std::string& format) const;
  bool isNumber() const;
  bool isList() const;
  bool has(std::string_view key) const { return node_->find(key) != nullptr; }
  JsonValue at(std::string_view key) const;                        // must be there
  std::vector<std::pair<std::string, JsonValue>> members() const;  // reports if this is no object
  std::vector<JsonValue> elements() const;  // reports and is empty if this is no list

  bool read(const char* key, float& out, NumberRange range = kAnyNumber) const;
  template <int N>
  bool read(const char* key, glm::vec<N, float>& out, NumberRange range = kAnyNumber) const {
    return has(key) && at(key).numbers({glm::value_ptr(out), N}, range);
  }
  bool read(const char* key, bool& out) const;
  bool read(const char* key, std::string& out) const;
  bool readInteger(const char* key, int& out, int min, int max) const;
  // Degrees in the file, radians in `out`.
  bool readDegrees(const char* key, float& out, NumberRange degrees) const;
  // The index of the text among `names`.
  bool readChoice(const char* key, std::initializer_list<const char*> names, int& out) const;

  bool number(float& out, NumberRange range) const;
  bool numbers(std::span<float> out, NumberRange range) const;
  bool text(std::string& out) const;
  // The index of this text among `choices`.
  bool choice(std::span<const std::string> choices, std::size_t& out) const;

 private:
  JsonValue child(const JsonNode& node, std::string_view step) const;

  const JsonNode* node_;
  std::string pointer_;
  JsonFaults* faults_;
  std::shared_ptr<const std::string> place_;  // of placedAt()
};

// A parsed file and its faults, the keys that stand twice among them.
class JsonDocument {
 public:
  static Result<JsonDocument> parse(std::string_view text, const std::string& file, ErrorKind kind);

  // The values point into this document: keep it, and where it is.
  JsonValue root() { return {root_, "", faults_}; }
  std::vector<JsonFault> faults() const { return faults_.list(); }
  Status status() const;  // an error of the given kind with one line a fault, or success

 private:
  JsonDocument(JsonNode root, JsonFaults faults, ErrorKind kind)
      : root_(std::move(root)), faults_(std::move(faults)), kind_(kind) {}

  JsonNode root_;
  JsonFaults faults_;
  ErrorKind kind_;
};

}  // namespace lucerna
