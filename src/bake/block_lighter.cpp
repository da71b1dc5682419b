#include "bake/block_lighter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.hpp"
#include "trace/light_sampling.hpp"

namespace lucerna::bake {
namespace {

using scene::LightKind;
using scene::PlacedLight;
using Clock = std::chrono::steady_clock;

constexpr int kFirstPoints = 4;  // of a light with a size: if they agree, they stand for all

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

float distanceTo(const Aabb& box, vec3 p) {
  return glm::length(glm::max(glm::max(box.min - p, p - box.max), vec3(0.f)));
}

// The size of the light, seen as a ball around its place.
float ballOf(const PlacedLight& light) {
  return light.kind == LightKind::Directional ? 0.f : light.radius;
}

bool hasSize(const PlacedLight& light) {
  return light.kind == LightKind::Directional ? light.angle > 0.f : light.radius > 0.f;
}

// Points that share what the light gives, the same for all samples of the block: on a spot light's
// disc, on the disc of a sphere that faces the block, in the cone of a directional light. Of a
// square of n points the first four are one of each quarter.
std::vector<PlacedLight> pointsOn(const PlacedLight& light, int count, vec3 blockW) {
  if (!hasSize(light) || count == 1) return {light};
  const int side = static_cast<int>(std::lround(std::sqrt(count)));
  CHECK(side * side == count && side % 2 == 0, "{} points make no square of an even side", count);
  std::vector<PlacedLight> points;
  const bool directional = light.kind == LightKind::Directional;
  const vec3 axis =
      light.kind == LightKind::Point ? glm::normalize(blockW - light.positionW) : light.directionW;
  const trace::Frame frame(std::isfinite(axis.x) ? axis : vec3(0.f, 1.f, 0.f));
  const float radius =
      directional ? std::tan(0.5f * std::min(light.angle, 0.5f * kPi)) : light.radius;
  const auto add = [&](int x, int y) {
    const vec2 u = (vec2(x, y) + 0.5f) / static_cast<float>(side);
    const vec2 p = radius * trace::discPoint(u);
    PlacedLight point = light;
    if (directional)
      point.directionW = glm::normalize(axis + frame.x * p.x + frame.y * p.y);
    else
      point.positionW += frame.x * p.x + frame.y * p.y;
    point.intensity /= static_cast<float>(count);
    point.radius = point.angle = 0.f;
    points.push_back(point);
  };
  // From the middle of each quarter outwards.
  const int half = side / 2, middle = half / 2;
  for (const int y : {middle, half + middle})
    for (const int x : {middle, half + middle}) add(x, y);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (x % half != middle || y % half != middle) add(x, y);
  return points;
}

}  // namespace

BlockLighter::BlockLighter(const ShadowTracer& tracer, const Occluders& occluders, int lightSamples,
                           float sceneDiagonal)
    : tracer_(tracer),
      occluders_(occluders),
      lightSamples_(lightSamples),
      sceneDiagonal_(sceneDiagonal) {}

bool BlockLighter::mayLight(const Samples& samples, const PlacedLight& light) const {
  // How far the directions to the light may be below the horizon of the block's mean normal.
  const float sine = std::sqrt(std::max(1.f - samples.cosine * samples.cosine, 0.f));
  if (light.kind == LightKind::Directional) {
    if (samples.cosine <= 0.f) return true;
    const float below = std::asin(std::min(sine, 1.f)) + 0.5f * std::min(light.angle, kPi);
    return below >= 0.5f * kPi || glm::dot(samples.axis, -light.directionW) > -std::sin(below);
  }
  const float nearest = distanceTo(samples.boundsW, light.positionW);
  if (nearest >= light.reach + light.radius) return false;
  const vec3 centre = samples.boundsW.center();
  const float ball = 0.5f * samples.boundsW.diagonal();
  if (samples.planar &&
      glm::dot(samples.axis, light.positionW - samples.corners[0]) <= -light.radius)
    return false;
  if (light.kind != LightKind::Spot || light.cosOuter < 0.f) return true;
  // The block as a ball against the cone, which is as wide as its disc at the start.
  const vec3 to = centre - light.positionW;
  const float along = glm::dot(to, light.directionW);
  const float across = std::sqrt(std::max(glm::dot(to, to) - along * along, 0.f));
  const float sinOuter = std::sqrt(std::max(1.f - light.cosOuter * light.cosOuter, 0.f));
  return across * light.cosOuter - along * sinOuter <= ball + light.radius;
}

// weights_: what each sample gets of the point's intensity where nothing is in the way.
void BlockLighter::shade(const Samples& s, const PlacedLight& p) {
  const std::size_t count = s.size();
  weights_.resize(count);
  float* weights = weights_.data();
  const float *x = s.x.data(), *y = s.y.data(), *z = s.z.data();
  const float *nx = s.nx.data(), *ny = s.ny.data(), *nz = s.nz.data();
  if (p.kind == LightKind::Directional) {
    const vec3 l = -p.directionW;
    for (std::size_t i = 0; i < count; ++i)
      weights[i] = std::max(nx[i] * l.x + ny[i] * l.y + nz[i] * l.z, 0.f);
    return;
  }
  const vec3 from = p.positionW, a = p.attenuation;
  const float inverseReach = 1.f / p.reach;  // 0 for an infinite reach
  for (std::size_t i = 0; i < count; ++i) {
    const float lx = from.x - x[i], ly = from.y - y[i], lz = from.z - z[i];
    const float distance = std::sqrt(lx * lx + ly * ly + lz * lz);
    const float d = std::max(distance, 0.01f);  // as scene/light.hpp
    const float ratio = std::min(distance * inverseReach, 1.f);
    const float window = 1.f - ratio * ratio * ratio * ratio;
    const float cosine = (nx[i] * lx + ny[i] * ly + nz[i] * lz) / std::max(distance, 1e-6f);
    weights[i] = std::max(cosine, 0.f) * window * window / (a.x + a.y * d + a.z * d * d);
  }
  if (p.kind != LightKind::Spot) return;
  const vec3 axis = p.directionW;
  for (std::size_t i = 0; i < count; ++i) {
    if (weights[i] == 0.f) continue;
    const vec3 v = vec3(x[i], y[i], z[i]) - from;
    weights[i] *= coneFactor(p, glm::dot(v, axis) / std::max(glm::length(v), 1e-6f));
  }
}

// lit_ and rays_: the samples that the point may light, of those in `among` (all if it is empty).
void BlockLighter::collect(const Samples& s, const PlacedLight& p,
                           std::span<const std::uint32_t> among) {
  lit_.clear();
  if (among.empty()) {
    for (std::uint32_t i = 0; i < s.size(); ++i)
      if (weights_[i] > 0.f) lit_.push_back(i);
  } else {
    for (const std::uint32_t i : among)
      if (weights_[i] > 0.f) lit_.push_back(i);
  }
  rays_.resize(lit_.size());
  const bool directional = p.kind == LightKind::Directional;
  const vec3 back = -p.directionW * sceneDiagonal_;
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    const std::size_t at = lit_[i];
    const vec3 to(s.x[at], s.y[at], s.z[at]);
    const vec3 from = directional ? to + back : p.positionW;
    rays_.fromX[i] = from.x;
    rays_.fromY[i] = from.y;
    rays_.fromZ[i] = from.z;
    rays_.toX[i] = to.x;
    rays_.toY[i] = to.y;
    rays_.toZ[i] = to.z;
  }
}

