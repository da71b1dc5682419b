#include "bake/block_lighter.hpp"

#include <algorithm>
#include <cmath>

#include "bake/light_set.hpp"
#include "bake/seconds.hpp"

namespace lucerna::bake {
namespace {

using scene::LightKind;
using scene::PlacedLight;

// On the rim of a light with a size: if they agree, they stand for all, for a texel of one place.
// Of a disc beyond a straight edge that all of them miss there is 1 %; of what shows through a gap
// it may be all, so whoever has a neighbour that does not agree is asked, too.
constexpr int kRimPoints = 8;
// Of one of many lights that are the sky: beyond an edge there may be 9 % of its disc.
constexpr int kSkyRimPoints = 4;

// That are sooner traced than it is found that nothing is in their way, which takes as long as 50
// and is so of one block in twenty at most, in scenes that are not empty.
constexpr std::size_t kFewRays = 1024;

int rimPointsOf(const PlacedLight& light) {
  return isOfSky(light) ? kSkyRimPoints : kRimPoints;
}

float distanceTo(const Aabb& box, vec3 p) {
  return glm::length(glm::max(glm::max(box.min - p, p - box.max), vec3(0.f)));
}

// The size of the light, seen as a ball around its place.
float ballOf(const PlacedLight& light) {
  return light.kind == LightKind::Directional ? 0.f : light.radius;
}

}  // namespace

BlockLighter::BlockLighter(const ShadowTracer& tracer, const Occluders& occluders,
                           const Emitters& emitters, const LighterSettings& settings,
                           const scene::Scene& scene)
    : Lighter(settings),
      tracer_(tracer),
      occluders_(occluders),
      emitters_(emitters),
      scene_(scene) {}

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
void BlockLighter::shade(const Samples& s, const LightPoint& point, Tile range) {
  const PlacedLight& p = point.light;
  const std::size_t count = range.count;
  weights_.resize(s.size());
  float* weights = weights_.data() + range.first;
  const float *x = s.x.data() + range.first, *y = s.y.data() + range.first,
              *z = s.z.data() + range.first;
  const float *nx = s.nx.data() + range.first, *ny = s.ny.data() + range.first,
              *nz = s.nz.data() + range.first;
  if (p.kind == LightKind::Directional) {
    const vec3 l = -p.directionW;
    for (std::size_t i = 0; i < count; ++i)
      weights[i] = std::max(nx[i] * l.x + ny[i] * l.y + nz[i] * l.z, 0.f);
    return;
  }
  const vec3 from = p.positionW, centre = point.centreW, a = p.attenuation;
  const float inverseReach = 1.f / p.reach;  // 0 for an infinite reach
  for (std::size_t i = 0; i < count; ++i) {
    const float lx = from.x - x[i], ly = from.y - y[i], lz = from.z - z[i];
    const float cx = centre.x - x[i], cy = centre.y - y[i], cz = centre.z - z[i];
    const float distance = std::sqrt(cx * cx + cy * cy + cz * cz);
    const float d = std::max(distance, 0.01f);  // as scene/light.hpp
    const float ratio = std::min(distance * inverseReach, 1.f);
    const float window = 1.f - ratio * ratio * ratio * ratio;
    const float cosine = (nx[i] * lx + ny[i] * ly + nz[i] * lz) / std::max(distance, 1e-6f);
    weights[i] = std::max(cosine, 0.f) * window * window / (a.x + a.y * d + a.z * d * d);
  }
  if (p.kind != LightKind::Spot) return;
  // As coneFactor() of scene/light.hpp.
  const vec3 axis = p.directionW;
  const float outer = p.cosOuter, slope = 1.f / std::max(p.cosInner - p.cosOuter, 1e-3f);
  const bool lambert = p.exponent == 1.f;
  for (std::size_t i = 0; i < count; ++i) {
    const float vx = x[i] - from.x, vy = y[i] - from.y, vz = z[i] - from.z;
    const float distance = std::sqrt(vx * vx + vy * vy + vz * vz);
    const float cosine = (vx * axis.x + vy * axis.y + vz * axis.z) / std::max(distance, 1e-6f);
    const float ramp = std::min(std::max((cosine - outer) * slope, 0.f), 1.f);
    weights[i] *= ramp * ramp * (lambert ? std::max(cosine, 0.f) : 1.f);
  }
  if (p.exponent == 0.f || lambert) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (weights[i] == 0.f) continue;
    const vec3 v = vec3(x[i], y[i], z[i]) - from;
    const float cosine = glm::dot(v, axis) / std::max(glm::length(v), 1e-6f);
    weights[i] *= std::pow(std::max(cosine, 0.f), p.exponent);
  }
}

