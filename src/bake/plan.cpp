#include "bake/plan.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bake/cancelled.hpp"
#include "bake/plan_hash.hpp"
#include "bake/triangle.hpp"
#include "core/progress.hpp"
#include "core/text.hpp"

namespace lucerna::bake {
namespace {

constexpr std::uint32_t kUnitTexels = 8192;  // a slow engine is done with so many in seconds

std::vector<Unit> shareOut(std::span<const Block> blocks) {
  std::vector<Unit> units;
  for (std::uint32_t i = 0; i < blocks.size(); ++i) {
    const auto texels = static_cast<std::uint32_t>(blocks[i].size.x * blocks[i].size.y);
    if (units.empty() || units.back().texels + texels > kUnitTexels)
      units.push_back({.firstBlock = i, .blocks = 0, .texels = 0});
    ++units.back().blocks;
    units.back().texels += texels;
  }
  return units;
}

Charts chartsOf(const World& world, const BakeSettings& settings) {
  return makeCharts(world, {.unwrap = settings.unwrap,
                            .density = settings.density,
                            .gap = settings.pack.gap,
                            .mostSide = settings.pack.side});
}

Result<PackedCharts> packed(const Charts& charts, const BakeSettings& settings) {
  std::vector<std::span<const FlatTriangle>> shapes;
  for (const Chart& chart : charts.charts) shapes.emplace_back(chart.corners);
  return packCharts(shapes, settings.pack);
}

// m^2 of the surfaces that the charts hold.
double areaOf(const Charts& charts) {
  double area = 0.;
  for (const Chart& chart : charts.charts) {
    double twice = 0.;  // texels
    for (const auto& [a, b, c] : chart.corners)
      twice += std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    area += twice / (2. * chart.density * chart.density);
  }
  return area;
}

// No larger, and of two digits, so that what is printed is what was tried.
float twoDigits(double density) {
  const double unit = std::pow(10., std::floor(std::log10(density)) - 1.);
  return static_cast<float>(std::floor(density / unit * (1. + 1e-6)) * unit);
}

// A density below the settings' whose maps are not too many, found by trying, from the one that
// would fill all maps. 0 if there is none that --density takes, or the user pressed Ctrl-C.
float densityThatFits(const World& world, const Charts& charts, BakeSettings settings) {
  constexpr float kLeast = 1e-3f;
  constexpr int kMostTries = 24, kFineTries = 12;
  constexpr double kFine = 0.95, kCoarse = 0.5;
  const double room =
      static_cast<double>(settings.pack.mostMaps) * settings.pack.side * settings.pack.side;
  double density = std::min<double>(settings.density, std::sqrt(room / areaOf(charts)));
  Progress progress("looking for a density that fits", kMostTries);
  for (int i = 0; i < kMostTries && !Progress::cancelled(); ++i) {
    settings.density = twoDigits(density);
    if (settings.density < kLeast) break;
    if (packed(chartsOf(world, settings), settings)) return settings.density;
    density = settings.density * (i < kFineTries ? kFine : kCoarse);
    progress.advance();
  }
  return 0.f;
}

// What packing said, and what to do.
Error tooMany(const Error& fault, float fits) {
  const std::string less = fits == 0.f ? "" : fmt::format("--density {:g}, which fits, or ", fits);
  return error(fault.kind, "{}; wanted {}larger maps (--size) or more of them (--most-maps)",
               fault.message, less);
}

// Lists in one order and without what is said twice, as their order changes nothing.
BakeSettings inOrder(BakeSettings settings) {
  const auto sort = [](auto& list) {
    std::ranges::sort(list);
    const auto again = std::ranges::unique(list);
    list.erase(again.begin(), again.end());
  };
  sort(settings.groups);
  sort(settings.encodings);
  return settings;
}

// Leaves the groups that are asked for; what is always on is one of the name "always-on".
Status choose(Plan& plan) {
  std::vector<LightGroup>& groups = plan.groups;
  const std::vector<std::string>& wanted = plan.settings.groups;
  if (wanted.empty()) return {};
  std::vector<std::string> names;
  for (const LightGroup& group : groups)
    names.push_back(group.name.empty() ? kAlwaysOn : group.name);
  for (const std::string& name : wanted)
    if (std::ranges::find(names, name) == names.end())
      return error(ErrorKind::Usage,
                   "--lights: the scene has no light group '{}'{}; wanted all or some of {}", name,
                   didYouMean(name, names), fmt::join(names, ", "));
  for (std::size_t i = groups.size(); i-- > 0;) {
    if (std::ranges::find(wanted, names[i]) != wanted.end()) continue;
    if (i == 0) {
      groups[i].lights.clear();
      plan.alwaysOn = false;
    } else
      groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return {};
}

bool anyEmits(const World& world) {
  return std::ranges::any_of(world.objects, [&](const WorldObject& object) {
    const scene::Object& drawn = world.scene->objects[object.object];
    return object.receives && world.scene->materials[drawn.material].emissive != vec3(0.f);
  });
}

// Triangles with a corner that is no number, those that are too large among them.
std::size_t notFinite(const World& world) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < world.indices.size(); i += 3)
    if (!isFinite(world.positions[world.indices[i]]) ||
        !isFinite(world.positions[world.indices[i + 1]]) ||
        !isFinite(world.positions[world.indices[i + 2]]))
      ++count;
  return count;
}

void addWarnings(Plan& plan) {
  const Charts& charts = plan.charts;
  if (plan.world.huge > 0)
    plan.warnings.push_back(
        fmt::format("{} triangles are too large, with corners farther than {:.0f} km off: they are "
                    "left out and throw no shadow",
                    plan.world.huge, kFarthestCorner / 1000.f));
  if (const std::size_t count = notFinite(plan.world); count > plan.world.huge)
    plan.warnings.push_back(
        fmt::format("{} triangles have corners that are no numbers: they are left out",
                    count - plan.world.huge));
  if (charts.degenerate > 0)
    plan.warnings.push_back(
        fmt::format("{} triangles have no area and get no light", charts.degenerate));
  constexpr std::size_t kMostNamed = 5;
  for (std::size_t i = 0; i < std::min(charts.unsound.size(), kMostNamed); ++i)
    plan.warnings.push_back(charts.unsound[i]);
  if (charts.unsound.size() > kMostNamed)
    plan.warnings.push_back(fmt::format("TEXCOORD_1 of {} more objects is not used",
                                        charts.unsound.size() - kMostNamed));
  if (charts.shrunk > 0)
    plan.warnings.push_back(fmt::format(
        "{} charts are larger than a map and have fewer texels a metre; larger maps (--size) or "
        "a lower --density would hold them",
        charts.shrunk));
  constexpr double kFew = 4.;  // texels
  const double each =
      static_cast<double>(plan.texels()) / static_cast<double>(charts.charts.size());
  if (each < kFew) {
    Aabb bounds;
    for (const scene::Object& object : plan.world.scene->objects) bounds.grow(object.boundsW);
    plan.warnings.push_back(
        fmt::format("charts have {:.1f} texels on average, in a scene of {:.3g} m: {:.3g} texels a "
                    "metre are few for it; wanted a higher --density",
                    each, bounds.diagonal(), plan.settings.density));
  }
  const bool dark =
      !(plan.emittersShine() && anyEmits(plan.world)) &&
      std::ranges::all_of(plan.groups, [](const LightGroup& g) { return g.lights.empty(); });
  if (dark)
    plan.warnings.push_back(
        "the scene has no lights to bake: the maps will be black; --sky 1 would give it the light "
        "of an even sky");
}

}  // namespace

