#include "bake/seam_system.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/check.hpp"

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

// Numbers of marked texels by map, row and column.
class TexelNumbers {
 public:
  TexelNumbers(std::size_t maps, int side)
      : side_(static_cast<std::size_t>(side)),
        wordsPerMap_((side_ * side_ + 63) / 64),
        words_(maps * wordsPerMap_, 0) {}

  void mark(TexelPlace p) { words_[word(p)] |= std::uint64_t{1} << bit(p); }

  // After the last mark.
  std::vector<TexelPlace> count() {
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

  std::uint32_t number(TexelPlace p) const {
    const std::uint64_t below = words_[word(p)] & ((std::uint64_t{1} << bit(p)) - 1);
    return before_[word(p)] + static_cast<std::uint32_t>(std::popcount(below));
  }

 private:
  std::size_t texel(TexelPlace p) const { return p.y * side_ + p.x; }
  std::size_t word(TexelPlace p) const { return p.map * wordsPerMap_ + texel(p) / 64; }
  std::size_t bit(TexelPlace p) const { return texel(p) % 64; }

  std::size_t side_, wordsPerMap_;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> before_;  // of each word: how many are marked in earlier ones
};

std::vector<SeamSample> samplesOf(std::span<const Seam> seams, std::span<const SeamPoint> points,
                                  const TexelNumbers& numbers, int mapSide) {
  std::vector<SeamSample> samples;
  samples.reserve(points.size());
  for (const SeamPoint& point : points) {
    SeamSample& sample = samples.emplace_back();
    sample.share = point.share;
    std::size_t at = 0;
    for (const SeamSide& side : seams[point.seam].sides)
      for (const Tap& tap : lookup(side, point.along, mapSide)) {
        sample.texels[at] = numbers.number(tap.place);
        sample.weights[at] = at < 4 ? tap.weight : -tap.weight;
        ++at;
      }
  }
  return samples;
}

// Of each texel the lowest that samples connect it with (union by the lower number, with paths
// halved).
std::vector<std::uint32_t> connected(std::size_t texels, std::span<const SeamSample> samples) {
  std::vector<std::uint32_t> roots(texels);
  std::iota(roots.begin(), roots.end(), 0u);
  const auto rootOf = [&](std::uint32_t i) {
    while (roots[i] != i) i = roots[i] = roots[roots[i]];
    return i;
  };
  for (const SeamSample& sample : samples)
    for (std::size_t i = 1; i < sample.texels.size(); ++i) {
      const auto [low, high] = std::minmax({rootOf(sample.texels[0]), rootOf(sample.texels[i])});
      roots[high] = low;
    }
  for (std::uint32_t i = 0; i < texels; ++i) roots[i] = rootOf(i);
  return roots;
}

// Sorts texels and samples by their part, which are in the order of their lowest texel.
void part(SeamSystem& system) {
  const std::size_t count = system.places.size();
  const std::vector<std::uint32_t> roots = connected(count, system.samples);
  std::vector<std::uint32_t> sorted(count);  // numbers, part by part
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::ranges::stable_sort(sorted, {}, [&](std::uint32_t i) { return roots[i]; });
  system.order.resize(count);
  std::vector<TexelPlace> places;
  std::vector<std::uint32_t> partOf(count);  // of each number
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t number = sorted[i];
    if (i == 0 || roots[number] != roots[sorted[i - 1]]) system.parts.push_back({.firstTexel = i});
    ++system.parts.back().texels;
    system.order[number] = i;
    partOf[number] = static_cast<std::uint32_t>(system.parts.size() - 1);
    places.push_back(system.places[number]);
  }
  system.places = std::move(places);

  const auto ofPart = [&](const SeamSample& sample) { return partOf[sample.texels[0]]; };
  std::ranges::stable_sort(system.samples, {}, ofPart);
  for (std::uint32_t i = 0; i < system.samples.size(); ++i) {
    SeamPart& its = system.parts[ofPart(system.samples[i])];
    if (its.samples++ == 0) its.firstSample = i;
  }
  for (auto* list : {&system.samples, &system.measuring})
    for (SeamSample& sample : *list)
      for (std::uint32_t& texel : sample.texels) texel = system.order[texel];
}

}  // namespace

SeamSystem seamSystem(std::span<const Seam> seams, std::span<const SeamPoint> points,
                      std::span<const SeamPoint> between, const MapTexels& texels) {
  TexelNumbers numbers(texels.touched.size(), texels.side);
  for (const auto list : {points, between})
    for (const SeamPoint& point : list)
      for (const SeamSide& side : seams[point.seam].sides)
        for (const Tap& tap : lookup(side, point.along, texels.side)) numbers.mark(tap.place);
  SeamSystem system;
  system.places = numbers.count();
  system.samples = samplesOf(seams, points, numbers, texels.side);
  system.measuring = samplesOf(seams, between, numbers, texels.side);
  part(system);
  for (const TexelPlace& place : system.places)
    system.stiffness.push_back(texels.has(place.map, {place.x, place.y}) ? kMeasured : kUnmeasured);
  return system;
}

}  // namespace lucerna::bake
