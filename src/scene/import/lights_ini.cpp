#include "scene/import/lights_ini.hpp"

#include <algorithm>
#include <charconv>
#include <span>

#include "core/file.hpp"
#include "core/text.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxBytes = 1 << 20;
constexpr std::string_view kBlank = " \t\r\f\v";

enum class KeyKind { Number, Whole, Flag, Ignored };

struct Key {
  const char* name;
  KeyKind kind = KeyKind::Number;
  float min = 0.f, max = 1e6f;
};

constexpr Key kConfigKeys[] = {
    {"area_light_cutoff", KeyKind::Number, 1e-3f, 90.f},
    {"area_light_att", KeyKind::Number, 1e-6f},
    {"area_light_intensity"},
    {"interpolation_tolerance", KeyKind::Number, 0.f, 255.f},
    {"lightmap_size", KeyKind::Whole, 16.f, 16384.f},
    {"render_area_lights", KeyKind::Flag, 0.f, 1.f},
    {"render_dynamic_lights", KeyKind::Flag, 0.f, 1.f},
    {"render_lightmap", KeyKind::Flag, 0.f, 1.f},
    {"render_scene", KeyKind::Ignored},
};
constexpr Key kLightKeys[] = {
    {"shader", KeyKind::Ignored},
    {"blink", KeyKind::Flag, 0.f, 1.f},
    {"R"},
    {"G"},
    {"B"},
    {"cut", KeyKind::Number, -360.f, 90.f},
    {"near", KeyKind::Ignored},
    {"spot", KeyKind::Number, 0.f, 1000.f},
    {"att0"},
    {"att1"},
    {"att2"},
};

// The thesis stores an eighth of the light in maps of 8 bits (5.1.3): one step there, as brightness
// of a white surface.
constexpr float kMapStep = 8.f / 255.f;
constexpr int kThesisMapSize = 2048;

using Values = std::map<std::string, float, std::less<>>;

float valueOr(const Values& values, std::string_view key, float otherwise) {
  const auto found = values.find(key);
  return found == values.end() ? otherwise : found->second;
}

std::string wantedBy(const Key& key) {
  if (key.kind == KeyKind::Flag) return "0 or 1";
  return fmt::format("a {}number from {:g} to {:g}", key.kind == KeyKind::Whole ? "whole " : "",
                     key.min, key.max);
}

bool readNumber(std::string_view text, const Key& key, float& value) {
  float number = 0.f;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size()) return false;
  if (!(number >= key.min && number <= key.max)) return false;
  if (key.kind != KeyKind::Number && number != std::floor(number)) return false;
  value = number;
  return true;
}

// The number n of "LIGHTn", of up to six digits.
std::optional<std::uint32_t> lightNumber(std::string_view word) {
  constexpr std::string_view kLight = "LIGHT";
  if (!word.starts_with(kLight)) return std::nullopt;
  word.remove_prefix(kLight.size());
  std::uint32_t number = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (word.empty() || word.size() > 6 || code != std::errc() || end != word.data() + word.size())
    return std::nullopt;
  return number;
}

class Parser {
 public:
  explicit Parser(LightsIni& ini) : ini_(ini) {}

  void run(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      readLine(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!section_.empty()) endMissing("the file ends");
    if (!configSeen_ && ini_.groups.empty())
      ini_.warnings.push_back(
          fmt::format("{}: holds neither a section CONFIG nor LIGHT0; wanted system B's light "
                      "configuration (docs/user/lights-ini.md)",
                      ini_.file));
  }

 private:
  template <typename... Args>
  void warn(int line, fmt::format_string<Args...> format, Args&&... args) {
    ini_.warnings.push_back(fmt::format("{}:{}: ", ini_.file, line) +
                            fmt::format(format, std::forward<Args>(args)...));
  }

  void readLine(std::string_view line) {
    line = line.substr(0, line.find("//"));
    std::vector<std::string_view> words;
    for (std::size_t at = 0; (at = line.find_first_not_of(kBlank, at)) != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = end;
    }
    if (words.empty()) return;
    const bool opens = words.size() == 1 && (words[0] == "CONFIG" || lightNumber(words[0]));
    if (opens || section_.empty())
      open(words[0], opens);
    else if (words.size() == 1 && words[0] == "END")
      close();
    else if (!passedOver_)
      readKey(words);
  }

  void open(std::string_view word, bool known) {
    if (!section_.empty()) endMissing(fmt::format("{} begins", word));
    if (!known)
      warn(line_, "found '{}', wanted a section, CONFIG or LIGHT and a number as in LIGHT0", word);
    section_ = word;
    opened_ = line_;
    passedOver_ = !known;
    const auto number = lightNumber(word);
    const int earlier = number && ini_.groups.contains(*number) ? ini_.groups[*number].line
                        : !number && known                      ? configSeen_
                                                                : 0;
    if (earlier == 0) return;
    warn(line_, "{} stands twice, in line {} and here; the first counts; remove one", word,
         earlier);
    passedOver_ = true;
  }

