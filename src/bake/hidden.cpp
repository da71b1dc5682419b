#include "bake/hidden.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "trace/light_sampling.hpp"

namespace lucerna::bake {
namespace {

using Tile = Samples::Tile;

constexpr std::size_t kRays = 5;
using Directions = std::array<vec3, kRays>;
// Of them that tell of a solid around: one may slip through an edge, or out of what is open.
constexpr std::size_t kEnough = 4;

// Around +z, none of them along it or along an axis of the scene's, where rays meet edges.
Directions directionsAroundZ() {
  Directions directions{vec3(0.05f, 0.03f, 1.f)};
  for (std::size_t i = 1; i < kRays; ++i) {
    const float angle = 0.3f + 0.5f * kPi * static_cast<float>(i - 1);
    directions[i] = {std::cos(angle), std::sin(angle), 0.9f};
  }
  return directions;
}

// Those that lead up the most come first, as they meet the least.
Directions directionsAround(vec3 normal) {
  static const Directions aroundZ = directionsAroundZ();
  const trace::Frame frame(normal);
  Directions directions;
  for (std::size_t i = 0; i < kRays; ++i) directions[i] = glm::normalize(frame.toWorld(aroundZ[i]));
  std::ranges::stable_sort(directions, std::ranges::greater{}, &vec3::y);
  return directions;
}

vec3 positionAt(const Samples& s, std::size_t i) {
  return {s.x[i], s.y[i], s.z[i]};
}

// A thin box around the tile's samples: what crosses it may cover some of them.
Aabb around(const Tile& tile, float texel) {
  // Half a texel to each side, as a texel reaches beyond its sample.
  return {tile.boundsW.min - 0.71f * texel, tile.boundsW.max + 0.71f * texel};
}

// Keeps the entries whose bit is not set.
template <typename T>
void removeWhere(std::vector<T>& list, const std::vector<bool>& gone) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!gone[i]) list[kept++] = list[i];
  list.resize(kept);
}

void removeWhere(Samples& s, const std::vector<bool>& gone) {
  for (auto* list : {&s.x, &s.y, &s.z, &s.nx, &s.ny, &s.nz, &s.areas}) removeWhere(*list, gone);
  removeWhere(s.texels, gone);
  removeWhere(s.places, gone);
  removeWhere(s.triangles, gone);
  removeWhere(s.barycentrics, gone);
  std::uint32_t before = 0;  // of the samples so far, that are gone
  std::vector<Tile> tiles;
  for (Tile tile : s.tiles) {
    const auto first = gone.begin() + tile.first;
    const auto count = static_cast<std::uint32_t>(std::count(first, first + tile.count, true));
    tile.first -= before;
    tile.count -= count;
    before += count;
    if (tile.count > 0) tiles.push_back(tile);
  }
  s.tiles = std::move(tiles);
}

}  // namespace

HiddenSamples::HiddenSamples(const trace::RayScene& rays, const Occluders& occluders,
                             const std::vector<std::uint32_t>& chartOf)
    : rays_(rays), occluders_(occluders), chartOf_(chartOf) {}

// Sets hidden_ of these samples. Direction after direction, so that the rays of a packet go
// together, and of those that are not sure yet.
void HiddenSamples::ask(const Samples& samples, std::span<const std::uint32_t> which) {
  open_.clear();
  directions_.clear();
  if (samples.planar) directions_.push_back(directionsAround(samples.axis));
  for (const std::uint32_t i : which) {
    if (!samples.planar)
      directions_.push_back(directionsAround({samples.nx[i], samples.ny[i], samples.nz[i]}));
    open_.push_back({.sample = i, .directions = directions_.size() - 1});
  }
  for (std::size_t round = 0; round < kRays && !open_.empty(); ++round) {
    asked_.clear();
    for (const Open& o : open_)
      asked_.push_back({.originW = positionAt(samples, o.sample),
                        .directionW = directions_[o.directions][round]});
    counts_.resize(asked_.size());
    rays_.solidsAround(asked_, counts_);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      Open& o = open_[k];
      ++(counts_[k] > 0 ? o.inside : o.outside);
      if (o.inside == kEnough) hidden_[o.sample] = true;
      if (o.inside < kEnough && o.outside <= kRays - kEnough) open_[kept++] = o;
    }
    open_.resize(kept);
  }
}