void BlockLighter::setRay(std::size_t i, vec3 from, vec3 to) {
  rays_.fromX[i] = from.x;
  rays_.fromY[i] = from.y;
  rays_.fromZ[i] = from.z;
  rays_.toX[i] = to.x;
  rays_.toY[i] = to.y;
  rays_.toZ[i] = to.z;
}

// Appends to lit_ and rays_ the samples of the range that the point may light.
void BlockLighter::collect(const Samples& s, const LightPoint& p, Tile range) {
  const std::size_t first = lit_.size();
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i)
    if (weights_[i] > 0.f) lit_.push_back(i);
  rays_.resize(lit_.size());
  for (std::size_t i = first; i < lit_.size(); ++i) {
    const std::size_t at = lit_[i];
    const vec3 to(s.x[at], s.y[at], s.z[at]);
    setRay(i, startOf(p, to, settings_.sceneBoxW), to);
  }
}

// As shade() and collect(), of a sphere's point that is seen at p of the unit disc, with weights
// for all points of it; uniform in solid angle.
void BlockLighter::collectOfSphere(const Samples& s, const PlacedLight& sphere, vec2 p,
                                   Tile range) {
  const std::size_t first = lit_.size();
  weights_.resize(s.size());
  rays_.resize(first + range.count);
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    const vec3 at(s.x[i], s.y[i], s.z[i]);
    const WayToSphere way = wayToSphere(sphere, at, p);
    weights_[i] = std::max(glm::dot(way.wayW, vec3(s.nx[i], s.ny[i], s.nz[i])), 0.f);
    if (weights_[i] == 0.f) continue;
    setRay(lit_.size(), at + way.wayW * way.length, at);
    lit_.push_back(i);
  }
  rays_.resize(lit_.size());
}

// Leaves in shares_ what each of lit_ sees.
void BlockLighter::trace() {
  shares_.resize(lit_.size());
  counters.pairs += lit_.size();
  counters.rays += lit_.size();
  if (lit_.empty()) return;
  const auto start = Clock::now();
  tracer_.trace(rays_, shares_);
  counters.tracingSeconds += secondsSince(start);
}

void BlockLighter::forgetRays() {
  lit_.clear();
  rays_.resize(0);
}

bool BlockLighter::isClear(const Samples& samples, const PlacedLight& light) const {
  const auto points = static_cast<std::size_t>(pointsOf(light) > 1 ? rimPointsOf(light) : 1);
  if (!samples.planar || points * samples.size() < kFewRays) return false;
  if (light.kind == LightKind::Directional)
    return !occluders_.anyIn(shaftAlong(-light.directionW,
                                        std::sin(0.5f * std::min(light.angle, kPi)),
                                        settings_.sceneDiagonal, samples));
  return !occluders_.anyIn(shaftFrom(light.positionW, ballOf(light), samples));
}

// Sorts unsure_ by places, and puts them into gathered_.
void BlockLighter::gather(const Samples& s) {
  std::ranges::stable_sort(unsure_, {}, [&](std::uint32_t i) { return s.places[i]; });
  places_.clear();
  gathered_.perTexel = s.perTexel;
  for (auto* list :
       {&gathered_.x, &gathered_.y, &gathered_.z, &gathered_.nx, &gathered_.ny, &gathered_.nz})
    list->clear();
  for (const std::uint32_t i : unsure_) {
    if (places_.empty() || places_.back().place != s.places[i])
      places_.push_back(
          {.place = s.places[i],
           .range = {
               .first = static_cast<std::uint32_t>(gathered_.size()), .count = 0, .boundsW = {}}});
    ++places_.back().range.count;
    gathered_.x.push_back(s.x[i]);
    gathered_.y.push_back(s.y[i]);
    gathered_.z.push_back(s.z[i]);
    gathered_.nx.push_back(s.nx[i]);
    gathered_.ny.push_back(s.ny[i]);
    gathered_.nz.push_back(s.nz[i]);
  }
}

// One more point of the light for all that are gathered: pointOf(place) of the unit disc. The
// answers come when many rays are to be traced, or with countAnswers(): packets are full.
template <typename PointOf>
void BlockLighter::ask(const PlacedLight& light, const Disc& disc, const PointOf& pointOf) {
  const std::size_t first = lit_.size();
  for (const Asked& asked : places_) {
    const vec2 p = pointOf(asked.place);
    if (bySphere_) {
      collectOfSphere(gathered_, light, p, asked.range);
      continue;
    }
    const LightPoint point = disc.at(p);
    shade(gathered_, point, asked.range);
    collect(gathered_, point, asked.range);
  }
  for (std::size_t i = first; i < lit_.size(); ++i) given_.push_back(weights_[lit_[i]]);
  if (lit_.size() >= kMostRays) countAnswers();
}

