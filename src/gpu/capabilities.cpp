#include "gpu/capabilities.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/json_value.hpp"
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
                                Limit{"maxTextureLayers", &Capabilities::maxTextureLayers},
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

// The indices in `known` of the names in the list `key`.
std::vector<std::size_t> readNames(const JsonValue& json, const char* key,
                                   const std::vector<std::string>& known) {
  std::vector<std::size_t> indices;
  if (!json.has(key)) {
    json.wrong(fmt::format("no \"{}\"", key), "a list of names, each one of " + join(known));
    return indices;
  }
  for (const JsonValue& name : json.at(key).elements())
    if (std::size_t index = 0; name.choice(known, index)) indices.push_back(index);
  return indices;
}

void readCapabilities(const JsonValue& json, Capabilities& result) {
  if (!json.object({"name", "features", "renderable", "maxTextureSide", "maxTextureLayers",
                    "maxColorTargets", "maxSamples", "softwareRasterizer"}))
    return;
  json.read("name", result.name);
  for (const std::size_t i : readNames(json, "features", featureNames()))
    result.features.emplace(kFeatures[i]);
  for (const std::size_t i : readNames(json, "renderable", formatNames()))
    result.renderable.insert(allFormats()[i].format);
  for (const Limit& limit : kLimits) json.readInteger(limit.key, result.*limit.member, 1, 1 << 20);
  json.read("softwareRasterizer", result.softwareRasterizer);
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
  LUCERNA_TRY(document, JsonDocument::parse(text, name, ErrorKind::Input));
  Capabilities result;
  result.name = name;
  const JsonValue root = document.root();
  readCapabilities(root.has("gl") ? root.at("gl") : root, result);
  LUCERNA_TRY_VOID(document.status());
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
