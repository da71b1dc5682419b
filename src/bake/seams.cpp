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

// Irradiance and brightness: what a white surface shows at the scene's exposure.
class Light {
 public:
  explicit Light(const scene::Scene& scene) : white_(irradianceOfWhite(scene)) {}

  dvec3 brightness(const std::uint16_t* rgb) const {
    return brightness({floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])});
  }
  dvec3 brightness(vec3 irradiance) const { return dvec3(irradiance) / white_; }
  std::array<std::uint16_t, 3> halves(dvec3 brightness) const {
    const vec3 e(glm::min(brightness * white_, double{kLargestHalf}));
    return {halfFromFloat(e.x), halfFromFloat(e.y), halfFromFloat(e.z)};
  }

 private:
  double white_;
};

std::uint16_t* pixel(BakedLight& baked, TexelPlace p) {
  return baked.maps[p.map].pixel<std::uint16_t>(p.x, p.y);
}

TexelPlace placeOf(const LitTexel& texel) {
  return {.map = texel.map, .x = texel.x, .y = texel.y};
}

// Calls visit(unknown, texel) where a group, which is sorted, lights an unknown.
template <typename Lit, typename Visit>
void forShared(const SeamSystem& system, Lit& lit, Visit visit) {
  std::size_t at = 0;
  for (const std::uint32_t unknown : system.order) {
    const TexelPlace place = system.places[unknown];
    while (at < lit.size() && placeOf(lit[at]) < place) ++at;
    if (at < lit.size() && placeOf(lit[at]) == place) visit(unknown, lit[at]);
  }
}

// What the unknowns show with everything on. encoding: of the maps; PNG: as they are.
std::vector<dvec3> sumOf(const SeamSystem& system, const BakedLight& baked, const Light& light,
                         Encoding encoding = Encoding::Png) {
  std::vector<dvec3> sum;
  for (const vec3& irradiance : encodedTexels(baked.maps, system.places, encoding))
    sum.push_back(light.brightness(irradiance));
  for (const std::vector<LitTexel>& lit : baked.groups)
    forShared(system, lit, [&](std::uint32_t unknown, const LitTexel& texel) {
      sum[unknown] += light.brightness(texel.rgb.data());
    });
  return sum;
}

// The largest channel's, as shown.
double stepAt(const SeamSample& sample, std::span<const dvec3> values) {
  std::array<dvec3, 2> sides{dvec3(0.), dvec3(0.)};
  for (std::size_t k = 0; k < 8; ++k)
    sides[k / 4] += double{std::abs(sample.weights[k])} * values[sample.texels[k]];
  const dvec3 step = glm::abs(glm::clamp(sides[0], 0., 1.) - glm::clamp(sides[1], 0., 1.));
  return std::max({step.x, step.y, step.z});
}

SeamSteps stepsOf(const SeamSystem& system, std::span<const dvec3> values) {
  struct Step {
    double size, share;
  };
  std::vector<Step> steps;
  double all = 0.;
  for (const SeamSample& sample : system.measuring) {
    steps.push_back({stepAt(sample, values), sample.share});
    all += sample.share;
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
std::uint64_t solveMaps(const SeamSystem& system, BakedLight& baked, const Light& light,
                        Progress& progress) {
  std::vector<dvec3> values;
  values.reserve(system.places.size());
  for (const TexelPlace& place : system.places)
    values.push_back(light.brightness(pixel(baked, place)));
  std::vector<std::uint64_t> iterations(3 * system.parts.size());
  constexpr std::size_t kGrain = 3;
  parallelFor(iterations.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i) {
      const SeamPart& part = system.parts[i % system.parts.size()];
      iterations[i] = solveChannel(system, part, static_cast<int>(i / system.parts.size()),
                                   std::span(values).subspan(part.firstTexel, part.texels));
      progress.advance();
    }
  });
  for (std::size_t i = 0; i < values.size(); ++i)
    std::ranges::copy(light.halves(values[i]), pixel(baked, system.places[i]));
  return iterations.empty() ? 0 : std::ranges::max(iterations);
}

// Solves the parts that the group lights.
void solveGroup(const SeamSystem& system, std::vector<LitTexel>& lit, const Light& light) {
  struct Value {
    std::uint32_t unknown = 0;
    LitTexel* texel = nullptr;
  };
  std::vector<Value> given;
  forShared(system, lit,
            [&](std::uint32_t unknown, LitTexel& texel) { given.push_back({unknown, &texel}); });
  std::ranges::sort(given, {}, &Value::unknown);
  std::vector<LitTexel> added;
  std::size_t at = 0;
  std::vector<dvec3> values;
  for (const SeamPart& part : system.parts) {
    if (Progress::cancelled()) return;
    const std::size_t first = at;
    for (; at < given.size() && given[at].unknown < part.firstTexel + part.texels; ++at) continue;
    if (at == first) continue;
    const auto its = std::span(given).subspan(first, at - first);
    values.assign(part.texels, dvec3(0.));
    for (const Value& v : its)
      values[v.unknown - part.firstTexel] = light.brightness(v.texel->rgb.data());
    for (int c = 0; c < 3; ++c) solveChannel(system, part, c, values);
    for (const Value& v : its) {
      dvec3& value = values[v.unknown - part.firstTexel];
      v.texel->rgb = light.halves(value);
      value = dvec3(0.);  // is written
    }
    for (std::uint32_t i = 0; i < part.texels; ++i) {
      if (std::max({values[i].x, values[i].y, values[i].z}) < kLeastAdded) continue;
      const TexelPlace p = system.places[part.firstTexel + i];
      added.push_back({.map = p.map, .x = p.x, .y = p.y, .rgb = light.halves(values[i])});
    }
  }
  lit.insert(lit.end(), added.begin(), added.end());
  std::ranges::sort(lit, {}, placeOf);
}

}  // namespace

SeamReport closeSeams(const Plan& plan, BakedLight& baked) {
  const auto start = Clock::now();
  const Light light(*plan.world.scene);
  const std::vector<Seam> seams = findSeams(plan);
  if (seams.empty() || Progress::cancelled()) return {};
  const auto tracer = makeEmbreeTracer(plan.world);
  const SeamSystem system =
      seamSystem(seams, seamPoints(seams, 0, *tracer), seamPoints(seams, 1, *tracer), baked.texels);
  if (Progress::cancelled()) return {};
  Progress progress("closing seams", 3 * system.parts.size() + baked.groups.size());
  SeamReport report;
  report.seams = seams.size();
  report.texels = system.places.size();
  report.samples = system.samples.size();
  report.parts = system.parts.size();
  report.before = stepsOf(system, sumOf(system, baked, light));
  report.mostIterations = solveMaps(system, baked, light, progress);
  parallelFor(baked.groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      solveGroup(system, baked.groups[i], light);
      progress.advance();
    }
  });
  report.after = stepsOf(system, sumOf(system, baked, light));
  for (const Encoding encoding : plan.settings.encodings)
    if (encoding != Encoding::Png)
      report.encoded.push_back({encoding, stepsOf(system, sumOf(system, baked, light, encoding))});
  report.seconds = secondsSince(start);
  return report;
}

}  // namespace lucerna::bake
