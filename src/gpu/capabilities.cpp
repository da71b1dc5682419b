#include "gpu/capabilities.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/text.hpp"

namespace lucerna::gpu {
namespace {

using Json = nlohmann::json;

constexpr std::array kFeatures = {kFeatureCompute,         kFeatureMultisample,
                                  kFeatureDualSourceBlend, kFeatureMultiDrawIndirect,
                                  kFeatureLayeredVertex,   kFeatureClipControl};

struct Limit {
  const char* key;
  int Capabilities::* member;
};
constexpr std::array kLimits = {Limit{"maxTextureSide", &Capabilities::maxTextureSide},
                                Limit{"maxColorTargets", &Capabilities::maxColorTargets},
                                Limit{"maxSamples", &Capabilities::maxSamples}};

std::vector<std::string> featureNames() {
  return {kFeatures.begin(), kFeatures.end()};
}

std::vector<std::string> formatNames() {
  std::vector<std::string> names;
  for (const FormatInfo& format : allFormats()) names.emplace_back(format.name);
  return names;
}

// The strings of the array `key`, each one of `known`.
Result<std::vector<std::string>> readNames(const Json& json, const char* key,
                                           const std::vector<std::string>& known,
                                           const std::string& file) {
  const auto list = json.find(key);
  if (list == json.end() || !list->is_array())
    return error(ErrorKind::Input, "{}: \"{}\" must be an array of names, one or more of {}", file,
                 key, join(known));
  std::vector<std::string> names;
  for (const Json& entry : *list) {
    const std::string word = entry.is_string() ? entry.get<std::string>() : entry.dump();
    if (!entry.is_string() || std::find(known.begin(), known.end(), word) == known.end())
      return error(ErrorKind::Input, "{}: \"{}\" has '{}', which is not one of {}{}", file, key,
                   word, join(known), didYouMean(word, known));
    names.push_back(word);
  }
  return names;
}

Status checkKeys(const Json& json, const std::string& file) {
  std::vector<std::string> known = {"name", "features", "renderable", "softwareRasterizer"};
  for (const Limit& limit : kLimits) known.emplace_back(limit.key);
  for (const auto& [key, value] : json.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      return error(ErrorKind::Input, "{}: unknown key \"{}\"; known are {}{}", file, key,
                   join(known), didYouMean(key, known));
  return {};
}

Status readLimits(const Json& json, const std::string& file, Capabilities& result) {
  for (const Limit& limit : kLimits) {
    const auto value = json.find(limit.key);
    if (value == json.end()) continue;
    if (!value->is_number_integer() || *value < 1 || *value > 1 << 20)
      return error(ErrorKind::Input, "{}: \"{}\" is {}, but must be a whole number from 1 to {}",
                   file, limit.key, value->dump(), 1 << 20);
    result.*limit.member = value->get<int>();
  }
  return {};
}

}  // namespace

Capabilities Capabilities::baseline() {
  Capabilities result;
  result.name = "OpenGL 4.5 baseline";
  result.features = {std::string(kFeatureCompute), std::string(kFeatureMultisample),
                     std::string(kFeatureDualSourceBlend), std::string(kFeatureMultiDrawIndirect),
                     std::string(kFeatureClipControl)};
  for (const FormatInfo& format : allFormats())
    if (format.renderable) result.renderable.insert(format.format);
  return result;
}

Result<Capabilities> Capabilities::fromJson(const std::string& text, const std::string& name) {
  constexpr int kMaxDepth = 8;  // the form has two levels; what prints deeper ones recurses
  bool tooDeep = false;
  const auto watchDepth = [&](int depth, Json::parse_event_t, Json&) {
    tooDeep = tooDeep || depth > kMaxDepth;
    return !tooDeep;
  };
  Json json;
  try {
    json = Json::parse(text, watchDepth);
  } catch (const Json::parse_error& e) {
    return error(ErrorKind::Input, "{}: not JSON: {}", name, e.what());
  }
  if (tooDeep)
    return error(ErrorKind::Input, "{}: more than {} nested arrays and objects; wanted two", name,
                 kMaxDepth);
  if (!json.is_object())
    return error(ErrorKind::Input,
                 "{}: expected an object with \"features\" and \"renderable\", found {}", name,
                 json.type_name());
  LUCERNA_TRY_VOID(checkKeys(json, name));
  Capabilities result;
  LUCERNA_TRY(features, readNames(json, "features", featureNames(), name));
  LUCERNA_TRY(formats, readNames(json, "renderable", formatNames(), name));
  result.features.insert(features.begin(), features.end());
  for (const std::string& format : formats) result.renderable.insert(*formatFromName(format));
  LUCERNA_TRY_VOID(readLimits(json, name, result));
  if (const auto value = json.find("softwareRasterizer"); value != json.end()) {
    if (!value->is_boolean())
      return error(ErrorKind::Input, "{}: \"softwareRasterizer\" is {}, but must be true or false",
                   name, value->dump());
    result.softwareRasterizer = value->get<bool>();
  }
  const auto own = json.find("name");
  if (own != json.end() && !own->is_string())
    return error(ErrorKind::Input, "{}: \"name\" is {}, but must be a string", name, own->dump());
  result.name = own == json.end() ? name : own->get<std::string>();
  return result;
}

std::string Capabilities::toJson() const {
  Json json;
  json["name"] = name;
  json["features"] = features;
  json["renderable"] = Json::array();
  for (const Format format : renderable) json["renderable"].push_back(info(format).name);
  for (const Limit& limit : kLimits) json[limit.key] = this->*limit.member;
  json["softwareRasterizer"] = softwareRasterizer;
  return json.dump(2);
}

}  // namespace lucerna::gpu
