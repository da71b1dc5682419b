#include "bake/bake_order.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bake/shadow_tracer.hpp"
#include "bake/shards.hpp"
#include "core/file.hpp"
#include "core/json_value.hpp"
#include "core/text.hpp"

namespace lucerna::bake {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "bake/1";
constexpr std::initializer_list<const char*> kEncodings{"rgb9e5", "bc6h", "png"};  // as Encoding

// With no more digits than it needs.
Json number(float value) {
  return Json::parse(fmt::format("{}", value));
}

Json settingsJson(const BakeSettings& s) {
  Json json{{"unwrap", s.unwrap == Unwrap::Pairs ? "pairs" : "charts"},
            {"density", number(s.density)},
            {"size", s.pack.side},
            {"padding", s.pack.gap},
            {"mostMaps", s.pack.mostMaps},
            {"positions", s.sampling.positions},
            {"finePositions", s.sampling.finePositions},
            {"lightSamples", s.sampling.lightSamples},
            {"emitterSize", number(s.sampling.emitterSize)},
            {"emitterShare", number(s.sampling.emitterShare)},
            {"faintest", number(s.faintest)},
            {"sky", {number(s.sky.x), number(s.sky.y), number(s.sky.z)}},
            {"skyDirections", s.sampling.skyDirections},
            {"skyPoints", s.sampling.skyPoints},
            {"engine", s.engine == Engine::Octree ? "octree" : "embree"}};
  if (s.patchTolerance) json["patchTolerance"] = number(*s.patchTolerance);
  if (std::isfinite(s.reach)) json["reach"] = number(s.reach);
  if (!s.groups.empty()) json["lights"] = s.groups;
  for (const Encoding encoding : s.encodings)
    json["encode"].push_back(kEncodings.begin()[static_cast<std::size_t>(encoding)]);
  return json;
}

void readSettings(const JsonValue& from, BakeSettings& s) {
  if (!from.object({"unwrap", "density", "size", "padding", "mostMaps", "positions",
                    "finePositions", "lightSamples", "emitterSize", "emitterShare", "faintest",
                    "sky", "skyDirections", "skyPoints", "engine", "patchTolerance", "reach",
                    "lights", "encode"}))
    return;
  from.require({"unwrap", "density", "size", "padding", "mostMaps", "positions", "finePositions",
                "lightSamples", "emitterSize", "emitterShare", "faintest", "sky", "skyDirections",
                "skyPoints", "engine"});
  int choice = 0;
  if (from.readChoice("unwrap", {"charts", "pairs"}, choice))
    s.unwrap = choice == 0 ? Unwrap::Charts : Unwrap::Pairs;
  from.read("density", s.density, {1e-3f, 1e5f, "texels/m"});
  from.readInteger("size", s.pack.side, 16, 16384);
  from.readInteger("padding", s.pack.gap, 1, 64);
  from.readInteger("mostMaps", s.pack.mostMaps, 1, 4096);
  from.readInteger("positions", s.sampling.positions, 1, 64);
  from.readInteger("finePositions", s.sampling.finePositions, 0, 64);
  from.readInteger("lightSamples", s.sampling.lightSamples, 1, 1 << 16);
  from.read("emitterSize", s.sampling.emitterSize, {1e-6f, 1e6f, ""});
  from.read("emitterShare", s.sampling.emitterShare, {1e-6f, 1.f, ""});
  from.read("faintest", s.faintest, kUnitRange);
  if (from.readChoice("engine", {"embree", "octree"}, choice))
    s.engine = choice == 0 ? Engine::Embree : Engine::Octree;
  if (float tolerance = 0.f; from.read("patchTolerance", tolerance, {0.f, 8.f}))
    s.patchTolerance = tolerance;
  from.read("reach", s.reach, {0.01f, 1e6f, "m"});
  from.read("sky", s.sky, {0.f, 1e6f, ""});
  from.readInteger("skyDirections", s.sampling.skyDirections, 2, 1 << 20);
  from.readInteger("skyPoints", s.sampling.skyPoints, 2, 1 << 16);
  if (from.has("lights"))
    for (const JsonValue& group : from.at("lights").elements()) group.text(s.groups.emplace_back());
  if (!from.has("encode")) return;
  const std::vector<std::string> names(kEncodings.begin(), kEncodings.end());
  for (const JsonValue& encoding : from.at("encode").elements())
    if (std::size_t index = 0; encoding.choice(names, index))
      s.encodings.push_back(static_cast<Encoding>(index));
}

std::string textOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Of the settings that a flag sets by itself.
constexpr std::pair<const char*, const char*> kFlags[]{{"density", "--density"},
                                                       {"size", "--size"},
                                                       {"padding", "--padding"},
                                                       {"mostMaps", "--most-maps"},
                                                       {"unwrap", "--unwrap"},
                                                       {"lights", "--lights"},
                                                       {"patchTolerance", "--patch-tolerance"},
                                                       {"reach", "--reach"},
                                                       {"faintest", "--faintest"},
                                                       {"sky", "--sky"},
                                                       {"encode", "--encode"},
                                                       {"engine", "--engine"}};

// A preset's name, or what stands in place of one.
std::string presetOf(const Sampling& s) {
  for (const Preset& preset : kPresets)
    if (s == preset.sampling) return preset.name;
  return fmt::format("none of this version's ({}, {}, {}, {}, {}, {}, {})", s.positions,
                     s.finePositions, s.lightSamples, s.emitterSize, s.emitterShare,
                     s.skyDirections, s.skyPoints);
}

// As the command line takes it.
std::string valueText(const Json& value) {
  if (value.is_string()) return value;
  if (!value.is_array()) return textOf(value);
  std::vector<std::string> list;
  for (const Json& each : value) list.push_back(valueText(each));
  return fmt::format("{}", fmt::join(list, ","));
}

}  // namespace