std::uint64_t Plan::texels() const {
  std::uint64_t sum = 0;
  for (const Unit& unit : units) sum += unit.texels;
  return sum;
}

std::uint64_t Plan::coveredTexels() const {
  std::uint64_t sum = 0;
  for (const TexelMask& mask : packed.masks) sum += static_cast<std::uint64_t>(mask.count());
  return sum;
}

Result<Plan> makePlan(const scene::Scene& scene, const BakeSettings& settings) {
  Plan plan;
  plan.settings = inOrder(settings);
  plan.world = makeWorld(scene);
  plan.charts = chartsOf(plan.world, settings);
  LUCERNA_TRY_VOID(checkGoesOn());
  if (plan.charts.charts.empty())
    return error(ErrorKind::Input,
                 "'{}': found no triangle that takes light; wanted a scene with surfaces",
                 scene.name);
  auto places = packed(plan.charts, settings);
  if (!places) {
    LUCERNA_TRY_VOID(checkGoesOn());
    const float fits = densityThatFits(plan.world, plan.charts, settings);
    LUCERNA_TRY_VOID(checkGoesOn());
    return tooMany(places.error(), fits);
  }
  plan.packed = std::move(*places);
  for (std::uint32_t i = 0; i < plan.charts.charts.size(); ++i)
    addBlocks(plan.blocks, plan.charts.charts[i], i);
  plan.units = shareOut(plan.blocks);
  plan.groups = groupLights(scene, settings.reach);
  LUCERNA_TRY_VOID(choose(plan));
  if (!plan.alwaysOn && settings.sky != vec3(0.f))
    plan.warnings.emplace_back("--sky is always on: it is baked if --lights names always-on");
  if (plan.alwaysOn)
    std::ranges::copy(skyLights(settings.sky, settings.sampling.skyDirections),
                      std::back_inserter(plan.groups[0].lights));
  plan.hash = hashOf(plan);
  addWarnings(plan);
  return plan;
}

