#include "scene/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;

constexpr std::size_t kShownCharacters = 60;
constexpr int kMaxDepth = 64;  // of nested arrays and objects: what prints them recurses

// ~ and / of a key as a JSON pointer writes them (RFC 6901).
std::string escaped(std::string_view key) {
  std::string result;
  for (const char c : key) {
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += c;
  }
  return result;
}

// Steps through well-formed JSON text.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  std::size_t at() const { return at_; }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void next() { ++at_; }

  void skipSpace() {
    for (;;) {
      while (at_ < text_.size() && std::string_view(" \t\r\n,:").find(peek()) != std::string::npos)
        ++at_;
      const std::string_view rest = std::string_view(text_).substr(std::min(at_, text_.size()));
      if (rest.starts_with("//"))
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (rest.starts_with("/*"))
        at_ = std::min(text_.find("*/", at_), text_.size() - 2) + 2;
      else
        return;
    }
  }
  std::string_view skipString() {
    const std::size_t start = at_;
    for (++at_; at_ < text_.size() && peek() != '"'; ++at_)
      if (peek() == '\\') ++at_;
    ++at_;
    return std::string_view(text_).substr(start, at_ - start);
  }
  void skipValue() {
    int depth = 0;
    do {
      skipSpace();
      const char c = peek();
      if (c == '"') {
        skipString();
      } else if (c == '{' || c == '[') {
        ++depth;
        next();
      } else if (c == '}' || c == ']') {
        --depth;
        next();
      } else {
        while (at_ < text_.size() &&
               std::string_view(" \t\r\n,:]}").find(peek()) == std::string::npos)
          ++at_;
      }
    } while (depth > 0 && at_ < text_.size());
  }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
};

// Moves into the member or element named by one step of a pointer; false if it is not there.
bool enter(Scanner& scanner, const std::string& step) {
  scanner.skipSpace();
  const char open = scanner.peek();
  if (open != '{' && open != '[') return false;
  scanner.next();
  for (std::size_t index = 0;; ++index) {
    scanner.skipSpace();
    if (scanner.peek() == '}' || scanner.peek() == ']' || scanner.peek() == '\0') return false;
    if (open == '[') {
      if (std::to_string(index) == step) return true;
    } else {
      const json key = json::parse(scanner.skipString(), nullptr, false);
      scanner.skipSpace();
      if (key.is_string() && escaped(key.get_ref<const std::string&>()) == step) return true;
    }
    scanner.skipValue();
  }
}

}  // namespace

Result<json> parseJson(const std::string& text, const std::string& file) {
  bool tooDeep = false;
  const auto watchDepth = [&](int depth, json::parse_event_t, json&) {
    tooDeep = tooDeep || depth > kMaxDepth;
    return !tooDeep;
  };
  try {
    json root = json::parse(text, watchDepth, /*allow_exceptions=*/true, /*ignore_comments=*/true);
    if (tooDeep)
      return error(ErrorKind::Input,
                   "{}: more than {} nested arrays and objects; wanted at most {}", file, kMaxDepth,
                   kMaxDepth);
    return root;
  } catch (const json::exception& fault) {
    // "[json.exception.parse_error.101] parse error at line ..."
    const std::string what = fault.what();
    const std::size_t tag = what.find("] ");
    return error(ErrorKind::Input, "{}: is no JSON: {}", file,
                 tag == std::string::npos ? what : what.substr(tag + 2));
  }
}

int lineOf(const std::string& text, const std::string& pointer) {
  Scanner scanner(text);
  std::vector<std::string> steps = split(pointer, '/');
  if (!steps.empty()) steps.erase(steps.begin());  // before the first slash
  for (const std::string& step : steps)
    if (!enter(scanner, step)) break;
  scanner.skipSpace();
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(scanner.at(), text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

void JsonFaults::add(const std::string& pointer, const std::string& problem) {
  lines_.push_back(fmt::format("{}:{}: {}: {}", file_, lineOf(text_, pointer),
                               pointer.empty() ? "/" : pointer, problem));
}

Status JsonFaults::status() const {
  if (lines_.empty()) return {};
  return Error{ErrorKind::Input, join(lines_, "\n")};
}

std::string JsonValue::found() const {
  std::string text = value_->dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > kShownCharacters) text = text.substr(0, kShownCharacters) + "...";
  return text;
}

void JsonValue::wrong(const std::string& wanted) const {
  fault(fmt::format("found {}, wanted {}", found(), wanted));
}

bool JsonValue::object(std::initializer_list<const char*> known) const {
  if (!value_->is_object()) {
    wrong("an object");
    return false;
  }
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, value] : members())
    if (std::find(names.begin(), names.end(), key) == names.end())
      value.fault(fmt::format("unknown key '{}'{}; wanted one of {}", key, didYouMean(key, names),
                              join(names)));
  return true;
}

