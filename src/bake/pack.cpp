#include "bake/pack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>

#include "core/text.hpp"

namespace lucerna::bake {
namespace {

// Where the free part of a map begins, from left to right.
struct Step {
  int x, y, width;
};

struct Spot {
  std::size_t step = 0;  // on whose left edge the rectangle stands
  int y = 0;
  std::int64_t waste = 0;  // texels that end up below it
  bool turned = false;

  int top(ivec2 size) const { return y + (turned ? size.x : size.y); }
};

class Skyline {
 public:
  explicit Skyline(int side) : side_(side), steps_{{0, 0, side}} {}

  // The lowest top, of those the least waste, of those the one farthest to the left.
  std::optional<Spot> find(ivec2 size) {
    if (hopeless(size)) return std::nullopt;
    std::optional<Spot> best;
    for (std::size_t step = 0; step < steps_.size(); ++step)
      for (const bool turned : {false, true}) {
        if (turned && size.x == size.y) continue;
        const int height = turned ? size.x : size.y;
        if (best && steps_[step].y + height > best->top(size)) continue;
        const auto spot = at(step, turned ? ivec2(size.y, size.x) : size);
        if (!spot) continue;
        const Spot candidate{step, spot->y, spot->waste, turned};
        if (!best || candidate.top(size) < best->top(size) ||
            (candidate.top(size) == best->top(size) && candidate.waste < best->waste))
          best = candidate;
      }
    if (!best) fail(size);
    return best;
  }

  ivec2 place(const Spot& spot, ivec2 size) {
    if (spot.turned) std::swap(size.x, size.y);
    const int x = steps_[spot.step].x, right = x + size.x;
    std::size_t end = spot.step;  // past the steps that are covered
    while (end < steps_.size() && steps_[end].x + steps_[end].width <= right) ++end;
    if (end < steps_.size() && steps_[end].x < right) {
      steps_[end].width -= right - steps_[end].x;
      steps_[end].x = right;
    }
    const auto first = steps_.begin() + static_cast<std::ptrdiff_t>(spot.step);
    steps_.erase(first, steps_.begin() + static_cast<std::ptrdiff_t>(end));
    steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(spot.step),
                  {x, spot.y + size.y, size.x});
    joinLevel();
    return {x, spot.y};
  }

 private:
  struct Fit {
    int y;
    std::int64_t waste;
  };
  std::optional<Fit> at(std::size_t step, ivec2 size) const {
    if (steps_[step].x + size.x > side_) return std::nullopt;
    int y = 0;
    std::size_t end = step;
    for (int covered = 0; covered < size.x; ++end) {
      y = std::max(y, steps_[end].y);
      if (y + size.y > side_) return std::nullopt;
      covered += steps_[end].width;
    }
    std::int64_t waste = 0;
    int left = size.x;
    for (std::size_t i = step; i < end; ++i) {
      const int width = std::min(left, steps_[i].width);
      waste += std::int64_t{width} * (y - steps_[i].y);
      left -= width;
    }
    return Fit{y, waste};
  }

  static ivec2 shorterFirst(ivec2 size) {
    return {std::min(size.x, size.y), std::max(size.x, size.y)};
  }

  // What is no smaller than something that found no place finds none: steps only rise.
  bool hopeless(ivec2 size) const {
    const ivec2 sorted = shorterFirst(size);
    return std::ranges::any_of(
        failed_, [&](ivec2 failed) { return sorted.x >= failed.x && sorted.y >= failed.y; });
  }

  void fail(ivec2 size) {
    const ivec2 sorted = shorterFirst(size);
    std::erase_if(failed_,
                  [&](ivec2 failed) { return failed.x >= sorted.x && failed.y >= sorted.y; });
    failed_.push_back(sorted);
  }

  void joinLevel() {
    std::size_t kept = 0;
    for (std::size_t i = 1; i < steps_.size(); ++i)
      if (steps_[i].y == steps_[kept].y)
        steps_[kept].width += steps_[i].width;
      else
        steps_[++kept] = steps_[i];
    steps_.resize(kept + 1);
  }

