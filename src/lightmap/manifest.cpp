#include "lightmap/manifest.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/hash.hpp"
#include "core/json_value.hpp"

namespace lucerna::lightmap {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "lightmap/1";
constexpr int kMostIndex = 1 << 30;

Json json(const FileEntry& entry) {
  return {{"file", entry.file}, {"hash", entry.hash}};
}

Json json(const MapEntry& map) {
  Json encoded = Json::array();
  for (const FileEntry& entry : map.encoded) encoded.push_back(json(entry));
  return {{"master", json(map.master)},
          {"encoded", std::move(encoded)},
          {"largest", {map.largest.x, map.largest.y, map.largest.z}},
          {"texels", map.texels}};
}

Json json(const PatchEntry& patch) {
  return {{"group", patch.group},     {"form", patch.form},   {"file", patch.patch.file},
          {"hash", patch.patch.hash}, {"bytes", patch.bytes}, {"otherBytes", patch.otherBytes}};
}

// Nodes and lights may be without a name, and lights without a group: an empty text is no text in
// JSON as it is read here.
void addText(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

Json json(const ObjectEntry& object) {
  Json result = {{"object", object.object}};
  addText(result, "node", object.node);
  result["charts"] = object.charts;
  result["maps"] = object.maps;
  addText(result, "hash", object.hash);
  return result;
}

Json json(const LightEntry& light) {
  Json result = {{"light", light.light}};
  addText(result, "name", light.name);
  addText(result, "group", light.group);
  addText(result, "hash", light.hash);
  return result;
}

template <typename T>
Json list(const std::vector<T>& entries) {
  Json result = Json::array();
  for (const T& entry : entries) result.push_back(json(entry));
  return result;
}

// Names a file of the folder itself: never one outside.
bool isPlainName(const std::string& name) {
  return !name.empty() && name != "." && name != ".." &&
         name.find_first_of("/\\") == std::string::npos;
}

bool isHash(const std::string& hash) {
  return hash.size() == 16 && hash.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void readFileEntry(const JsonValue& value, FileEntry& entry) {
  if (value.read("file", entry.file) && !isPlainName(entry.file))
    value.at("file").wrong("the name of a file beside the manifest");
  if (value.read("hash", entry.hash) && !isHash(entry.hash))
    value.at("hash").wrong("sixteen hexadecimal digits");
  value.require({"file", "hash"});
}

void readEntry(const JsonValue& value, FileEntry& entry) {
  if (value.object({"file", "hash"})) readFileEntry(value, entry);
}

// Counts of more than 2^30 are none of a lightmap's.
void readCount(const JsonValue& value, const char* key, std::uint64_t& out) {
  int count = 0;
  if (value.readInteger(key, count, 0, kMostIndex)) out = static_cast<std::uint64_t>(count);
}
void readIndex(const JsonValue& value, const char* key, std::uint32_t& out) {
  int index = 0;
  if (value.readInteger(key, index, 0, kMostIndex)) out = static_cast<std::uint32_t>(index);
}

void readEntry(const JsonValue& value, MapEntry& map) {
  if (!value.object({"master", "encoded", "largest", "texels"})) return;
  value.require({"master"});
  if (value.has("master")) readEntry(value.at("master"), map.master);
  if (value.has("encoded"))
    for (const JsonValue& encoded : value.at("encoded").elements())
      readEntry(encoded, map.encoded.emplace_back());
  value.read("largest", map.largest, kNotNegative);
  readCount(value, "texels", map.texels);
}

void readEntry(const JsonValue& value, PatchEntry& patch) {
  if (!value.object({"group", "form", "file", "hash", "bytes", "otherBytes"})) return;
  value.require({"group", "form"});
  value.read("group", patch.group);
  int form = 0;
  if (value.readChoice("form", {"tiles", "triangles"}, form))
    patch.form = form == 0 ? "tiles" : "triangles";
  readFileEntry(value, patch.patch);
  readCount(value, "bytes", patch.bytes);
  readCount(value, "otherBytes", patch.otherBytes);
}

void readEntry(const JsonValue& value, ObjectEntry& object) {
  if (!value.object({"object", "node", "charts", "maps", "hash"})) return;
  readIndex(value, "object", object.object);
  value.read("node", object.node);
  readIndex(value, "charts", object.charts);
  value.read("hash", object.hash);
  if (!value.has("maps")) return;
  for (const JsonValue& map : value.at("maps").elements()) {
    float index = 0.f;
    if (map.number(index, {0.f, 65535.f, ""})) object.maps.push_back(static_cast<int>(index));
  }
}

void readEntry(const JsonValue& value, LightEntry& light) {
  if (!value.object({"light", "name", "group", "hash"})) return;
  readIndex(value, "light", light.light);
  value.read("name", light.name);
  value.read("group", light.group);
  value.read("hash", light.hash);
}

template <typename T>
void readList(const JsonValue& root, const char* key, std::vector<T>& entries) {
  if (!root.has(key)) return;
  for (const JsonValue& value : root.at(key).elements()) readEntry(value, entries.emplace_back());
}

// Names from foreign files may be no UTF-8.
std::string textOf(const Json& document) {
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string hashOf(const Json& document) {
  return hashText16(hashText(textOf(document)));
}

// Whether it says what it is, well-formed or not.
bool saysLightmap(std::string_view text) {
  return text.find("\"lightmap/") != std::string_view::npos;
}

Error noManifest(const std::string& name) {
  return error(ErrorKind::Input,
               "{}: is not a lightmap's manifest: found no \"lucerna\": \"{}\"; wanted the folder "
               "of a finished `lucerna bake`",
               name, kFormat);
}

// A lightmap's manifest: what it is comes before what is wrong with it.
Result<JsonDocument> parsed(std::string_view text, const std::string& name) {
  auto document = JsonDocument::parse(text, name, ErrorKind::Input);
  if (!document && !saysLightmap(text)) return noManifest(name);
  if (!document) {
    const std::string& fault = document.error().message;  // without what would mend another file
    return error(ErrorKind::Input, "{}; the manifest is damaged: bake the scene again",
                 fault.substr(0, fault.find("; ", name.size())));
  }
  const JsonValue root = document->root();
  const JsonNode* format = root.node().find("lucerna");
  const auto* found = format ? format->as<std::string>() : nullptr;
  if (!found || !found->starts_with("lightmap/")) return noManifest(name);
  if (*found == kFormat) return document;
  return error(ErrorKind::Input,
               "{}: is of another version of this program: found \"lucerna\": \"{}\", wanted "
               "\"{}\"; bake the scene again",
               name, *found, kFormat);
}

// Of what is said, however it is spaced; a manifest without one is anybody's own.
Status checkHash(Json document, const std::string& name) {
  if (!document.contains("hash")) return {};
  const Json& hash = document["hash"];
  const std::string wanted = hash.is_string() ? hash.get<std::string>() : "none";
  document.erase("hash");
  const std::string found = hashOf(document);
  if (found == wanted) return {};
  return error(ErrorKind::Input,
               "{}: is damaged or was changed: its hash is {}, wanted {}; bake the scene again",
               name, found, wanted);
}

}  // namespace

std::string hashText16(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

std::vector<FileEntry> filesOf(const Manifest& manifest) {
  std::vector<FileEntry> files{manifest.layout};
  for (const MapEntry& map : manifest.maps) {
    files.push_back(map.master);
    files.insert(files.end(), map.encoded.begin(), map.encoded.end());
  }
  for (const PatchEntry& patch : manifest.patches) files.push_back(patch.patch);
  files.insert(files.end(), manifest.gltf.begin(), manifest.gltf.end());
  return files;
}

std::string toJson(const Manifest& m) {
  Json document{{"lucerna", kFormat},
                {"scene", {{"name", m.scene}, {"hash", m.sceneHash}}},
                {"settings", m.settings.empty() ? Json::object() : Json::parse(m.settings)}};
  addText(document["scene"], "geometry", m.geometryHash);
  addText(document, "processor", m.processor);
  document["side"] = m.side;
  document["density"] = m.density;
  document["layout"] = json(m.layout);
  document["maps"] = list(m.maps);
  document["patches"] = list(m.patches);
  document["objects"] = list(m.objects);
  document["lights"] = list(m.lights);
  document["gltf"] = list(m.gltf);
  document["hash"] = hashOf(document);
  return textOf(document);
}

Result<Manifest> manifestFrom(std::string_view text, const std::string& name) {
  LUCERNA_TRY(document, parsed(text, name));
  const JsonValue root = document.root();
  // As a whole, too; one that JsonDocument takes is an object here.
  const Json whole = Json::parse(text, nullptr, false, true);
  LUCERNA_TRY_VOID(checkHash(whole, name));
  Manifest m;
  if (!root.object({"lucerna", "scene", "settings", "processor", "side", "density", "layout",
                    "maps", "patches", "objects", "lights", "gltf", "hash"}))
    return document.status().error();
  root.require({"scene", "side", "layout", "maps"});
  if (root.has("scene") && root.at("scene").object({"name", "hash", "geometry"})) {
    root.at("scene").read("name", m.scene);
    root.at("scene").read("hash", m.sceneHash);
    root.at("scene").read("geometry", m.geometryHash);
  }
  root.read("processor", m.processor);
  root.readInteger("side", m.side, 1, 32768);
  root.read("density", m.density, {0.f, 1e6f, "texels/m"});
  if (root.has("layout")) readEntry(root.at("layout"), m.layout);
  readList(root, "maps", m.maps);
  readList(root, "patches", m.patches);
  readList(root, "objects", m.objects);
  readList(root, "lights", m.lights);
  readList(root, "gltf", m.gltf);
  if (whole.contains("settings"))
    m.settings = whole["settings"].dump(1, ' ', false, Json::error_handler_t::replace);
  LUCERNA_TRY_VOID(document.status());
  return m;
}

}  // namespace lucerna::lightmap