void JsonValue::require(std::initializer_list<const char*> keys) const {
  for (const char* key : keys)
    if (!has(key)) fault(fmt::format("'{}' is missing", key));
}

void JsonValue::format(const std::string& format) const {
  if (!has("lucerna"))
    return fault(fmt::format("found no \"lucerna\", wanted \"lucerna\": \"{}\"", format));
  std::string found;
  if (read("lucerna", found) && found != format) at("lucerna").wrong(fmt::format("\"{}\"", format));
}

bool JsonValue::isNumber() const {
  return value_->is_number();
}

bool JsonValue::has(const char* key) const {
  return value_->is_object() && value_->contains(key);
}

JsonValue JsonValue::at(const char* key) const {
  return {value_->at(key), pointer_ + "/" + escaped(key), *faults_};
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const {
  std::vector<std::pair<std::string, JsonValue>> result;
  if (!value_->is_object()) {
    wrong("an object");
    return result;
  }
  for (const auto& [key, value] : value_->items())
    result.emplace_back(key, JsonValue(value, pointer_ + "/" + escaped(key), *faults_));
  return result;
}

std::vector<JsonValue> JsonValue::elements() const {
  std::vector<JsonValue> result;
  if (!value_->is_array()) {
    wrong("a list");
    return result;
  }
  for (std::size_t i = 0; i < value_->size(); ++i)
    result.emplace_back((*value_)[i], fmt::format("{}/{}", pointer_, i), *faults_);
  return result;
}

bool JsonValue::number(float& out, Limits limits) const {
  const double value = value_->is_number() ? value_->get<double>() : std::nan("");
  if (value >= limits.min && value <= limits.max) {
    out = static_cast<float>(value);
    return true;
  }
  const std::string unit = *limits.unit ? fmt::format(" {}", limits.unit) : "";
  if (limits.max >= 1e30f && limits.min <= -1e30f)
    wrong("a number" + unit);
  else if (limits.max >= 1e30f)
    wrong(fmt::format("a number of at least {}{}", limits.min, unit));
  else
    wrong(fmt::format("a number from {} to {}{}", limits.min, limits.max, unit));
  return false;
}

bool JsonValue::numbers(std::span<float> out, Limits limits) const {
  if (!value_->is_array() || value_->size() != out.size()) {
    wrong(fmt::format("a list of {} numbers", out.size()));
    return false;
  }
  std::vector<float> values(out.size());
  bool good = true;
  const std::vector<JsonValue> list = elements();
  for (std::size_t i = 0; i < list.size(); ++i) good = list[i].number(values[i], limits) && good;
  if (good) std::copy(values.begin(), values.end(), out.begin());
  return good;
}

bool JsonValue::text(std::string& out) const {
  if (!value_->is_string() || value_->get_ref<const std::string&>().empty()) {
    wrong("a text");
    return false;
  }
  out = value_->get<std::string>();
  return true;
}

bool JsonValue::read(const char* key, float& out, Limits limits) const {
  return has(key) && at(key).number(out, limits);
}

bool JsonValue::read(const char* key, vec3& out, Limits limits) const {
  return has(key) && at(key).numbers({glm::value_ptr(out), 3}, limits);
}

bool JsonValue::read(const char* key, bool& out) const {
  if (!has(key)) return false;
  const JsonValue value = at(key);
  if (!value.value_->is_boolean()) {
    value.wrong("true or false");
    return false;
  }
  out = value.value_->get<bool>();
  return true;
}

bool JsonValue::read(const char* key, std::string& out) const {
  return has(key) && at(key).text(out);
}

bool JsonValue::readDegrees(const char* key, float& out, Limits degrees) const {
  degrees.unit = "degrees";
  float value = 0.f;
  if (!read(key, value, degrees)) return false;
  out = glm::radians(value);
  return true;
}

bool JsonValue::readChoice(const char* key, std::initializer_list<const char*> names,
                           int& out) const {
  if (!has(key)) return false;
  const JsonValue value = at(key);
  const std::vector<std::string> choices(names.begin(), names.end());
  std::string text;
  if (value.value_->is_string()) text = value.value_->get<std::string>();
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end()) {
    value.wrong(fmt::format("one of {}{}", join(choices), didYouMean(text, choices)));
    return false;
  }
  out = static_cast<int>(found - choices.begin());
  return true;
}

}  // namespace lucerna::scene