  int side_;
  std::vector<Step> steps_;
  std::vector<ivec2> failed_;  // the smallest that found no place, shorter side first
};

// Longer sides first, then longer shorter ones: what is wide finds a level ground.
std::vector<std::uint32_t> packingOrder(std::span<const ivec2> sizes) {
  std::vector<std::uint32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const ivec2 p = sizes[a], q = sizes[b];
    return std::pair(std::max(p.x, p.y), std::min(p.x, p.y)) >
           std::pair(std::max(q.x, q.y), std::min(q.x, q.y));
  });
  return order;
}

// With their gaps.
double texelsOf(std::span<const ivec2> sizes, int gap) {
  double texels = 0;
  for (const ivec2 size : sizes)
    texels += (static_cast<double>(size.x) + gap) * (static_cast<double>(size.y) + gap);
  return texels;
}

}  // namespace

ivec2 placedSize(const Place& place, ivec2 size) {
  return place.turned ? ivec2(size.y, size.x) : size;
}

vec2 placedPoint(const Place& place, ivec2 size, vec2 point) {
  if (place.turned) point = vec2(static_cast<float>(size.y) - point.y, point.x);
  if (place.reversed) point = vec2(placedSize(place, size)) - point;
  return vec2(place.corner) + point;
}

Status eachFits(std::span<const ivec2> sizes, const PackSettings& settings) {
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (const int longest = std::max(sizes[i].x, sizes[i].y); longest > settings.side)
      return error(
          ErrorKind::Input,
          "chart {} has {} x {} texels, more than a map of {} x {}; a texel density of {:.3g} of "
          "this one makes it fit, or larger maps do",
          i, sizes[i].x, sizes[i].y, settings.side, settings.side,
          static_cast<double>(settings.side) / longest);
  return {};
}

Error tooManyMaps(std::size_t charts, double texels, const PackSettings& settings) {
  constexpr double kFilled = 0.95;  // of the maps, about, gaps counted
  const double side = settings.side + settings.gap;
  const double needed = std::clamp(std::ceil(texels / (kFilled * side * side)),
                                   settings.mostMaps + 1., static_cast<double>(charts));
  return error(ErrorKind::Usage,
               "{} need about {:.0f} maps of {} x {} texels, and --most-maps allows {}",
               counted(charts, "chart"), needed, settings.side, settings.side, settings.mostMaps);
}

Result<Packing> pack(std::span<const ivec2> sizes, const PackSettings& settings) {
  LUCERNA_TRY_VOID(eachFits(sizes, settings));
  Packing packing;
  packing.places.resize(sizes.size());
  std::vector<Skyline> maps;
  for (const std::uint32_t index : packingOrder(sizes)) {
    const ivec2 size = sizes[index] + settings.gap;
    std::optional<Spot> spot;
    std::size_t map = 0;
    for (; map < maps.size() && !spot; ++map) spot = maps[map].find(size);
    if (spot) {
      --map;
    } else {
      if (static_cast<int>(maps.size()) == settings.mostMaps)
        return tooManyMaps(sizes.size(), texelsOf(sizes, settings.gap), settings);
      maps.emplace_back(settings.side + settings.gap);
      spot = maps[map].find(size);
    }
    packing.places[index] = {.map = static_cast<int>(map),
                             .corner = maps[map].place(*spot, size),
                             .turned = spot->turned};
  }
  packing.maps = static_cast<int>(maps.size());
  return packing;
}

double occupancy(const Packing& packing, std::span<const ivec2> sizes, int side) {
  const int counted = std::max(packing.maps - 1, 1);
  std::int64_t covered = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (packing.places[i].map < counted) covered += std::int64_t{sizes[i].x} * sizes[i].y;
  return static_cast<double>(covered) / (static_cast<double>(counted) * side * side);
}

}  // namespace lucerna::bake
