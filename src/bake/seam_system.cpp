#include "bake/seam_system.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace lucerna::bake {
namespace {

// Against the samples of a texel of seam, which count 1 together.
constexpr float kMeasured = 2e-3f, kUnmeasured = 5e-4f;

struct Tap {
  TexelPlace place;
  float weight = 0.f;
};

// As a GPU filters: texels' values are those of their middles, and a map's edge goes on.
std::array<Tap, 4> lookup(const SeamSide& side, float along, int mapSide) {
  const vec2 p = glm::mix(side.ends[0], side.ends[1], along) - 0.5f;
  const vec2 low = glm::floor(p), f = p - low;
  std::array<Tap, 4> taps;
  for (int i = 0; i < 4; ++i) {
    const ivec2 step(i % 2, i / 2);
    const ivec2 texel = glm::clamp(ivec2(low) + step, ivec2(0), ivec2(mapSide - 1));
    taps[static_cast<std::size_t>(i)] = {
        .place = {.map = static_cast<std::uint16_t>(side.map),
                  .x = static_cast<std::uint16_t>(texel.x),
                  .y = static_cast<std::uint16_t>(texel.y)},
        .weight = (step.x == 1 ? f.x : 1.f - f.x) * (step.y == 1 ? f.y : 1.f - f.y)};
  }
  return taps;
}

// Of each number the lowest that lookups connect it with (union by the lower number, with paths
// halved). texelsOf(point): the numbers that it reads.
template <typename TexelsOf>
std::vector<std::uint32_t> connected(std::size_t texels, std::span<const SeamPoint> points,
                                     const TexelsOf& texelsOf) {
  std::vector<std::uint32_t> roots(texels);
  std::iota(roots.begin(), roots.end(), 0u);
  const auto rootOf = [&](std::uint32_t i) {
    while (roots[i] != i) i = roots[i] = roots[roots[i]];
    return i;
  };
  for (const SeamPoint& point : points) {
    const std::array<std::uint32_t, 8> its = texelsOf(point);
    for (std::size_t i = 1; i < its.size(); ++i) {
      const auto [low, high] = std::minmax({rootOf(its[0]), rootOf(its[i])});
      roots[high] = low;
    }
  }
  for (std::uint32_t i = 0; i < texels; ++i) roots[i] = rootOf(i);
  return roots;
}

}  // namespace

TexelNumbers::TexelNumbers(std::size_t maps, int side)
    : side_(static_cast<std::size_t>(side)),
      wordsPerMap_((side_ * side_ + 63) / 64),
      words_(maps * wordsPerMap_, 0) {}

std::vector<TexelPlace> TexelNumbers::count() {
  std::vector<TexelPlace> places;
  before_.reserve(words_.size());
  for (std::size_t i = 0; i < words_.size(); ++i) {
    before_.push_back(static_cast<std::uint32_t>(places.size()));
    for (std::uint64_t left = words_[i]; left != 0; left &= left - 1) {
      const std::size_t texel = i % wordsPerMap_ * 64 + std::countr_zero(left);
      places.push_back({.map = static_cast<std::uint16_t>(i / wordsPerMap_),
                        .x = static_cast<std::uint16_t>(texel % side_),
                        .y = static_cast<std::uint16_t>(texel / side_)});
    }
  }
  return places;
}

std::uint32_t TexelNumbers::number(TexelPlace p) const {
  const std::uint64_t below = words_[word(p)] & ((std::uint64_t{1} << bit(p)) - 1);
  return before_[word(p)] + static_cast<std::uint32_t>(std::popcount(below));
}

SeamSystem::SeamSystem(std::vector<Seam> seams, std::vector<SeamPoint> points,
                       std::vector<SeamPoint> between, const MapTexels& texels)
    : side_(texels.side),
      seams_(std::move(seams)),
      points_(std::move(points)),
      between_(std::move(between)),
      numbers_(texels.touched.size(), texels.side) {
  for (const auto* list : {&points_, &between_})
    for (const SeamPoint& point : *list)
      for (const SeamSide& side : seams_[point.seam].sides)
        for (const Tap& tap : lookup(side, point.along, side_)) numbers_.mark(tap.place);
  places_ = numbers_.count();
  findParts();
  stiffness_.reserve(places_.size());
  for (const TexelPlace& place : places_)
    stiffness_.push_back(texels.has(place.map, {place.x, place.y}) ? kMeasured : kUnmeasured);
}

// Sorts unknowns and points by their part, which are in the order of their lowest texel.
void SeamSystem::findParts() {
  const std::size_t count = places_.size();
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0u);  // until there are parts, numbers are unknowns
  const auto texelsOf = [&](const SeamPoint& point) { return sampleAt(point).texels; };
  const std::vector<std::uint32_t> roots = connected(count, points_, texelsOf);
  std::vector<std::uint32_t> sorted = order_;  // numbers, part by part
  std::ranges::stable_sort(sorted, {}, [&](std::uint32_t i) { return roots[i]; });
  struct Rooted {
    std::uint32_t root;
    SeamPoint point;
  };
  std::vector<Rooted> rooted;
  rooted.reserve(points_.size());
  for (const SeamPoint& point : points_) rooted.push_back({roots[texelsOf(point)[0]], point});
  std::ranges::stable_sort(rooted, {}, &Rooted::root);
  std::ranges::transform(rooted, points_.begin(), &Rooted::point);
  std::uint32_t point = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t root = roots[sorted[i]];
    if (i == 0 || root != roots[sorted[i - 1]]) {
      SeamPart& part = parts_.emplace_back(SeamPart{.firstTexel = i, .firstPoint = point});
      for (; point < rooted.size() && rooted[point].root == root; ++point) ++part.points;
    }
    ++parts_.back().texels;
  }
  std::vector<TexelPlace> places;
  places.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    places.push_back(places_[sorted[i]]);
    order_[sorted[i]] = i;
  }
  places_ = std::move(places);
}

std::uint32_t SeamSystem::unknownAt(TexelPlace place) const {
  return numbers_.isMarked(place) ? order_[numbers_.number(place)] : kNone;
}

std::uint32_t SeamSystem::partOf(std::uint32_t unknown) const {
  const auto after = std::ranges::upper_bound(parts_, unknown, {}, &SeamPart::firstTexel);
  return static_cast<std::uint32_t>(after - parts_.begin() - 1);
}

SeamSample SeamSystem::sampleAt(const SeamPoint& point) const {
  SeamSample sample{.share = point.share};
  std::size_t at = 0;
  for (const SeamSide& side : seams_[point.seam].sides)
    for (const Tap& tap : lookup(side, point.along, side_)) {
      sample.texels[at] = order_[numbers_.number(tap.place)];
      sample.weights[at] = at < 4 ? tap.weight : -tap.weight;
      ++at;
    }
  return sample;
}

std::vector<SeamSample> SeamSystem::samplesOf(const SeamPart& part) const {
  std::vector<SeamSample> samples;
  samples.reserve(part.points);
  for (const SeamPoint& point : std::span(points_).subspan(part.firstPoint, part.points))
    samples.push_back(sampleAt(point));
  return samples;
}

}  // namespace lucerna::bake
