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

// Around +z, `along` times as far along it as off it. None of them leads along it or along an axis
// of the scene's, where rays meet edges.
Directions directionsAroundZ(float along) {
  Directions directions{glm::normalize(vec3(0.05f, 0.03f, 1.f))};
  for (std::size_t i = 1; i < kRays; ++i) {
    const float angle = 0.3f + 0.5f * kPi * static_cast<float>(i - 1);
    directions[i] = glm::normalize(vec3(std::cos(angle), std::sin(angle), along));
  }
  return directions;
}
const Directions kWide = directionsAroundZ(0.9f), kNarrow = directionsAroundZ(2.f);

Directions around(vec3 axis, Directions directions) {
  const trace::Frame frame(axis);
  for (vec3& direction : directions) direction = frame.toWorld(direction);
  return directions;
}

// All of them lead up unless the surface faces down a good deal: below many a solid lies the front
// of an open sheet, a floor, that it stands on or in. Those that lead up the most come first, as
// they meet the least.
Directions directionsFrom(vec3 normal) {
  const bool wide = normal.y > 0.75f || normal.y < -0.5f;
  Directions directions =
      wide ? around(normal, kWide) : around(glm::normalize(normal + vec3(0.f, 1.f, 0.f)), kNarrow);
  std::ranges::stable_sort(directions, std::ranges::greater{}, &vec3::y);
  return directions;
}

vec3 positionAt(const Samples& s, std::size_t i) {
  return {s.x[i], s.y[i], s.z[i]};
}

// Calls what(first, end) for the samples of each of the tile's texels.
template <typename What>
void forTexels(const Samples& samples, const Tile& tile, const What& what) {
  for (std::uint32_t i = tile.first; i < tile.first + tile.count;) {
    const std::uint32_t first = i;
    while (i < tile.first + tile.count && samples.texels[i] == samples.texels[first]) ++i;
    what(first, i);
  }
}