// Adds what was asked and not yet traced to seen_ and asked_.
void BlockLighter::countAnswers() {
  trace();
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    seen_[unsure_[lit_[i]]] += given_[i] * shares_[i];
    asked_[unsure_[lit_[i]]] += given_[i];
  }
  given_.clear();
  forgetRays();
}

// Those whose points all see the light, or none; byTexel: the points of all of the texel's samples.
void BlockLighter::dropSure(const Samples& samples, bool byTexel) {
  constexpr std::uint8_t kSeen = 1, kBlocked = 2;
  const auto answer = [&](std::uint32_t i) {
    if (asked_[i] == 0.f) return kSeen | kBlocked;
    return (seen_[i] != vec3(0.f) ? kSeen : 0) | (seen_[i] != vec3(asked_[i]) ? kBlocked : 0);
  };
  if (!byTexel) {
    std::erase_if(unsure_, [&](std::uint32_t i) { return answer(i) != (kSeen | kBlocked); });
    return;
  }
  answers_.assign(samples.texelCount, 0);
  for (const std::uint32_t i : unsure_)
    answers_[samples.texels[i]] |= static_cast<std::uint8_t>(answer(i));
  std::erase_if(unsure_,
                [&](std::uint32_t i) { return answers_[samples.texels[i]] != (kSeen | kBlocked); });
}

// unsure_: of the tile's samples those that rim points alone were asked for, beside one that sees
// another part of the light. One sample a texel.
void BlockLighter::findBeside(const Samples& s, const Tile& tile) {
  const float near = 1.6f * s.texelSize;  // m, also over a corner
  const auto differs = [&](std::uint32_t i, std::uint32_t k) {
    const bool same = asked_[k] <= 0.f || (seen_[i] == vec3(0.f) && seen_[k] == vec3(0.f)) ||
                      (seen_[i] == vec3(asked_[i]) && seen_[k] == vec3(asked_[k]));
    const vec3 to(s.x[k] - s.x[i], s.y[k] - s.y[i], s.z[k] - s.z[i]);
    return !same && glm::dot(to, to) < near * near;
  };
  unsure_.clear();
  bool anySeen = false, anyBlocked = false;
  for (std::uint32_t i = tile.first; i < tile.first + tile.count; ++i) {
    if (full_[i] <= 0.f || asked_[i] <= 0.f) continue;
    anySeen = anySeen || seen_[i] != vec3(0.f);
    anyBlocked = anyBlocked || seen_[i] != vec3(asked_[i]);
  }
  if (!anySeen || !anyBlocked) return;
  for (std::uint32_t i = tile.first; i < tile.first + tile.count; ++i) {
    if (full_[i] <= 0.f || fine_[i]) continue;
    std::uint32_t k = tile.first;
    while (k < tile.first + tile.count && (full_[k] <= 0.f || !differs(i, k))) ++k;
    if (k < tile.first + tile.count) unsure_.push_back(i);
  }
}

// Of the samples in unsure_: seen_ / asked_ is the share of the light that they see.
void BlockLighter::traceSized(const Samples& samples, const Tile& tile, const PlacedLight& light) {
  const Disc disc(light, tile.boundsW.center());
  const int count = pointsOf(light), places = static_cast<int>(samples.perTexel);
  const auto askSpiral = [&](int first, int step) {
    gather(samples);
    for (int i = first; !unsure_.empty() && i < count; i += step)
      ask(light, disc, [&](std::uint16_t place) {
        return sharesPoints() ? spiralPoint(i * places + place, count * places, vec2(0.5f, 0.f))
                              : spiralPoint(i, count, shiftOf(place, samples.perTexel));
      });
    countAnswers();
  };
  const auto restart = [&] {
    for (const std::uint32_t i : unsure_) {
      seen_[i] = vec3(0.f);
      asked_[i] = 0.f;
    }
  };
  // Texels of one place are content with the disc that faces their tile, which is faster, unless
  // the sphere is near.
  bySphere_ =
      light.kind == LightKind::Point && (samples.perTexel > 1 || isNearSphere(light, tile.boundsW));
  given_.clear();
  forgetRays();
  restart();
  if (samples.perTexel > 1) {
    askSpiral(0, 2);
    dropSure(samples, true);
    askSpiral(1, 2);
    return;
  }
  gather(samples);
  const int rim = rimPointsOf(light);
  for (int i = 0; i < rim; ++i)
    ask(light, disc, [&](std::uint16_t) {
      return onCircle(0.999f, static_cast<float>(i) / static_cast<float>(rim));
    });
  countAnswers();
  dropSure(samples, false);
  fine_.assign(samples.size(), false);
  do {
    restart();
    for (const std::uint32_t i : unsure_) fine_[i] = true;
    askSpiral(0, 1);
    findBeside(samples, tile);
  } while (!unsure_.empty());
}

