#include "bake/assemble.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <tuple>

#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace lucerna::bake {
namespace {

using Rgb = std::array<std::uint16_t, 3>;

vec3 colorOf(const std::uint16_t* rgb) {
  return {floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])};
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
      const vec3 light = donors.light(
          [&](ivec2 step) { return colorOf(image.pixel<std::uint16_t>(x + step.x, y + step.y)); });
      std::ranges::copy(halves(light), image.pixel<std::uint16_t>(x, y));
    }
}

auto orderOf(const LitTexel& t) {
  return std::tuple(t.map, t.y, t.x);
}

LitTexel moved(const LitTexel& t, ivec2 step) {
  return {.map = t.map,
          .x = static_cast<std::uint16_t>(t.x + step.x),
          .y = static_cast<std::uint16_t>(t.y + step.y)};
}

// The texels beside lit ones that the scene does not touch, each once, dark.
std::vector<LitTexel> unlitBeside(const std::vector<LitTexel>& lit, const MapTexels& texels) {
  std::vector<LitTexel> found;
  for (const LitTexel& from : lit)
    for (const ivec2 step : kAround) {
      const ivec2 p = ivec2(from.x, from.y) + step;
      const bool within = p.x >= 0 && p.y >= 0 && p.x < texels.side && p.y < texels.side;
      if (within && !texels.has(from.map, p)) found.push_back(moved(from, step));
    }
  std::ranges::sort(found, {}, orderOf);
  const auto again = std::ranges::unique(found, {}, orderOf);
  found.erase(again.begin(), again.end());
  return found;
}

// The light of one group spreads into the same texels by the same rule.
void dilateGroup(std::vector<LitTexel>& lit, const MapTexels& texels) {
  std::ranges::sort(lit, {}, orderOf);
  std::vector<LitTexel> filled = unlitBeside(lit, texels);
  for (LitTexel& texel : filled)
    texel.rgb = halves(Donors(texels, texel.map, {texel.x, texel.y}).light([&](ivec2 step) {
      const LitTexel wanted = moved(texel, step);
      const auto at = std::ranges::lower_bound(lit, orderOf(wanted), {}, orderOf);
      return at != lit.end() && orderOf(*at) == orderOf(wanted) ? colorOf(at->rgb.data())
                                                                : vec3(0.f);
    }));
  std::erase_if(filled, [](const LitTexel& t) { return t.rgb == Rgb{}; });
  lit.insert(lit.end(), filled.begin(), filled.end());
  std::ranges::sort(lit, {}, orderOf);
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

BakedLight emptyLight(const Plan& plan) {
  BakedLight baked;
  const int side = plan.settings.pack.side;
  const auto count = static_cast<std::size_t>(plan.packed.packing.maps);
  baked.texels.side = side;
  for (auto* list : {&baked.texels.touched, &baked.texels.hidden})
    list->assign(count, std::vector<bool>(static_cast<std::size_t>(side) * side));
  for (std::size_t i = 0; i < count; ++i)
    baked.maps.emplace_back(side, side, 3, ComponentType::Half);
  baked.groups.resize(plan.groups.size());
  return baked;
}

void putInMaps(BakedLight& baked, const Plan& plan, const Unit& unit, const UnitLight& light) {
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
          const Rgb rgb{group.rgb[at], group.rgb[at + 1], group.rgb[at + 2]};
          if (group.group == 0)
            std::ranges::copy(
                rgb, baked.maps[static_cast<std::size_t>(map)].pixel<std::uint16_t>(p.x, p.y));
          else if (rgb != Rgb{})
            baked.groups[group.group].push_back({.map = static_cast<std::uint16_t>(map),
                                                 .x = static_cast<std::uint16_t>(p.x),
                                                 .y = static_cast<std::uint16_t>(p.y),
                                                 .rgb = rgb});
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
