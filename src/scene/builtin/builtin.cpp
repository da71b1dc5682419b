#include "scene/builtin/builtin.hpp"

#include <functional>
#include <vector>

#include "core/text.hpp"
#include "scene/builtin/atrium.hpp"
#include "scene/builtin/cornell.hpp"
#include "scene/builtin/materials.hpp"
#include "scene/builtin/mirrors.hpp"
#include "scene/builtin/nightcity.hpp"
#include "scene/builtin/options.hpp"
#include "scene/builtin/penumbra.hpp"

namespace lucerna::scene {
namespace {

Result<Scene> readAtrium(builtin::OptionReader& reader) {
  builtin::AtriumOptions options;
  int kind = 0;
  const std::vector<std::string> kinds{"spot", "point"};
  reader.integer("lights", options.lights, 0, 4096);
  reader.choice("kind", kind, kinds);
  reader.number("reach", options.reach, 0.1f, 100);
  reader.number("moving", options.moving, 0, 1);
  reader.flag("glass", options.glass);
  reader.integer("seed", options.seed, 0, ~0u);
  LUCERNA_TRY_VOID(reader.finish());
  options.kind = kind == 0 ? LightKind::Spot : LightKind::Point;
  return builtin::makeAtrium(options);
}

Result<Scene> readNightCity(builtin::OptionReader& reader) {
  builtin::NightCityOptions options;
  reader.integer("blocks", options.blocks, 6, 64);
  reader.number("rotate", options.rotate, -360, 360);
  reader.number("jitter", options.jitter, 0, 1);
  reader.pair("sun", options.sun, vec2(0, -360), vec2(90, 360));
  reader.flag("lamps", options.lamps);
  reader.integer("seed", options.seed, 0, ~0u);
  LUCERNA_TRY_VOID(reader.finish());
  return builtin::makeNightCity(options);
}

Result<Scene> readMaterialsScene(builtin::OptionReader& reader) {
  LUCERNA_TRY_VOID(reader.finish());
  return builtin::makeMaterials();
}

Result<Scene> readCornell(builtin::OptionReader& reader) {
  builtin::CornellOptions options;
  reader.flag("boxes", options.boxes);
  reader.number("ambient", options.ambient, 0, 1);
  LUCERNA_TRY_VOID(reader.finish());
  return builtin::makeCornell(options);
}

Result<Scene> readMirrors(builtin::OptionReader& reader) {
  builtin::MirrorsOptions options;
  reader.flag("twin", options.twin);
  reader.flag("single", options.single);
  LUCERNA_TRY_VOID(reader.finish());
  return builtin::makeMirrors(options);
}

Result<Scene> readPenumbra(builtin::OptionReader& reader) {
  builtin::PenumbraOptions options;
  int which = 0;
  const std::vector<std::string> cases{"half-plane", "cards", "fence",  "pole",
                                       "grazing",    "panes", "overlap"};
  reader.choice("case", which, cases);
  options.which = static_cast<builtin::PenumbraOptions::Case>(which);
  // Only the case that has them knows their number.
  if (options.which == builtin::PenumbraOptions::Case::Overlap)
    reader.integer("k", options.lights, 1, 32);
  LUCERNA_TRY_VOID(reader.finish());
  return builtin::makePenumbra(options);
}

struct Builtin {
  std::string name;
  Result<Scene> (*read)(builtin::OptionReader& reader);
};

const std::vector<Builtin>& builtins() {
  static const std::vector<Builtin> all{
      {"atrium", readAtrium},   {"cornell", readCornell},     {"materials", readMaterialsScene},
      {"mirrors", readMirrors}, {"nightcity", readNightCity}, {"penumbra", readPenumbra}};
  return all;
}

}  // namespace

std::vector<std::string> builtinNames() {
  std::vector<std::string> names;
  for (const Builtin& entry : builtins()) names.push_back(entry.name);
  return names;
}

Result<Scene> makeBuiltin(const std::string& spec) {
  constexpr std::string_view kPrefix = "builtin:";
  const std::string rest = spec.starts_with(kPrefix) ? spec.substr(kPrefix.size()) : spec;
  const std::string full = std::string(kPrefix) + rest;
  const std::size_t question = rest.find('?');
  const std::string name = rest.substr(0, question);
  const std::string query = question == std::string::npos ? "" : rest.substr(question + 1);

  for (const Builtin& entry : builtins()) {
    if (entry.name != name) continue;
    builtin::OptionReader reader(full, query);
    LUCERNA_TRY(scene, entry.read(reader));
    scene.name = full;
    updateTransforms(scene);
    return scene;
  }
  const std::vector<std::string> names = builtinNames();
  return error(ErrorKind::Input, "{}: no built-in scene is called '{}'{}; there are {}", full, name,
               didYouMean(name, names), join(names));
}

}  // namespace lucerna::scene