  void readKey(const std::vector<std::string_view>& words) {
    const std::span<const Key> keys =
        section_ == "CONFIG" ? std::span<const Key>(kConfigKeys) : std::span<const Key>(kLightKeys);
    const std::string name(words[0]);
    const auto key =
        std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return name == k.name; });
    if (key == keys.end()) {
      const std::vector<std::string> names = namesOf(keys);
      return warn(line_, "found the unknown key '{}'{}; wanted one of {}", name,
                  didYouMean(name, names), join(names));
    }
    if (key->kind == KeyKind::Ignored) return;
    float value = 0.f;
    if (words.size() != 2 || !readNumber(words[1], *key, value))
      return warn(line_, "found '{}', wanted {} and {}; the line is passed over",
                  fmt::join(words, " "), name, wantedBy(*key));
    if (!values_.emplace(name, value).second)
      warn(line_, "{} stands twice in {}; the first counts; remove one", name, section_);
  }

  static std::vector<std::string> namesOf(std::span<const Key> keys) {
    std::vector<std::string> names;
    for (const Key& key : keys) names.emplace_back(key.name);
    return names;
  }

  void endMissing(std::string_view what) {
    if (!passedOver_)
      warn(line_, "{} before the END of {}, which line {} opens; add it", what, section_, opened_);
    close();
  }

  void close() {
    if (!passedOver_ && section_ == "CONFIG")
      takeConfig();
    else if (!passedOver_)
      takeLight(*lightNumber(section_));
    section_.clear();
    values_.clear();
  }

  void takeConfig() {
    configSeen_ = opened_;
    BakeHints& bake = ini_.bake;
    AreaLightRule& area = *bake.area;
    area.cut = glm::radians(valueOr(values_, "area_light_cutoff", glm::degrees(area.cut)));
    area.attenuation = valueOr(values_, "area_light_att", area.attenuation);
    area.intensity = valueOr(values_, "area_light_intensity", area.intensity);
    if (values_.contains("interpolation_tolerance"))
      bake.patchTolerance = kMapStep * values_["interpolation_tolerance"];
    bake.mapSize = static_cast<int>(valueOr(values_, "lightmap_size", kThesisMapSize));
    bake.areaLights = valueOr(values_, "render_area_lights", 1.f) > 0.f;
    bake.patches = valueOr(values_, "render_dynamic_lights", 1.f) > 0.f;
    bake.maps = valueOr(values_, "render_lightmap", 1.f) > 0.f;
  }

  void takeLight(std::uint32_t number) {
    LightGroupIni group;
    group.line = opened_;
    group.blink = valueOr(values_, "blink", 0.f) > 0.f;
    group.color = {valueOr(values_, "R", 1.f), valueOr(values_, "G", 1.f),
                   valueOr(values_, "B", 1.f)};
    group.cut = valueOr(values_, "cut", group.cut);
    group.spot = valueOr(values_, "spot", 0.f);
    const vec3 attenuation(valueOr(values_, "att0", 0.f), valueOr(values_, "att1", 0.f),
                           valueOr(values_, "att2", 0.f));
    if (attenuation != vec3(0.f))
      group.attenuation = attenuation;
    else if (values_.contains("att0") || values_.contains("att1") || values_.contains("att2"))
      warn(opened_, "{} has no attenuation above 0; 0 0 1 is taken for att0, att1, att2", section_);
    ini_.groups.emplace(number, group);
  }

  LightsIni& ini_;
  int line_ = 0;
  std::string section_;  // empty: between sections
  int opened_ = 0;       // line of its header
  bool passedOver_ = false;
  Values values_;
  int configSeen_ = 0;  // the line; 0: not yet
};

}  // namespace

LightsIni parseLightsIni(std::string_view text, const std::string& name) {
  LightsIni ini;
  ini.file = name;
  ini.bake.area.emplace();
  ini.bake.mapSize = kThesisMapSize;
  Parser(ini).run(text);
  return ini;
}

Result<std::optional<LightsIni>> readLightsIni(const fs::path& scene) {
  fs::path path = scene;
  path.replace_extension(".lights.ini");
  std::error_code code;
  if (!fs::exists(path, code)) path = scene.parent_path() / "lights.ini";
  if (!fs::exists(path, code)) return std::optional<LightsIni>();
  LUCERNA_TRY(text, readText(path, kMaxBytes));
  const auto bad = std::find_if(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\n' && kBlank.find(c) == kBlank.npos;
  });
  if (bad != text.end())
    return error(ErrorKind::Input,
                 "{}:{}: found the byte {:#04x}, wanted text: system B's light configuration "
                 "(docs/user/lights-ini.md); write it anew, or rename the file",
                 path.string(), 1 + std::count(text.begin(), bad, '\n'),
                 static_cast<unsigned>(static_cast<unsigned char>(*bad)));
  return std::optional(parseLightsIni(text, path.filename().string()));
}

}  // namespace lucerna::scene
