#include "bake/seams.hpp"

#include <algorithm>
#include <cmath>

#include "bake/encoded_texels.hpp"
#include "bake/seconds.hpp"
#include "bake/solve_seams.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace lucerna::bake {
namespace {

using glm::dvec3;

// Brightness that a group gives a texel where it gave none before: less is left out.
constexpr double kLeastAdded = 1e-4;

using lightmap::HalfTiles;
using lightmap::kTileTexels;

vec3 irradianceAt(const std::uint16_t* red, std::size_t step) {
  return {floatFromHalf(red[0]), floatFromHalf(red[step]), floatFromHalf(red[2 * step])};
}

void write(std::array<std::uint16_t, 3> rgb, std::uint16_t* red, std::size_t step) {
  for (std::size_t c = 0; c < 3; ++c) red[c * step] = rgb[c];
}

// An unknown that a group lights: its red, kTileTexels before its green.
struct LitUnknown {
  std::uint32_t unknown;
  std::uint16_t* red;
};

// In the order of the unknowns.
std::vector<LitUnknown> litUnknowns(const SeamSystem& system, HalfTiles& group) {
  std::vector<LitUnknown> found;
  for (std::size_t slot = 0; slot < group.tiles().size(); ++slot)
    group.forTexelsOf(slot, [&](std::uint16_t map, int x, int y, std::uint16_t* red) {
      const std::uint32_t unknown = system.unknownAt(
          {.map = map, .x = static_cast<std::uint16_t>(x), .y = static_cast<std::uint16_t>(y)});
      if (unknown != SeamSystem::kNone) found.push_back({unknown, red});
    });
  std::ranges::sort(found, {}, &LitUnknown::unknown);
  return found;
}

void addTo(std::vector<vec3>& sum, const SeamSystem& system, HalfTiles& group,
           const Brightness& brightness) {
  for (const LitUnknown& lit : litUnknowns(system, group))
    sum[lit.unknown] += vec3(brightness.of(irradianceAt(lit.red, kTileTexels)));
}

// The largest channel's, as shown.
float stepAt(const SeamSample& sample, std::span<const vec3> values) {
  std::array<vec3, 2> sides{vec3(0.f), vec3(0.f)};
  for (std::size_t k = 0; k < 8; ++k)
    sides[k / 4] += std::abs(sample.weights[k]) * values[sample.texels[k]];
  const vec3 step = glm::abs(glm::clamp(sides[0], 0.f, 1.f) - glm::clamp(sides[1], 0.f, 1.f));
  return std::max({step.x, step.y, step.z});
}

SeamSteps stepsOf(const SeamSystem& system, std::span<const vec3> values) {
  struct Step {
    float size, share;
  };
  std::vector<Step> steps;
  steps.reserve(system.between().size());
  double all = 0.;
  for (const SeamPoint& point : system.between()) {
    steps.push_back({stepAt(system.sampleAt(point), values), point.share});
    all += point.share;
  }
  std::ranges::sort(steps, {}, &Step::size);
  SeamSteps found;
  double sum = 0.;
  for (const Step& step : steps) {
    if (sum <= 0.5 * all) found.median = step.size;
    if (sum <= 0.99 * all) found.percentile99 = step.size;
    found.largest = step.size;
    sum += step.share;
  }
  return found;
}

std::uint64_t solveChannel(const SeamSystem& system, const SeamPart& part, int c,
                           std::span<dvec3> values) {
  std::vector<double> channel;
  channel.reserve(values.size());
  for (const dvec3& value : values) channel.push_back(value[c]);
  const std::uint64_t iterations = solve(system, part, channel);
  for (std::size_t i = 0; i < values.size(); ++i) values[i][c] = channel[i];
  return iterations;
}

// Returns the most iterations of a part.
std::uint64_t solveMaps(const SeamSystem& system, std::vector<Image>& maps,
                        const Brightness& brightness) {
  const auto red = [&](TexelPlace p) { return maps[p.map].pixel<std::uint16_t>(p.x, p.y); };
  const std::span<const SeamPart> parts = system.parts();
  std::vector<dvec3> values;
  values.reserve(system.places().size());
  for (const TexelPlace& place : system.places())
    values.push_back(brightness.of(irradianceAt(red(place), 1)));
  std::vector<std::uint64_t> iterations(3 * parts.size());
  Progress progress("closing seams", iterations.size());
  constexpr std::size_t kGrain = 3;
  parallelFor(iterations.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      const SeamPart& part = parts[i % parts.size()];
      iterations[i] = solveChannel(system, part, static_cast<int>(i / parts.size()),
                                   std::span(values).subspan(part.firstTexel, part.texels));
      progress.advance();
    }
  });
  for (std::size_t i = 0; i < values.size(); ++i)
    write(brightness.halves(values[i]), red(system.places()[i]), 1);
  return iterations.empty() ? 0 : std::ranges::max(iterations);
}

