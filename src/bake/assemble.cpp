#include "bake/assemble.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace lucerna::bake {
namespace {

using lightmap::HalfTiles;
using Rgb = std::array<std::uint16_t, 3>;

// step: between red, green and blue.
vec3 colorOf(const std::uint16_t* red, std::size_t step) {
  return {floatFromHalf(red[0]), floatFromHalf(red[step]), floatFromHalf(red[2 * step])};
}
Rgb halves(vec3 v) {
  return {halfFromFloat(v.x), halfFromFloat(v.y), halfFromFloat(v.z)};
}

// Those that share a side first.
constexpr std::array<ivec2, 8> kAround{ivec2(0, -1),  ivec2(-1, 0), ivec2(1, 0),  ivec2(0, 1),
                                       ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 1), ivec2(1, 1)};
constexpr std::size_t kSides = 4;

// The texels whose light one is filled with that the scene does not touch: those beside it, or else
// those at its corners, so that what ends at a chart's side goes on straight. Of hidden texels all.
class Donors {
 public:
  Donors(const MapTexels& texels, int map, ivec2 p) : hidden_(texels.isHidden(map, p)) {
    for (std::size_t i = 0; i < kAround.size(); ++i) {
      if (i == kSides && count_ > 0 && !hidden_) break;
      if (texels.has(map, p + kAround[i])) steps_[count_++] = kAround[i];
    }
  }
  std::span<const ivec2> steps() const { return {steps_.data(), count_}; }

  // The mean of what `colorAt` says of them or, of hidden texels, the darkest.
  template <typename ColorAt>
  vec3 light(const ColorAt& colorAt) const {
    vec3 sum(0.f), least(std::numeric_limits<float>::infinity());
    for (const ivec2 step : steps()) {
      const vec3 color = colorAt(step);
      sum += color;
      least = glm::min(least, color);
    }
    return hidden_ ? least : sum / static_cast<float>(count_);
  }

 private:
  bool hidden_;
  std::array<ivec2, 8> steps_{};
  std::size_t count_ = 0;
};

void dilateMap(Image& image, const MapTexels& texels, int map) {
  for (int y = 0; y < texels.side; ++y)
    for (int x = 0; x < texels.side; ++x) {
      if (texels.has(map, {x, y})) continue;
      const Donors donors(texels, map, {x, y});
      if (donors.steps().empty()) continue;
      const vec3 light = donors.light([&](ivec2 step) {
        return colorOf(image.pixel<std::uint16_t>(x + step.x, y + step.y), 1);
      });
      std::ranges::copy(halves(light), image.pixel<std::uint16_t>(x, y));
    }
}

void put(HalfTiles& group, int map, ivec2 p, const Rgb& rgb) {
  std::uint16_t* to = group.add(static_cast<std::uint16_t>(map), p.x, p.y);
  for (std::size_t c = 0; c < 3; ++c) to[c * lightmap::kTileTexels] = rgb[c];
}

// What of it is beside its lit texels and not touched by the scene.
struct Beside {
  std::uint16_t map;
  ivec2 p;
  Rgb rgb;
};
std::vector<Beside> besideLit(HalfTiles& group, const MapTexels& texels) {
  HalfTiles seen(1);
  std::vector<Beside> found;
  for (std::size_t slot = 0; slot < group.tiles().size(); ++slot)
    group.forTexelsOf(slot, [&](std::uint16_t map, int x, int y, const std::uint16_t*) {
      for (const ivec2 step : kAround) {
        const ivec2 p = ivec2(x, y) + step;
        const bool within = p.x >= 0 && p.y >= 0 && p.x < texels.side && p.y < texels.side;
        if (!within || texels.has(map, p) || seen.find(map, p.x, p.y)) continue;
        seen.add(map, p.x, p.y);
        found.push_back({map, p, {}});
      }
    });
  return found;
}

