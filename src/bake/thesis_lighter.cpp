#include "bake/thesis_lighter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bake/seconds.hpp"

namespace lucerna::bake {
namespace {

using scene::LightKind;
using scene::PlacedLight;

// Whether the light of a cell reaches any place in the box.
bool reaches(const PlacedLight& cell, const Aabb& boxW) {
  const vec3 p = cell.positionW;
  const vec3 off = glm::max(glm::max(boxW.min - p, p - boxW.max), vec3(0.f));
  return glm::dot(off, off) < cell.reach * cell.reach;
}

// What of the point's intensity a place gets where nothing is in the way. What gives nothing is
// known before anything that takes long.
float weightAt(const LightPoint& point, vec3 placeW, vec3 normalW) {
  const PlacedLight& light = point.light;
  if (light.kind == LightKind::Directional)
    return std::max(-glm::dot(normalW, light.directionW), 0.f);
  const vec3 toCentre = point.centreW - placeW;
  const float squared = glm::dot(toCentre, toCentre);
  if (squared >= light.reach * light.reach) return 0.f;
  const vec3 to = light.positionW - placeW;
  const float cosine = glm::dot(normalW, to);
  if (cosine <= 0.f) return 0.f;
  const float along = -glm::dot(light.directionW, to);
  if (light.kind == LightKind::Spot && light.cosOuter >= 0.f && along <= 0.f) return 0.f;
  const float distance = std::max(std::sqrt(squared), 1e-6f);
  const float cone = scene::coneFactor(light, along / std::max(glm::length(to), 1e-6f));
  if (cone <= 0.f) return 0.f;
  return cone * scene::attenuationAt(light, distance) * cosine / distance;
}

}  // namespace

std::vector<PlacedLight> cellLights(const Emitters& emitters, const scene::Scene& scene) {
  std::vector<PlacedLight> lights;
  lights.reserve(emitters.cells);
  for (const EmitterNode& node : emitters.nodes)
    if (node.isCell()) lights.push_back(lightOf(node.emission, scene, node.reach));
  return lights;
}

ThesisLighter::ThesisLighter(const ShadowTracer& tracer, std::span<const PlacedLight> cells,
                             const LighterSettings& settings)
    : Lighter(settings), tracer_(tracer), cells_(cells) {}

void ThesisLighter::sortByTriangle(const Samples& samples) {
  const auto start = Clock::now();
  order_.resize(samples.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::stable_sort(order_, {}, [&](std::uint32_t i) {
    return std::pair(samples.triangles[i], samples.places[i]);
  });
  counters.shadingSeconds += secondsSince(start);
}

void ThesisLighter::flush() {
  const auto start = Clock::now();
  counters.pairs += lit_.size();
  counters.rays += lit_.size();
  shares_.resize(lit_.size());
  tracer_.trace(rays_, shares_);
  for (std::size_t i = 0; i < lit_.size(); ++i) sums_[lit_[i]] += values_[i] * shares_[i];
  lit_.clear();
  values_.clear();
  rays_.resize(0);
  counters.tracingSeconds += secondsSince(start);
}

void ThesisLighter::lightBy(const Samples& s, const Part& part, const LightPoint& point,
                            float share) {
  const std::size_t first = lit_.size();
  for (const std::uint32_t i : part.samples) {
    const float weight = weightAt(point, {s.x[i], s.y[i], s.z[i]}, {s.nx[i], s.ny[i], s.nz[i]});
    if (weight <= 0.f) continue;
    lit_.push_back(i);
    values_.push_back(point.light.intensity * (weight * share));
  }
  rays_.resize(lit_.size());
  for (std::size_t k = first; k < lit_.size(); ++k) {
    const std::uint32_t i = lit_[k];
    const vec3 to(s.x[i], s.y[i], s.z[i]), from = startOf(point, to, settings_.sceneBoxW);
    rays_.fromX[k] = from.x, rays_.fromY[k] = from.y, rays_.fromZ[k] = from.z;
    rays_.toX[k] = to.x, rays_.toY[k] = to.y, rays_.toZ[k] = to.z;
  }
  constexpr std::size_t kMostRays = 4096;  // that wait
  if (lit_.size() >= kMostRays) flush();
}

// Each place asks the side that it sees itself.
void ThesisLighter::lightBySphere(const Samples& samples, const Part& part,
                                  const PlacedLight& sphere, int points) {
  LightPoint point{.light = sphere, .centreW = sphere.positionW};
  point.light.radius = 0.f;
  for (std::size_t i = 0; i < part.samples.size(); ++i) {
    const std::uint32_t at = part.samples[i];
    const vec3 placeW(samples.x[at], samples.y[at], samples.z[at]);
    const float distance = glm::distance(placeW, sphere.positionW);
    Part one = part;
    one.samples = part.samples.subspan(i, 1);
    for (int k = 0; k < points; ++k) {
      const WayToSphere way = wayToSphere(sphere, placeW, spiralPoint(k, points, part.shift));
      point.light.positionW = placeW + way.wayW * distance;
      point.ahead = distance - way.length;
      lightBy(samples, one, point, way.brightness / static_cast<float>(points));
    }
  }
}

void ThesisLighter::lightPart(const Samples& samples, const Part& part,
                              std::span<const PlacedLight> lights, bool emitters) {
  for (const PlacedLight& light : lights) {
    const int points = pointsOf(light);
    if (points == 1) {
      lightBy(samples, part, middleOf(light), 1.f);
      continue;
    }
    if (isNearSphere(light, part.boundsW)) {
      lightBySphere(samples, part, light, points);
      continue;
    }
    const Disc disc(light, part.boundsW.center());
    for (int k = 0; k < points; ++k)
      lightBy(samples, part, disc.at(spiralPoint(k, points, part.shift)),
              1.f / static_cast<float>(points));
  }
  if (!emitters) return;
  for (const PlacedLight& cell : cells_)
    if (reaches(cell, part.boundsW)) lightBy(samples, part, middleOf(cell), 1.f);
}

void ThesisLighter::lightParts(const Samples& samples, std::span<const PlacedLight> lights,
                               bool emitters) {
  const auto start = Clock::now();
  const double tracing = counters.tracingSeconds;
  const auto partOf = [&](std::size_t i) {
    return std::pair(samples.triangles[order_[i]], samples.places[order_[i]]);
  };
  for (std::size_t i = 0; i < order_.size();) {
    const std::size_t first = i;
    Part part{.samples = {},
              .shift = shiftOf(samples.places[order_[first]], samples.perTexel),
              .boundsW = {}};
    for (; i < order_.size() && partOf(i) == partOf(first); ++i)
      part.boundsW.grow(vec3(samples.x[order_[i]], samples.y[order_[i]], samples.z[order_[i]]));
    part.samples = std::span(order_).subspan(first, i - first);
    lightPart(samples, part, lights, emitters);
  }
  if (!lit_.empty()) flush();
  counters.shadingSeconds += secondsSince(start) - (counters.tracingSeconds - tracing);
}

void ThesisLighter::lightByOne(const Samples& samples, std::span<const PlacedLight> lights,
                               std::uint32_t light) {
  const bool emitters = light == UnevenTexel::kEmitters;
  lightParts(samples, emitters ? lights.first(0) : lights.subspan(light, 1), emitters);
}

void ThesisLighter::lightAgain(const Samples& samples, std::span<const PlacedLight> lights,
                               std::uint32_t light) {
  sortByTriangle(samples);
  lightByOne(samples, lights, light);
}

bool ThesisLighter::lightOneByOne(const Samples& samples, std::span<const PlacedLight> lights,
                                  bool emitters, std::vector<vec3>& texels, Uneven& uneven) {
  bool any = false;
  const auto add = [&](std::uint32_t light) {
    const std::uint64_t pairs = counters.pairs;
    lightByOne(samples, lights, light);
    if (counters.pairs == pairs) return;
    if (!any) texels.assign(samples.texelCount, vec3(0.f));
    any = true;
    findUneven(samples, lights, light, uneven, texels);
  };
  uneven.texels.clear();
  for (std::uint32_t i = 0; i < lights.size(); ++i) add(i);
  if (emitters) add(UnevenTexel::kEmitters);
  if (any) dropEven(texels, uneven.texels);
  return any;
}

bool ThesisLighter::light(const Samples& samples, std::span<const PlacedLight> lights,
                          bool emitters, std::vector<vec3>& texels, Uneven* uneven) {
  const std::uint64_t pairs = counters.pairs;
  sortByTriangle(samples);
  sums_.assign(samples.size(), vec3(0.f));
  if (uneven) return lightOneByOne(samples, lights, emitters, texels, *uneven);
  lightParts(samples, lights, emitters);
  if (counters.pairs == pairs) return false;
  texels.assign(samples.texelCount, vec3(0.f));
  addMeans(samples, texels);
  return true;
}

}  // namespace lucerna::bake