// Solves a part that the group lights; `lit` are its texels there. Texels that it lights now go to
// `added`, with their brightness.
void solvePart(const SeamSystem& system, const SeamPart& part, std::span<const LitUnknown> lit,
               const Brightness& brightness, std::vector<std::pair<TexelPlace, dvec3>>& added) {
  std::vector<dvec3> values(part.texels, dvec3(0.));
  for (const LitUnknown& texel : lit)
    values[texel.unknown - part.firstTexel] = brightness.of(irradianceAt(texel.red, kTileTexels));
  for (int c = 0; c < 3; ++c) solveChannel(system, part, c, values);
  for (const LitUnknown& texel : lit) {
    dvec3& value = values[texel.unknown - part.firstTexel];
    write(brightness.halves(value), texel.red, kTileTexels);
    value = dvec3(0.);  // is written
  }
  for (std::uint32_t i = 0; i < part.texels; ++i)
    if (std::max({values[i].x, values[i].y, values[i].z}) >= kLeastAdded)
      added.emplace_back(system.places()[part.firstTexel + i], values[i]);
}

// Solves the parts that the group lights.
void solveGroup(const SeamSystem& system, HalfTiles& group, const Brightness& brightness) {
  const std::vector<LitUnknown> lit = litUnknowns(system, group);
  std::vector<std::pair<TexelPlace, dvec3>> added;
  for (std::size_t at = 0; at < lit.size() && !Progress::cancelled();) {
    const SeamPart& part = system.parts()[system.partOf(lit[at].unknown)];
    const std::size_t first = at;
    while (at < lit.size() && lit[at].unknown < part.firstTexel + part.texels) ++at;
    solvePart(system, part, std::span(lit).subspan(first, at - first), brightness, added);
  }
  for (const auto& [place, value] : added)
    write(brightness.halves(value), group.add(place.map, place.x, place.y), kTileTexels);
}

std::vector<vec3> shownBy(const Brightness& brightness, const std::vector<vec3>& irradiance) {
  std::vector<vec3> shown;
  shown.reserve(irradiance.size());
  for (const vec3& e : irradiance) shown.emplace_back(brightness.of(e));
  return shown;
}

std::vector<vec3> sumOf(const std::vector<vec3>& a, const std::vector<vec3>& b) {
  std::vector<vec3> sum = a;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += b[i];
  return sum;
}

}  // namespace

std::array<std::uint16_t, 3> Brightness::halves(dvec3 brightness) const {
  const vec3 e(glm::min(brightness * white_, double{kLargestHalf}));
  return {halfFromFloat(e.x), halfFromFloat(e.y), halfFromFloat(e.z)};
}

Seams::Seams(const Plan& plan, const MapTexels& texels)
    : plan_(plan), brightness_(*plan.world.scene) {
  const auto start = Clock::now();
  std::vector<Seam> seams = findSeams(plan);
  if (seams.empty() || Progress::cancelled()) return;
  const auto tracer = makeEmbreeTracer(plan.world);
  std::vector<SeamPoint> points = seamPoints(seams, 0, *tracer),
                         between = seamPoints(seams, 1, *tracer);
  system_.emplace(std::move(seams), std::move(points), std::move(between), texels);
  const std::size_t unknowns = system_->places().size();
  report_.seams = system_->seamCount();
  report_.texels = unknowns;
  report_.samples = system_->points().size();
  report_.parts = system_->parts().size();
  for (auto* list : {&before_, &maps_, &groups_}) list->assign(unknowns, vec3(0.f));
  report_.seconds = secondsSince(start);
}

void Seams::close(BakedLight& baked) {
  if (!system_ || Progress::cancelled()) return;
  const auto start = Clock::now();
  if (!baked.maps.empty()) closeMaps(baked);
  closeGroups(baked);
  report_.seconds += secondsSince(start);
}

void Seams::closeMaps(BakedLight& baked) {
  const auto shown = [&](Encoding encoding) {
    return shownBy(brightness_, encodedTexels(baked.maps, system_->places(), encoding));
  };
  before_ = shown(Encoding::Png);  // as they are
  report_.mostIterations = solveMaps(*system_, baked.maps, brightness_);
  maps_ = shown(Encoding::Png);
  for (const Encoding encoding : plan_.settings.encodings)
    if (encoding != Encoding::Png) {
      report_.encoded.push_back({encoding, {}});
      encodedMaps_.push_back(shown(encoding));
    }
}

void Seams::closeGroups(BakedLight& baked) {
  for (HalfTiles& group : baked.groups) addTo(before_, *system_, group, brightness_);
  parallelFor(baked.groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) solveGroup(*system_, baked.groups[i], brightness_);
  });
  for (HalfTiles& group : baked.groups) addTo(groups_, *system_, group, brightness_);
}

SeamReport Seams::report() const {
  SeamReport report = report_;
  if (!system_) return report;
  report.before = stepsOf(*system_, before_);
  report.after = stepsOf(*system_, sumOf(maps_, groups_));
  for (std::size_t i = 0; i < report.encoded.size(); ++i)
    report.encoded[i].after = stepsOf(*system_, sumOf(encodedMaps_[i], groups_));
  return report;
}

SeamReport closeSeams(const Plan& plan, BakedLight& baked) {
  Seams seams(plan, baked.texels);
  seams.close(baked);
  return seams.report();
}

}  // namespace lucerna::bake