void BlockLighter::lightBySized(const Samples& samples, const Tile& tile, const PlacedLight& light,
                                bool clear) {
  const std::uint32_t end = tile.first + tile.count;
  const Disc disc(light, tile.boundsW.center());
  // Four points on the circle that halves the disc give what all of it gives, but for terms of the
  // fourth order.
  constexpr int kPoints = 4;
  std::fill(full_.begin() + tile.first, full_.begin() + end, 0.f);
  for (int k = 0; k < kPoints; ++k) {
    shade(samples, disc.at(onCircle(std::sqrt(0.5f), static_cast<float>(k) / kPoints)), tile);
    for (std::uint32_t i = tile.first; i < end; ++i) full_[i] += weights_[i] / kPoints;
  }
  unsure_.clear();
  for (std::uint32_t i = tile.first; i < end; ++i) {
    if (full_[i] <= 0.f) continue;
    seen_[i] = vec3(1.f);
    asked_[i] = 1.f;
    unsure_.push_back(i);
  }
  if (clear)
    counters.pairs += unsure_.size();
  else if (!unsure_.empty())
    traceSized(samples, tile, light);
  const vec3 intensity = disc.at(vec2(0.f)).light.intensity;
  for (std::uint32_t i = tile.first; i < end; ++i)
    if (full_[i] > 0.f && asked_[i] > 0.f)
      sums_[i] += intensity * (full_[i] / asked_[i]) * seen_[i];
}

void BlockLighter::lightBy(const Samples& samples, const PlacedLight& light) {
  const auto start = Clock::now();
  const double tracing = counters.tracingSeconds;
  const bool clear = isClear(samples, light);
  counters.tracingSeconds += secondsSince(start);
  if (pointsOf(light) > 1) {
    full_.resize(samples.size());
    seen_.resize(samples.size());
    asked_.resize(samples.size());
    for (const Tile& tile : samples.tiles) lightBySized(samples, tile, light, clear);
  } else {
    const LightPoint point = middleOf(light);
    const Tile all{.first = 0, .count = static_cast<std::uint32_t>(samples.size()), .boundsW = {}};
    shade(samples, point, all);
    if (clear) {
      for (std::uint32_t i = 0; i < all.count; ++i) {
        sums_[i] += light.intensity * weights_[i];
        counters.pairs += weights_[i] > 0.f;
      }
    } else {
      forgetRays();
      collect(samples, point, all);
      trace();
      for (std::size_t i = 0; i < lit_.size(); ++i)
        sums_[lit_[i]] += light.intensity * weights_[lit_[i]] * shares_[i];
    }
  }
  counters.shadingSeconds += secondsSince(start) - (counters.tracingSeconds - tracing);
}

void BlockLighter::lightAgain(const Samples& samples, std::span<const PlacedLight> lights,
                              std::uint32_t light) {
  if (light != UnevenTexel::kEmitters) {
    lightBy(samples, lights[light]);
  } else {
    findNodes(samples);
    lightByAllEmitters(samples);
  }
}

bool BlockLighter::light(const Samples& samples, std::span<const PlacedLight> lights, bool emitters,
                         std::vector<vec3>& texels, Uneven* uneven) {
  found_.clear();
  if (emitters && !emitters_.nodes.empty()) findNodes(samples);
  const auto first = std::ranges::find_if(
      lights, [&](const PlacedLight& light) { return mayLight(samples, light); });
  if (first == lights.end() && found_.empty()) return false;
  sums_.assign(samples.size(), vec3(0.f));
  texels.assign(samples.texelCount, vec3(0.f));
  if (uneven) uneven->texels.clear();
  for (auto i = static_cast<std::uint32_t>(first - lights.begin()); i < lights.size(); ++i) {
    if (!mayLight(samples, lights[i])) continue;
    lightBy(samples, lights[i]);
    if (uneven) findUneven(samples, lights, i, *uneven, texels);
  }
  if (!found_.empty()) lightByAllEmitters(samples);
  if (!uneven) {
    addMeans(samples, texels);
    return true;
  }
  if (!found_.empty()) findUneven(samples, lights, UnevenTexel::kEmitters, *uneven, texels);
  dropEven(texels, uneven->texels);
  return true;
}

}  // namespace lucerna::bake
