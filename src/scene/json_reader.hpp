// Reading a JSON file that people write by hand: all faults at once, each with file, line, JSON
// pointer, what was found and what was wanted.
#pragma once

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/math/math.hpp"
#include "core/result.hpp"

namespace lucerna::scene {

class JsonFaults {
 public:
  // `text` must outlive this; lines are found in it.
  JsonFaults(std::string file, const std::string& text) : file_(std::move(file)), text_(text) {}

  void add(const std::string& pointer, const std::string& problem);
  Status status() const;  // an Input error with one line a fault, or success

 private:
  std::string file_;
  const std::string& text_;
  std::vector<std::string> lines_;
};

// Parses a file's text; // and /* */ comments are skipped. ErrorKind::Input names the file, line
// and column.
Result<nlohmann::json> parseJson(const std::string& text, const std::string& file);

// 1-based line where the value of `pointer` starts in the JSON text, which must be well-formed.
int lineOf(const std::string& text, const std::string& pointer);

struct Limits {
  float min = -1e30f, max = 1e30f;
  const char* unit = "";
};
inline constexpr Limits kAnyNumber{};
inline constexpr Limits kNotNegative{0.f, 1e30f, ""};
inline constexpr Limits kUnitRange{0.f, 1.f, ""};

// A value and its place. The read functions leave `out` alone and return false when the key is
// absent, or is wrong, which they report.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& value, std::string pointer, JsonFaults& faults)
      : value_(&value), pointer_(std::move(pointer)), faults_(&faults) {}

  const std::string& pointer() const { return pointer_; }
  void fault(const std::string& problem) const { faults_->add(pointer_, problem); }
  void wrong(const std::string& wanted) const;  // "found X, wanted ..."
  std::string found() const;                    // the value, shortened

  // Reports and returns false if this is no object; reports keys that are not among `known`.
  bool object(std::initializer_list<const char*> known) const;
  // Reports the keys that are not there.
  void require(std::initializer_list<const char*> keys) const;
  // Reports a "lucerna" that is not `format` ("scene/1").
  void format(const std::string& format) const;
  bool isNumber() const;
  bool has(const char* key) const;
  JsonValue at(const char* key) const;  // must be there
  std::vector<std::pair<std::string, JsonValue>> members() const;
  std::vector<JsonValue> elements() const;  // reports and is empty if this is no array

  bool read(const char* key, float& out, Limits limits = kAnyNumber) const;
  bool read(const char* key, vec3& out, Limits limits = kAnyNumber) const;
  bool read(const char* key, bool& out) const;
  bool read(const char* key, std::string& out) const;
  // Degrees in the file, radians in `out`.
  bool readDegrees(const char* key, float& out, Limits degrees) const;
  // The index of the text among `names`.
  bool readChoice(const char* key, std::initializer_list<const char*> names, int& out) const;

  bool number(float& out, Limits limits) const;
  bool numbers(std::span<float> out, Limits limits) const;
  bool text(std::string& out) const;

 private:
  const nlohmann::json* value_;
  std::string pointer_;
  JsonFaults* faults_;
};

}  // namespace lucerna::scene
