// The part of BlockLighter that goes through emitting surfaces.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bake/block_lighter.hpp"
#include "bake/brightness.hpp"
#include "bake/polygon_light.hpp"
#include "bake/seconds.hpp"
#include "trace/low_discrepancy.hpp"

namespace lucerna::bake {
namespace {

constexpr float kMostSplit = 4.f;  // points along each side of a cell

float distanceBetween(const Aabb& a, const Aabb& b) {
  return glm::length(glm::max(glm::max(a.min - b.max, b.min - a.max), vec3(0.f)));
}

// The largest dot(axis, p) of the box's points.
float highestAlong(vec3 axis, const Aabb& box) {
  return glm::dot(axis, glm::mix(box.min, box.max, glm::step(vec3(0.f), axis)));
}

}  // namespace

// False only if nothing of the node reaches the tile.
bool BlockLighter::mayLight(const Samples& samples, const Tile& tile,
                            const EmitterNode& node) const {
  const bool oneWay = node.isCell() || node.emission.normalW != vec3(0.f);
  if (samples.planar) {
    // The corner of the box that is highest above the tile's plane.
    const vec3 highest = glm::mix(node.boxW.min, node.boxW.max, glm::step(vec3(0.f), samples.axis));
    // What lies in the tile's own plane is as clear of it as the samples.
    if (glm::dot(samples.axis, highest - samples.corners[0]) <= liftAt(samples.corners[0]))
      return false;
  }
  if (oneWay && highestAlong(node.axis, tile.boundsW) + highestAlong(-node.axis, node.boxW) <=
                    liftAt(samples.boundsW.center()))
    return false;
  if (node.cosine <= 0.f) return true;
  // Whether all directions from the node to the tile are behind all of its normals: both as balls.
  const vec3 to = tile.boundsW.center() - node.boxW.center();
  const float distance = glm::length(to);
  const float ball = 0.5f * (tile.boundsW.diagonal() + node.boxW.diagonal());
  if (distance <= ball) return true;
  const float sinSpread = std::sqrt(std::max(1.f - node.cosine * node.cosine, 0.f));
  const float sinBall = ball / distance;
  if (sinSpread + sinBall >= 1.f) return true;
  return glm::dot(to / distance, node.axis) > -(sinSpread + sinBall);
}

// weights_, as shade(): of a point of a surface.
void BlockLighter::shadeEmission(const Samples& s, const Emission& e, float reach, Tile range) {
  if (scene_.bake.area) {
    shade(s, {.light = lightOf(e, scene_, reach), .centreW = e.positionW}, range);
    return;
  }
  const std::size_t count = range.count;
  weights_.resize(s.size());
  float* weights = weights_.data() + range.first;
  const float *x = s.x.data() + range.first, *y = s.y.data() + range.first,
              *z = s.z.data() + range.first;
  const float *nx = s.nx.data() + range.first, *ny = s.ny.data() + range.first,
              *nz = s.nz.data() + range.first;
  const vec3 from = e.positionW, axis = e.normalW;
  const float inverse = 1.f / (reach * reach);  // 0 for an infinite reach
  for (std::size_t i = 0; i < count; ++i) {
    const float lx = from.x - x[i], ly = from.y - y[i], lz = from.z - z[i];
    const float squared = lx * lx + ly * ly + lz * lz;
    const float receiving = nx[i] * lx + ny[i] * ly + nz[i] * lz;
    const float sending = -(axis.x * lx + axis.y * ly + axis.z * lz);
    const float ratio = std::min(squared * inverse, 1.f);
    const float window = 1.f - ratio * ratio;
    const float d2 = std::max(squared, 1e-8f);
    weights[i] = std::max(receiving, 0.f) * std::max(sending, 0.f) * window * window / (d2 * d2);
  }
}

// For each place of a texel's pattern a point of the unit square, other ones for every seed: an
// even set, moved around by a hash (Cranley and Patterson, "Randomization of Number Theoretic
// Methods for Multiple Integration", 1976).
void BlockLighter::findPoints(const Samples& samples, std::uint32_t seed) {
  if (pattern_.size() != samples.perTexel) {
    pattern_.clear();
    for (std::uint32_t place = 0; place < samples.perTexel; ++place)
      pattern_.push_back(trace::lowDiscrepancyPoint(place, samples.perTexel));
  }
  const std::uint32_t hash = trace::mixed(0, seed);
  const vec2 by = vec2(hash & 0xffff, hash >> 16) / 65536.f;
  points_.clear();
  for (const vec2 p : pattern_) points_.push_back(glm::fract(p + by));
}

// Of what the node stands for, by its light: a cell of its tree, found by halves, and a point of
// that.
vec3 BlockLighter::pointOf(const EmitterNode& node, vec2 u) const {
  const EmitterNode* at = &node;
  while (!at->isCell()) {
    const EmitterNode &left = at[1], &right = emitters_.nodes[at->right];
    const float toLeft = brightness(left.emission.intensity),
                share = toLeft / (toLeft + brightness(right.emission.intensity));
    const bool isLeft = u.x < share;
    u.x = isLeft ? u.x / share : (u.x - share) / (1.f - share);
    at = isLeft ? &left : &right;
  }
  return at->emission.positionW + (u.x - 0.5f) * at->alongU + (u.y - 0.5f) * at->alongV;
}

// Lets the rays from the first on start at origins_, where these are above the surface that is lit.
void BlockLighter::moveOrigins(const Samples& s, std::size_t first) {
  for (std::size_t i = first; i < lit_.size(); ++i) {
    const std::uint32_t at = lit_[i];
    const vec3 from = origins_[s.places[at]];
    const vec3 to(s.x[at], s.y[at], s.z[at]), normal(s.nx[at], s.ny[at], s.nz[at]);
    if (glm::dot(from - to, normal) <= liftAt(to)) continue;
    rays_.fromX[i] = from.x;
    rays_.fromY[i] = from.y;
    rays_.fromZ[i] = from.z;
  }
}

// corrected: the weights times corrections_. findOrigins: fills origins_, where a texel has several
// places.
template <typename FindOrigins>
void BlockLighter::addEmission(const Samples& samples, const Tile& tile, const Emission& emission,
                               float reach, bool corrected, const FindOrigins& findOrigins) {
  shadeEmission(samples, emission, reach, tile);
  if (corrected)
    for (std::uint32_t i = tile.first; i < tile.first + tile.count; ++i)
      weights_[i] *= corrections_[i];
  const LightPoint point{.light = lightOf(emission, scene_, reach), .centreW = emission.positionW};
  const std::size_t first = lit_.size();
  collect(samples, point, tile);
  if (samples.perTexel > 1 && lit_.size() > first) {
    origins_.clear();
    findOrigins();
    moveOrigins(samples, first);
  }
  values_.resize(lit_.size());
  for (std::size_t i = first; i < lit_.size(); ++i)
    values_[i] = point.light.intensity * weights_[lit_[i]];
  if (lit_.size() >= kMostRays) flush();
}

void BlockLighter::flush() {
  trace();
  for (std::size_t i = 0; i < lit_.size(); ++i) sums_[lit_[i]] += values_[i] * shares_[i];
  values_.clear();
  forgetRays();
}

// A cell by a grid of points: they tell what share of it is seen. What all of it gives where
// nothing is in the way is known.
void BlockLighter::lightByCell(const Samples& samples, const Tile& tile, const EmitterNode& cell,
                               std::uint32_t seed, ivec2 split) {
  const int count = split.x * split.y;
  const vec3 middle = cell.emission.positionW, u = cell.alongU, v = cell.alongV;
  Emission part = cell.emission;
  part.intensity /= static_cast<float>(count);
  // Few points: no two in a row or a column of a finer grid, see samples.cpp.
  const auto pointAt = [&](int i) {
    const vec2 square(i % split.x, i / split.x);
    const vec2 inSquare =
        (vec2(square.y, vec2(split).x - square.x - 1.f) + 0.5f) / vec2(split.y, split.x);
    const vec2 at = (square + (splits(samples) ? inSquare : vec2(0.5f))) / vec2(split) - 0.5f;
    return middle + u * at.x + v * at.y;
  };
  const float area = glm::length(glm::cross(u, v));
  const bool corrected = !scene_.bake.area && area > 0.f;
  if (corrected) {
    corrections_.resize(samples.size());
    std::fill_n(corrections_.begin() + tile.first, tile.count, 0.f);
    for (int i = 0; i < count; ++i) {
      part.positionW = pointAt(i);
      shadeEmission(samples, part, std::numeric_limits<float>::infinity(), tile);
      for (std::uint32_t k = tile.first; k < tile.first + tile.count; ++k)
        corrections_[k] += weights_[k];
    }
    const std::array<vec3, 4> corners{middle - 0.5f * (u + v), middle + 0.5f * (u - v),
                                      middle + 0.5f * (u + v), middle - 0.5f * (u - v)};
    for (std::uint32_t k = tile.first; k < tile.first + tile.count; ++k) {
      float& correction = corrections_[k];
      if (correction <= 0.f) continue;
      const vec3 to(samples.x[k], samples.y[k], samples.z[k]);
      const vec3 normal(samples.nx[k], samples.ny[k], samples.nz[k]);
      correction =
          polygonIrradiance(corners, to, normal) * static_cast<float>(count) / (area * correction);
    }
  }
  for (int i = 0; i < count; ++i) {
    part.positionW = pointAt(i);
    addEmission(samples, tile, part, cell.reach, corrected, [&] {
      findPoints(samples, trace::mixed(seed, 3u + static_cast<std::uint32_t>(i)));
      for (const vec2 p : points_) {
        const vec2 off = (p - 0.5f) / vec2(split);
        origins_.push_back(part.positionW + u * off.x + v * off.y);
      }
    });
  }
}

// m: the largest part that one ray stands for at the distance, and at most `most`.
float BlockLighter::mostOf(float most, float distance) const {
  return std::min(most, settings_.emitterSize * distance);
}

// About the brightness of what the middle of the tile gets from the node.
float BlockLighter::givesTo(const Samples& samples, const Tile& tile,
                            const EmitterNode& node) const {
  const vec3 to = node.emission.positionW - tile.boundsW.center();
  const float squared = glm::dot(to, to) + 0.25f * node.size * node.size;
  const float distance = std::sqrt(squared);
  const float sent = std::max(-glm::dot(node.emission.normalW, to) / distance, 0.f);
  const float got = samples.planar ? std::max(glm::dot(samples.axis, to) / distance, 0.f) : 1.f;
  return brightness(node.emission.intensity) * sent * got / std::max(squared, 1e-8f);
}

// A cell that is too large for a grid is halved first, down to a texel of its own.
void BlockLighter::lightByHalves(const Samples& samples, const Tile& tile, const EmitterNode& cell,
                                 std::uint32_t seed, float most, float distance) {
  if (cell.size <= std::max(kMostSplit * mostOf(most, distance), cell.texel)) {
    lightByNode(samples, tile, cell, seed, most, distance);
    return;
  }
  for (const float which : {-1.f, 1.f}) {
    const EmitterNode half = halfOf(cell, which);
    const float toHalf = distanceBetween(half.boxW, tile.boundsW);
    if (toHalf < half.reach && mayLight(samples, tile, half))
      lightByHalves(samples, tile, half, trace::mixed(seed, which < 0.f ? 1 : 2), most, toHalf);
  }
}

// A node, or a cell that is small enough for its distance: one point. seed: as no other has it.
void BlockLighter::lightByNode(const Samples& samples, const Tile& tile, const EmitterNode& node,
                               std::uint32_t seed, float mostOfAll, float distance) {
  const float most = mostOf(mostOfAll, std::max(distance, 1e-6f));  // m, of one point's part
  if (!node.isCell() || node.size <= most) {
    addEmission(samples, tile, node.emission, node.reach, false, [&] {
      findPoints(samples, seed);
      for (const vec2 p : points_) origins_.push_back(pointOf(node, p));
    });
    return;
  }
  // Parts that are about square have sides of most / sqrt(2).
  const vec2 wanted =
      vec2(glm::length(node.alongU), glm::length(node.alongV)) * std::sqrt(2.f) / most;
  lightByCell(samples, tile, node, seed, ivec2(glm::ceil(glm::clamp(wanted, 1.f, kMostSplit))));
}

// found_: the nodes with one direction that may light the block, for all of its tiles.
void BlockLighter::findNodes(const Samples& samples) {
  const auto start = Clock::now();
  const std::vector<EmitterNode>& nodes = emitters_.nodes;
  const Tile all{
      .first = 0, .count = static_cast<std::uint32_t>(samples.size()), .boundsW = samples.boundsW};
  found_.clear();
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const std::uint32_t at = stack_.back();
    stack_.pop_back();
    const EmitterNode& node = nodes[at];
    if (distanceBetween(node.boxW, all.boundsW) >= node.reach || !mayLight(samples, all, node))
      continue;
    if (node.isCell() || node.emission.normalW != vec3(0.f)) {
      found_.push_back(at);
      continue;
    }
    stack_.push_back(node.right);
    stack_.push_back(at + 1);
  }
  counters.shadingSeconds += secondsSince(start);
}