ivec2 placed(const Plan& plan, std::uint32_t chart, ivec2 texel) {
  return ivec2(glm::floor(placed(plan, chart, vec2(texel) + 0.5f)));
}

vec2 placed(const Plan& plan, std::uint32_t chart, vec2 point) {
  const PackedCharts& packed = plan.packed;
  return placedPoint(packed.packing.places[chart], packed.masks[chart].size(),
                     point - packed.least[chart]);
}

float irradianceOfWhite(const scene::Scene& scene) {
  return kPi * std::exp2(-scene.exposure);
}

std::size_t lightCount(const Plan& plan) {
  std::size_t count = 0;
  for (const LightGroup& group : plan.groups)
    count += static_cast<std::size_t>(std::ranges::count_if(
        group.lights, [](const scene::PlacedLight& light) { return light.light != scene::kNone; }));
  return count;
}

lightmap::Layout layoutOf(const Plan& plan) {
  lightmap::Layout layout{.side = plan.settings.pack.side,
                          .maps = plan.packed.packing.maps,
                          .charts = static_cast<int>(plan.charts.charts.size()),
                          .objects = {}};
  layout.objects.resize(plan.world.scene->objects.size());
  for (const WorldObject& object : plan.world.objects)
    layout.objects[object.object].resize(object.triangleCount);
  for (std::uint32_t i = 0; i < plan.charts.charts.size(); ++i) {
    const Chart& chart = plan.charts.charts[i];
    auto& triangles = layout.objects[plan.world.objects[chart.object].object];
    for (std::size_t k = 0; k < chart.triangles.size(); ++k) {
      lightmap::TrianglePlace& place = triangles[chart.triangles[k]];
      place.map = plan.packed.packing.places[i].map;
      place.chart = i;
      const auto most = static_cast<float>(plan.settings.pack.side);
      for (std::size_t c = 0; c < 3; ++c)
        place.corners[c] = glm::clamp(placed(plan, i, chart.corners[k][c]), 0.f, most);
    }
  }
  return layout;
}

}  // namespace lucerna::bake