// A thin box around the tile's samples: what crosses it may cover some of them.
Aabb boxAround(const Tile& tile, float texel) {
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

HiddenSamples::HiddenSamples(const Plan& plan, const trace::RayScene& rays,
                             const Occluders& occluders, const SurfaceParts& parts)
    : plan_(plan), rays_(rays), occluders_(occluders), parts_(parts) {}

// Sets hidden_ of these samples. Direction after direction, so that the rays of a packet go
// together, and of those that are not sure yet.
void HiddenSamples::ask(const Samples& samples, std::span<const std::uint32_t> which) {
  open_.clear();
  directions_.clear();
  if (samples.planar) directions_.push_back(directionsFrom(samples.axis));
  for (const std::uint32_t i : which) {
    if (!samples.planar)
      directions_.push_back(directionsFrom({samples.nx[i], samples.ny[i], samples.nz[i]}));
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

// Of a texel's samples that are not hidden; scene::kNone if all are.
std::uint32_t HiddenSamples::nextToMiddle(const Samples& samples, std::uint32_t first,
                                          std::uint32_t end) const {
  vec3 middle(0.f);
  for (std::uint32_t i = first; i < end; ++i) middle += positionAt(samples, i);
  middle /= static_cast<float>(end - first);
  std::uint32_t nearest = scene::kNone;
  const auto distance = [&](std::uint32_t k) {
    return glm::distance(positionAt(samples, k), middle);
  };
  for (std::uint32_t k = first; k < end; ++k)
    if (!hidden_[k] && (nearest == scene::kNone || distance(k) < distance(nearest))) nearest = k;
  return nearest;
}

// Of each texel of the tile: what is left and does not see the one of them next to the middle.
void HiddenSamples::separate(const Samples& samples, const Tile& tile) {
  which_.clear();
  asked_.clear();
  forTexels(samples, tile, [&](std::uint32_t first, std::uint32_t end) {
    const std::uint32_t nearest = nextToMiddle(samples, first, end);
    for (std::uint32_t k = first; k < end; ++k) {
      if (hidden_[k] || k == nearest) continue;
      const vec3 from = positionAt(samples, nearest);
      which_.push_back(k);
      asked_.push_back({.originW = from, .directionW = positionAt(samples, k) - from, .far = 1.f});
    }
  });
  if (which_.empty()) return;
  shares_.resize(asked_.size());
  rays_.transmittance(asked_, shares_);
  for (std::size_t k = 0; k < which_.size(); ++k)
    if (shares_[k] == vec3(0.f)) hidden_[which_[k]] = true;
}

// Of the tile's triangles the parts and, of a mesh's own chart, the places of their corners.
void HiddenSamples::findSurface(const Samples& samples, const Chart& chart, const Tile& tile) {
  const auto sort = [](std::vector<std::uint32_t>& list) {
    std::ranges::sort(list);
    const auto again = std::ranges::unique(list);
    list.erase(again.begin(), again.end());
  };
  partsBelow_.clear();
  placesBelow_.clear();
  if (samples.planar) return;
  const std::uint32_t first = plan_.world.objects[chart.object].firstTriangle;
  std::uint32_t last = scene::kNone;
  for (std::uint32_t i = tile.first; i < tile.first + tile.count; ++i) {
    const std::uint32_t triangle = first + chart.triangles[samples.triangles[i]];
    if (triangle == last) continue;
    last = triangle;
    partsBelow_.push_back(parts_.of[triangle]);
    if (!chart.own) break;
    for (std::uint32_t k = 0; k < 3; ++k)
      placesBelow_.push_back(parts_.places[plan_.world.indices[3 * triangle + k]]);
  }
  sort(partsBelow_);
  sort(placesBelow_);
}

// Whether anything crosses the surface below the tile: nothing that it is a part of or meets at a
// corner. Of a planar block's own triangles the slab is clear.
bool HiddenSamples::isCrossed(const Samples& samples, const Chart& chart, const Tile& tile) {
  findSurface(samples, chart, tile);
  const auto isBelow = [](const std::vector<std::uint32_t>& list, std::uint32_t number) {
    return std::ranges::binary_search(list, number);
  };
  return occluders_.anyIn(
      slabAround(samples, tile, boxAround(tile, samples.texelSize)), [&](std::uint32_t triangle) {
        if (samples.planar) return true;
        if (isBelow(partsBelow_, parts_.of[triangle])) return false;
        const std::uint32_t* corners = &plan_.world.indices[3 * std::size_t{triangle}];
        return placesBelow_.empty() || std::none_of(corners, corners + 3, [&](std::uint32_t k) {
                 return isBelow(placesBelow_, parts_.places[k]);
               });
      });
}

void HiddenSamples::remove(Samples& samples, std::uint32_t index) {
  if (samples.size() == 0) return;
  const Chart& chart = plan_.charts.charts[index];
  hidden_.assign(samples.size(), false);
  crossed_.clear();
  alike_.clear();
  which_.clear();
  // Where nothing crosses one surface, all samples are as the first is.
  const Tile all{
      .first = 0, .count = static_cast<std::uint32_t>(samples.size()), .boundsW = samples.boundsW};
  const bool anyCrossed = isCrossed(samples, chart, all) || partsBelow_.size() > 1;
  for (const Tile& tile : anyCrossed ? std::span<const Tile>(samples.tiles) : std::span(&all, 1)) {
    const bool crossed = anyCrossed && isCrossed(samples, chart, tile);
    const bool alike = !crossed && partsBelow_.size() <= 1;
    if (crossed) crossed_.push_back(tile);
    if (alike) alike_.push_back(tile);
    for (std::uint32_t i = 0; i < (alike ? 1 : tile.count); ++i) which_.push_back(tile.first + i);
  }
  ask(samples, which_);
  for (const Tile& tile : alike_)
    if (hidden_[tile.first]) std::fill_n(hidden_.begin() + tile.first, tile.count, true);
  for (const Tile& tile : crossed_) separate(samples, tile);
  if (std::ranges::find(hidden_, true) != hidden_.end()) removeWhere(samples, hidden_);
}

void HiddenSamples::removeBesideOpen(Samples& samples, std::uint32_t index) {
  const Chart& chart = plan_.charts.charts[index];
  hidden_.assign(samples.size(), false);
  crossed_.clear();
  which_.clear();
  for (const Tile& tile : samples.tiles) {
    if (!isCrossed(samples, chart, tile)) continue;
    crossed_.push_back(tile);
    forTexels(samples, tile, [&](std::uint32_t first, std::uint32_t end) {
      which_.push_back(nextToMiddle(samples, first, end));
    });
  }
  ask(samples, which_);
  for (const Tile& tile : crossed_) {
    forTexels(samples, tile, [&](std::uint32_t first, std::uint32_t end) {
      const auto begin = hidden_.begin();
      if (std::find(begin + first, begin + end, true) != begin + end)
        std::fill(begin + first, begin + end, true);
    });
    separate(samples, tile);
  }
  if (std::ranges::find(hidden_, true) != hidden_.end()) removeWhere(samples, hidden_);
}

std::vector<bool> insideSolids(const trace::RayScene& rays, std::span<const vec3> placesW) {
  std::vector<bool> inside(placesW.size(), true);
  std::vector<trace::Ray> asked;
  std::vector<int> counts;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      vec3 n(0.f);
      n[axis] = side;
      asked.clear();
      for (const vec3 place : placesW)
        for (const vec3 direction : around(n, kWide))
          asked.push_back({.originW = place, .directionW = direction});
      counts.resize(asked.size());
      rays.solidsAround(asked, counts);
      for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] <= 0) inside[i / kRays] = false;
    }
  return inside;
}

}  // namespace lucerna::bake