// Of each texel of the tile: what is left and does not see the one of them next to the middle.
void HiddenSamples::separate(const Samples& samples, const Tile& tile) {
  which_.clear();
  asked_.clear();
  for (std::uint32_t i = tile.first; i < tile.first + tile.count;) {
    const std::uint32_t first = i;
    vec3 middle(0.f);
    for (; i < tile.first + tile.count && samples.texels[i] == samples.texels[first]; ++i)
      middle += positionAt(samples, i);
    middle /= static_cast<float>(i - first);
    std::uint32_t nearest = scene::kNone;
    const auto distance = [&](std::uint32_t k) {
      return glm::distance(positionAt(samples, k), middle);
    };
    for (std::uint32_t k = first; k < i; ++k)
      if (!hidden_[k] && (nearest == scene::kNone || distance(k) < distance(nearest))) nearest = k;
    for (std::uint32_t k = first; k < i; ++k) {
      if (hidden_[k] || k == nearest) continue;
      const vec3 from = positionAt(samples, nearest);
      which_.push_back(k);
      asked_.push_back({.originW = from, .directionW = positionAt(samples, k) - from, .far = 1.f});
    }
  }
  if (which_.empty()) return;
  shares_.resize(asked_.size());
  rays_.transmittance(asked_, shares_);
  for (std::size_t k = 0; k < which_.size(); ++k)
    if (shares_[k] == vec3(0.f)) hidden_[which_[k]] = true;
}

void HiddenSamples::remove(Samples& samples, std::uint32_t chart) {
  if (samples.size() == 0) return;
  hidden_.assign(samples.size(), false);
  const auto isCrossed = [&](const Tile& tile) {
    return occluders_.anyIn(slabAround(samples, tile, around(tile, samples.texelSize)),
                            [&](std::uint32_t triangle) {
                              // Of a planar block's own triangles the slab is clear.
                              return samples.planar || chartOf_[triangle] != chart;
                            });
  };
  // Where nothing crosses the surface, all samples are as the first is.
  crossed_.clear();
  which_.clear();
  const Tile all{
      .first = 0, .count = static_cast<std::uint32_t>(samples.size()), .boundsW = samples.boundsW};
  const bool anyCrossed = isCrossed(all);
  if (!anyCrossed) which_.push_back(0);
  if (anyCrossed)
    for (const Tile& tile : samples.tiles) {
      const bool crossed = isCrossed(tile);
      if (crossed) crossed_.push_back(tile);
      for (std::uint32_t i = 0; i < (crossed ? tile.count : 1); ++i)
        which_.push_back(tile.first + i);
    }
  ask(samples, which_);
  const auto spread = [&](const Tile& tile) {
    if (hidden_[tile.first]) std::fill_n(hidden_.begin() + tile.first, tile.count, true);
  };
  if (!anyCrossed) spread(all);
  std::size_t next = 0;  // of crossed_
  if (anyCrossed)
    for (const Tile& tile : samples.tiles) {
      const bool crossed = next < crossed_.size() && crossed_[next].first == tile.first;
      if (crossed)
        separate(samples, crossed_[next++]);
      else
        spread(tile);
    }
  if (std::ranges::find(hidden_, true) != hidden_.end()) removeWhere(samples, hidden_);
}

std::vector<std::uint32_t> chartsOfTriangles(const Plan& plan) {
  std::vector<std::uint32_t> charts(plan.world.triangleCount(), scene::kNone);
  for (std::uint32_t i = 0; i < plan.charts.charts.size(); ++i) {
    const Chart& chart = plan.charts.charts[i];
    const std::uint32_t first = plan.world.objects[chart.object].firstTriangle;
    for (const std::uint32_t triangle : chart.triangles) charts[first + triangle] = i;
  }
  return charts;
}

}  // namespace lucerna::bake
