// Reading small JSON files with errors that name the file, the place, what was found and wanted.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "core/math/math.hpp"
#include "core/result.hpp"

namespace lucerna::app {

// Collects the first fault while fields are read; reading goes on with defaults.
class JsonReader {
 public:
  // place: "camera.json" or "path.json, keyframe 2".
  JsonReader(const nlohmann::json& object, std::string place);

  float number(const char* key, float fallback, double min, double max);
  vec3 vector(const char* key, vec3 fallback);
  void require(std::initializer_list<const char*> keys);
  void allowOnly(std::initializer_list<const char*> keys);
  Status status() const;

 private:
  void fail(std::string message);
  const nlohmann::json& object_;
  std::string place_;
  std::string fault_;
};

// Parses an object, and checks that its "lucerna", if there, says `kind` ("camera/1").
Result<nlohmann::json> parseDocument(const std::string& text, const std::string& name,
                                     const std::string& kind);

}  // namespace lucerna::app