std::string differences(const BakeSettings& there, const BakeSettings& here) {
  std::vector<std::string> list;
  const auto compare = [&](const char* flag, const std::string& a, const std::string& b) {
    if (a != b) list.push_back(fmt::format("{} is {} there, {} here", flag, a, b));
  };
  compare("--preset", presetOf(there.sampling), presetOf(here.sampling));
  const Json a = settingsJson(there), b = settingsJson(here);
  for (const auto& [key, flag] : kFlags) {
    const char* otherwise = std::string_view(key) == "lights" ? "all" : "none";
    const auto value = [&](const Json& of) {
      return of.contains(key) ? valueText(of[key]) : otherwise;
    };
    compare(flag, value(a), value(b));
  }
  return fmt::format("{}", fmt::join(list, ", "));
}

namespace {

Status checkSame(const BakeOrder& there, const BakeOrder& here, const fs::path& folder) {
  const std::string work = (folder / kWorkFolder).string();
  const std::string found = differences(there.settings, here.settings);
  if (!found.empty())
    return error(
        ErrorKind::Usage,
        "-o: '{}' holds an unfinished bake of other settings: {}; give the same, or remove "
        "'{}' to start anew",
        folder.string(), found, work);
  if (there.processor != here.processor)
    return error(
        ErrorKind::Usage,
        "-o: '{}' holds an unfinished bake of processors with {}, this one has {}: its light "
        "would differ in the last bits; go on where they are the same, or remove '{}' to "
        "start anew",
        folder.string(), there.processor, here.processor, work);
  if (there.plan == here.plan) return {};
  if (there.scene != here.scene)
    return error(ErrorKind::Usage,
                 "-o: '{}' holds an unfinished bake of another scene: '{}' there, '{}' here; give "
                 "the same, or remove '{}' to start anew",
                 folder.string(), there.scene, here.scene, work);
  return error(
      ErrorKind::Usage,
      "-o: '{}' holds an unfinished bake of '{}' as it was before it changed, or of another "
      "version of this program; remove '{}' to start anew",
      folder.string(), there.scene, work);
}

// Whole, so that nobody reads a part of it. Where a file system has no hard links, two that write
// at the same time may both replace it: logs of another plan or processor are refused later.
Status writeUnlessThere(const fs::path& path, std::string_view text) {
  std::error_code failed;
  if (fs::exists(path, failed)) return {};
  LUCERNA_TRY(file, AtomicFile::create(path));
  LUCERNA_TRY_VOID(writeText(file.temporary(), text));
  fs::create_hard_link(file.temporary(), path, failed);
  return failed && failed != std::errc::file_exists ? file.commit() : Status();
}

std::string absoluteScene(const std::string& scene) {
  if (scene.starts_with("builtin:")) return scene;
  std::error_code failed;
  const fs::path path = fs::absolute(scene, failed);
  return failed ? scene : path.lexically_normal().string();
}

}  // namespace