// Calls what(node, m to it) for those that together stand for all that may light the tile: from
// each of the roots, the largest ones of which one ray is enough. most: m, see mostOf().
template <typename What>
void BlockLighter::cut(const Samples& samples, const Tile& tile,
                       std::span<const std::uint32_t> roots, float most, const What& what) {
  const std::vector<EmitterNode>& nodes = emitters_.nodes;
  stack_.assign(roots.begin(), roots.end());
  while (!stack_.empty()) {
    const std::uint32_t at = stack_.back();
    stack_.pop_back();
    const EmitterNode& node = nodes[at];
    const float distance = distanceBetween(node.boxW, tile.boundsW);
    if (distance >= node.reach || !mayLight(samples, tile, node)) continue;
    if (node.isCell() ||
        (node.emission.normalW != vec3(0.f) && node.size <= mostOf(most, distance))) {
      what(at, distance);
      continue;
    }
    stack_.push_back(node.right);
    stack_.push_back(at + 1);
  }
}

// A node that gives more than a share of the tile's light is cut until none does (Walter et al.,
// "Lightcuts: A Scalable Approach to Illumination", 2005), by what the nodes give where nothing is
// in the way.
void BlockLighter::lightByEmitters(const Samples& samples, const Tile& tile) {
  const auto start = Clock::now();
  const double tracing = counters.tracingSeconds;
  const auto light = [&](std::uint32_t at, float most, float distance) {
    const EmitterNode& node = emitters_.nodes[at];
    if (node.isCell())
      lightByHalves(samples, tile, node, at, most, distance);
    else
      lightByNode(samples, tile, node, at, most, distance);
  };
  constexpr float kAny = std::numeric_limits<float>::infinity();
  if (!splits(samples)) {
    cut(samples, tile, found_, kAny,
        [&](std::uint32_t at, float distance) { light(at, kAny, distance); });
  } else {
    near_.clear();
    float all = 0.f;
    cut(samples, tile, found_, kAny, [&](std::uint32_t at, float distance) {
      near_.push_back(
          {.node = at, .gives = givesTo(samples, tile, emitters_.nodes[at]), .distance = distance});
      all += near_.back().gives;
    });
    for (const Near& n : near_) {
      const float points = n.gives / (settings_.emitterShare * all);
      if (!(points > 1.f)) {
        light(n.node, kAny, n.distance);
        continue;
      }
      const float most = emitters_.nodes[n.node].size / std::sqrt(points);
      cut(samples, tile, std::span(&n.node, 1), most,
          [&](std::uint32_t at, float distance) { light(at, most, distance); });
    }
  }
  if (!lit_.empty()) flush();
  counters.shadingSeconds += secondsSince(start) - (counters.tracingSeconds - tracing);
}

void BlockLighter::lightByAllEmitters(const Samples& samples) {
  forgetRays();
  for (const Tile& tile : samples.tiles) lightByEmitters(samples, tile);
}

}  // namespace lucerna::bake