void BlockLighter::addPoint(const Samples& samples, const PlacedLight& point, bool clear,
                            std::span<const std::uint32_t> among) {
  auto start = Clock::now();
  shade(samples, point);
  collect(samples, point, among);
  shares_.assign(lit_.size(), vec3(1.f));
  counters.pairs += lit_.size();
  counters.shadingSeconds += secondsSince(start);
  if (!clear) {
    start = Clock::now();
    tracer_.trace(rays_, shares_);
    counters.rays += lit_.size();
    counters.tracingSeconds += secondsSince(start);
  }
  start = Clock::now();
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    const std::size_t at = lit_[i];
    light_[at] += point.intensity * weights_[at] * shares_[i];
    seen_[at] += (shares_[i].x + shares_[i].y + shares_[i].z) / 3.f;
    ++asked_[at];
  }
  counters.shadingSeconds += secondsSince(start);
}

bool BlockLighter::isClear(const Samples& samples, const PlacedLight& light) const {
  if (!samples.planar) return false;
  if (light.kind == LightKind::Directional)
    return !occluders_.anyIn(shaftAlong(
        -light.directionW, std::sin(0.5f * std::min(light.angle, kPi)), sceneDiagonal_, samples));
  return !occluders_.anyIn(shaftFrom(light.positionW, ballOf(light), samples));
}

void BlockLighter::lightBy(const Samples& samples, const PlacedLight& light) {
  const auto start = Clock::now();
  const bool clear = isClear(samples, light);
  counters.tracingSeconds += secondsSince(start);
  const std::vector<PlacedLight> points = pointsOn(light, lightSamples_, samples.boundsW.center());
  const std::size_t first =
      points.size() == 1 ? 1 : std::min<std::size_t>(kFirstPoints, points.size());
  light_.assign(samples.size(), vec3(0.f));
  seen_.assign(samples.size(), 0.f);
  asked_.assign(samples.size(), 0);
  for (std::size_t i = 0; i < first; ++i) addPoint(samples, points[i], clear, {});
  if (first < points.size()) {
    const float share = static_cast<float>(points.size()) / static_cast<float>(first);
    unsure_.clear();
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
      const bool partly = seen_[i] > 0.f && seen_[i] < static_cast<float>(first);
      if (partly)
        unsure_.push_back(i);
      else
        light_[i] *= share;
    }
    if (!unsure_.empty())
      for (std::size_t i = first; i < points.size(); ++i)
        addPoint(samples, points[i], false, unsure_);
  }
  for (std::size_t i = 0; i < samples.size(); ++i) sums_[i] += light_[i];
}

void BlockLighter::light(const Samples& samples, std::span<const PlacedLight> lights,
                         std::span<vec3> texels) {
  sums_.assign(samples.size(), vec3(0.f));
  bool any = false;
  for (const PlacedLight& light : lights)
    if (mayLight(samples, light)) {
      lightBy(samples, light);
      any = true;
    }
  if (!any) return;
  for (std::size_t i = 0; i < samples.size();) {
    const std::size_t first = i;
    vec3 sum(0.f);
    for (; i < samples.size() && samples.texels[i] == samples.texels[first]; ++i) sum += sums_[i];
    texels[samples.texels[first]] += sum / static_cast<float>(i - first);
  }
}

}  // namespace lucerna::bake