BakeOrder orderOf(const Plan& plan, const std::string& scene) {
  return {.scene = absoluteScene(scene),
          .plan = plan.hash,
          .processor = rayInstructionSet(),
          .settings = plan.settings};
}

std::string settingsText(const BakeSettings& settings) {
  return settingsJson(settings).dump(1, ' ', false, Json::error_handler_t::replace);
}

Result<BakeSettings> settingsFrom(std::string_view text, const std::string& name) {
  LUCERNA_TRY(document, JsonDocument::parse(text, name, ErrorKind::Input));
  BakeSettings settings;
  readSettings(document.root(), settings);
  LUCERNA_TRY_VOID(document.status());
  return settings;
}

std::vector<Encoding> furtherCopies(const std::string& there, const BakeSettings& here) {
  const auto other = settingsFrom(there, "settings");
  if (!other) return {};
  BakeSettings same = *other;
  same.encodings = here.encodings;
  if (settingsText(same) != settingsText(here)) return {};
  std::vector<Encoding> further = other->encodings;
  std::erase_if(further, [&](Encoding copy) {
    return std::ranges::find(here.encodings, copy) != here.encodings.end();
  });
  return further;
}

std::string copiesText(std::span<const Encoding> copies) {
  std::vector<std::string> names;
  for (const Encoding copy : copies)
    names.push_back(kEncodings.begin()[static_cast<std::size_t>(copy)]);
  return join(names);
}

bool lacksCopiesAlone(const std::string& there, const BakeSettings& here) {
  Json less = Json::parse(there, nullptr, false), more = settingsJson(here);
  if (!less.is_object() || !more.contains("encode")) return false;
  const Json had = less.value("encode", Json::array()), wanted = more["encode"];
  less.erase("encode");
  more.erase("encode");
  const auto isWanted = [&](const Json& copy) {
    return std::ranges::find(wanted, copy) != wanted.end();
  };
  return textOf(less) == textOf(more) && had.size() < wanted.size() &&
         std::ranges::all_of(had, isWanted);
}

std::string toJson(const BakeOrder& order) {
  const Json document{{"lucerna", kFormat},
                      {"scene", order.scene},
                      {"plan", fmt::format("{:016x}", order.plan)},
                      {"processor", order.processor},
                      {"settings", settingsJson(order.settings)}};
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<BakeOrder> orderFrom(std::string_view text, const std::string& name) {
  LUCERNA_TRY(document, JsonDocument::parse(text, name, ErrorKind::Input));
  const JsonValue root = document.root();
  BakeOrder order;
  if (!root.object({"lucerna", "scene", "plan", "processor", "settings"}))
    return document.status().error();
  root.format(kFormat);
  root.require({"lucerna", "scene", "plan", "processor", "settings"});
  root.read("scene", order.scene);
  root.read("processor", order.processor);
  std::string plan;
  if (root.read("plan", plan)) {
    const char* end = plan.data() + plan.size();
    const auto [parsed, fault] = std::from_chars(plan.data(), end, order.plan, 16);
    if (plan.size() != 16 || fault != std::errc() || parsed != end)
      root.at("plan").wrong("sixteen hexadecimal digits");
  }
  if (root.has("settings")) readSettings(root.at("settings"), order.settings);
  LUCERNA_TRY_VOID(document.status());
  return order;
}

Result<BakeOrder> readOrder(const fs::path& folder) {
  const fs::path path = orderPath(folder);
  std::error_code none;
  if (!fs::exists(path, none))
    return error(ErrorKind::Input,
                 "'{}' holds no unfinished bake: there is no {}; wanted the folder that `lucerna "
                 "bake --shard` was given",
                 folder.string(), path.lexically_relative(folder).string());
  LUCERNA_TRY(text, readText(path));
  auto order = orderFrom(text, path.string());
  if (!order)
    return error(ErrorKind::Input, "{}; remove '{}' and bake anew", order.error().message,
                 (folder / kWorkFolder).string());
  return order;
}

Status keepOrder(const fs::path& folder, const BakeOrder& order) {
  // Of shards that start together one writes it, and all read what is there then.
  LUCERNA_TRY_VOID(writeUnlessThere(orderPath(folder), toJson(order)));
  LUCERNA_TRY(there, readOrder(folder));
  return checkSame(there, order, folder);
}

}  // namespace lucerna::bake