// The light of one group spreads into the same texels by the same rule.
void dilateGroup(HalfTiles& group, const MapTexels& texels) {
  std::vector<Beside> filled = besideLit(group, texels);
  for (Beside& beside : filled)
    beside.rgb = halves(Donors(texels, beside.map, beside.p).light([&](ivec2 step) {
      const ivec2 from = beside.p + step;
      const std::uint16_t* red = group.find(beside.map, from.x, from.y);
      return red ? colorOf(red, lightmap::kTileTexels) : vec3(0.f);
    }));
  for (const Beside& beside : filled)
    if (beside.rgb != Rgb{}) put(group, beside.map, beside.p, beside.rgb);
}

// Whether the texel is one that the chart was packed by. What it touches by less may be another's.
bool isOf(const Plan& plan, std::uint32_t chart, ivec2 texel) {
  const TexelMask& mask = plan.packed.masks[chart];
  const ivec2 p = texel - ivec2(plan.packed.least[chart]);
  return p.x >= 0 && p.y >= 0 && p.x < mask.size().x && p.y < mask.size().y && mask.at(p.x, p.y);
}

}  // namespace

bool MapTexels::isBeside(int map, ivec2 p) const {
  return !has(map, p) &&
         std::ranges::any_of(kAround, [&](ivec2 step) { return has(map, p + step); });
}

std::uint64_t mostGroupBytes(const Plan& plan) {
  constexpr std::uint64_t kEach = 3, kLittle = 32 << 20;  // a texel of the maps; at least
  const auto side = static_cast<std::uint64_t>(plan.settings.pack.side);
  const auto maps = static_cast<std::uint64_t>(plan.packed.packing.maps);
  return std::max(kEach * side * side * maps, kLittle);
}

BakedLight emptyLight(const Plan& plan) {
  BakedLight baked;
  const int side = plan.settings.pack.side;
  const auto count = static_cast<std::size_t>(plan.packed.packing.maps);
  baked.texels.side = side;
  for (auto* list : {&baked.texels.touched, &baked.texels.hidden})
    list->assign(count, std::vector<bool>(static_cast<std::size_t>(side) * side));
  for (std::size_t i = 0; i < count; ++i)
    baked.maps.emplace_back(side, side, 3, ComponentType::Half);
  baked.groups.resize(plan.groups.size(), HalfTiles(3));
  return baked;
}

void putInMaps(BakedLight& baked, const Plan& plan, const Unit& unit, const UnitLight& light,
               const GroupRange& groups) {
  for (std::uint32_t b = 0; b < unit.blocks; ++b) {
    const Block& block = plan.blocks[unit.firstBlock + b];
    const BlockLight& blockLight = light.blocks[b];
    const int map = plan.packed.packing.places[block.chart].map;
    std::size_t at = 0;
    for (int y = 0; y < block.size.y; ++y)
      for (int x = 0; x < block.size.x; ++x) {
        const auto index = static_cast<std::size_t>(y) * block.size.x + x;
        const ivec2 texel = block.corner + ivec2(x, y);
        const bool touched = hasBit(blockLight.touched, index);
        if (!isOf(plan, block.chart, texel)) {
          if (touched) at += 3;
          continue;
        }
        const ivec2 p = placed(plan, block.chart, texel);
        const std::size_t place = static_cast<std::size_t>(p.y) * baked.texels.side + p.x;
        baked.texels.touched[static_cast<std::size_t>(map)][place] = touched;
        baked.texels.hidden[static_cast<std::size_t>(map)][place] =
            hasBit(blockLight.hidden, index);
        if (!touched) continue;
        for (const GroupLight& group : blockLight.groups) {
          if (!groups.has(group.group)) continue;
          const Rgb rgb{group.rgb[at], group.rgb[at + 1], group.rgb[at + 2]};
          if (group.group == 0)
            std::ranges::copy(
                rgb, baked.maps[static_cast<std::size_t>(map)].pixel<std::uint16_t>(p.x, p.y));
          else if (rgb != Rgb{})
            put(baked.groups[group.group], map, p, rgb);
        }
        at += 3;
      }
  }
}

void dilate(BakedLight& baked) {
  parallelFor(baked.maps.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i)
      dilateMap(baked.maps[i], baked.texels, static_cast<int>(i));
  });
  parallelFor(baked.groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !Progress::cancelled(); ++i)
      dilateGroup(baked.groups[i], baked.texels);
  });
}

}  // namespace lucerna::bake
