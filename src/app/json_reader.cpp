#include "app/json_reader.hpp"

#include <cmath>
#include <vector>

#include "core/text.hpp"

namespace lucerna::app {

using Json = nlohmann::json;

JsonReader::JsonReader(const Json& object, std::string place)
    : object_(object), place_(std::move(place)) {
  if (!object_.is_object()) fail(fmt::format("found {}, wanted an object", object_.type_name()));
}

float JsonReader::number(const char* key, float fallback, double min, double max) {
  if (!object_.is_object() || !object_.contains(key)) return fallback;
  const Json& value = object_[key];
  if (!value.is_number() || value.get<double>() < min || value.get<double>() > max) {
    fail(fmt::format("'{}' is {}; a number from {} to {} is wanted", key, value.dump(), min, max));
    return fallback;
  }
  return value.get<float>();
}

vec3 JsonReader::vector(const char* key, vec3 fallback) {
  if (!object_.is_object() || !object_.contains(key)) return fallback;
  const Json& value = object_[key];
  vec3 result{0.f};
  bool good = value.is_array() && value.size() == 3;
  for (int i = 0; good && i < 3; ++i) {
    good = value[i].is_number();
    if (good) result[i] = value[i].get<float>();
    good = good && std::isfinite(result[i]);
  }
  if (good) return result;
  fail(fmt::format("'{}' is {}; three numbers like [0, 1.7, 5] are wanted", key, value.dump()));
  return fallback;
}

void JsonReader::require(std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (object_.is_object() && !object_.contains(key)) fail(fmt::format("'{}' is missing", key));
}

void JsonReader::allowOnly(std::initializer_list<const char*> keys) {
  if (!object_.is_object()) return;
  const std::vector<std::string> known(keys.begin(), keys.end());
  for (const auto& [key, value] : object_.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      fail(fmt::format("'{}' is not known{}; wanted {}", key, didYouMean(key, known), join(known)));
}

Status JsonReader::status() const {
  if (fault_.empty()) return {};
  return error(ErrorKind::Input, "{}: {}", place_, fault_);
}

void JsonReader::fail(std::string message) {
  if (fault_.empty()) fault_ = std::move(message);
}

Result<Json> parseDocument(const std::string& text, const std::string& name,
                           const std::string& kind) {
  Json document;
  try {
    document = Json::parse(text);
  } catch (const Json::exception& e) {
    const std::string what =
        e.what();  // "[json.exception.parse_error.101] parse error at line ..."
    const std::size_t start = what.find("] ");
    return error(ErrorKind::Input, "{}: {}", name,
                 start == std::string::npos ? what : what.substr(start + 2));
  }
  if (!document.is_object())
    return error(ErrorKind::Input, "{}: found {}, wanted an object", name, document.type_name());
  const Json found = document.value("lucerna", Json(kind));
  if (found != kind)
    return error(ErrorKind::Input, "{}: \"lucerna\" is {}; \"{}\" is wanted", name, found.dump(),
                 kind);
  return document;
}

}  // namespace lucerna::app
