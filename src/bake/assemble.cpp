#include "bake/assemble.hpp"

#include <algorithm>
#include <tuple>

#include "core/parallel.hpp"

namespace lucerna::bake {
namespace {

using Rgb = std::array<std::uint16_t, 3>;

vec3 colorOf(const std::uint16_t* rgb) {
  return {floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])};
}
Rgb halves(vec3 v) {
  return {halfFromFloat(v.x), halfFromFloat(v.y), halfFromFloat(v.z)};
}

constexpr std::array<ivec2, 8> kAround{ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1), ivec2(-1, 0),
                                       ivec2(1, 0),   ivec2(-1, 1), ivec2(0, 1),  ivec2(1, 1)};

// How many texels around this one the scene touches.
int touchedAround(const MapTexels& texels, int map, ivec2 p) {
  return static_cast<int>(
      std::ranges::count_if(kAround, [&](ivec2 step) { return texels.has(map, p + step); }));
}

// The mean or, of hidden texels, the darkest of `count` colours.
class Filling {
 public:
  explicit Filling(bool darkest) : darkest_(darkest) {}
  void add(vec3 color) {
    sum_ += color;
    least_ = count_ == 0 ? color : glm::min(least_, color);
    ++count_;
  }
  // count: of all texels around, those that were not added being black.
  vec3 of(int count) const {
    if (darkest_) return count_ < count ? vec3(0.f) : least_;
    return sum_ / static_cast<float>(count);
  }
  int count() const { return count_; }

 private:
  bool darkest_;
  vec3 sum_{0.f}, least_{0.f};
  int count_ = 0;
};

void dilateMap(Image& image, const MapTexels& texels, int map) {
  const int side = texels.side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (texels.has(map, {x, y})) continue;
      Filling filling(texels.isHidden(map, {x, y}));
      for (const ivec2 step : kAround) {
        const ivec2 p = ivec2(x, y) + step;
        if (texels.has(map, p)) filling.add(colorOf(image.pixel<std::uint16_t>(p.x, p.y)));
      }
      if (filling.count() > 0)
        std::ranges::copy(halves(filling.of(filling.count())), image.pixel<std::uint16_t>(x, y));
    }
}

auto orderOf(const LitTexel& t) {
  return std::tuple(t.map, t.y, t.x);
}

// The light of one group spreads into the same texels with the same shares.
void dilateGroup(std::vector<LitTexel>& lit, const MapTexels& texels) {
  struct Share {
    LitTexel at;
    vec3 value;
  };
  std::vector<Share> shares;
  for (const LitTexel& from : lit)
    for (const ivec2 step : kAround) {
      const ivec2 p = ivec2(from.x, from.y) + step;
      if (p.x < 0 || p.y < 0 || p.x >= texels.side || p.y >= texels.side) continue;
      if (texels.has(from.map, p)) continue;
      shares.push_back({{.map = from.map,
                         .x = static_cast<std::uint16_t>(p.x),
                         .y = static_cast<std::uint16_t>(p.y)},
                        colorOf(from.rgb.data())});
    }
  std::ranges::stable_sort(shares, {}, [](const Share& s) { return orderOf(s.at); });
  for (std::size_t i = 0; i < shares.size();) {
    LitTexel texel = shares[i].at;
    Filling filling(texels.isHidden(texel.map, {texel.x, texel.y}));
    for (const auto order = orderOf(texel); i < shares.size() && orderOf(shares[i].at) == order;
         ++i)
      filling.add(shares[i].value);
    const int count = touchedAround(texels, texel.map, {texel.x, texel.y});
    texel.rgb = halves(filling.of(count));
    if (texel.rgb != Rgb{}) lit.push_back(texel);
  }
  std::ranges::sort(lit, {}, orderOf);
}

}  // namespace

namespace {

// Whether the texel is one that the chart was packed by. What it touches by less may be another's.
bool isOf(const Plan& plan, std::uint32_t chart, ivec2 texel) {
  const TexelMask& mask = plan.packed.masks[chart];
  const ivec2 p = texel - ivec2(plan.packed.least[chart]);
  return p.x >= 0 && p.y >= 0 && p.x < mask.size().x && p.y < mask.size().y && mask.at(p.x, p.y);
}

}  // namespace

bool MapTexels::isBeside(int map, ivec2 p) const {
  return !has(map, p) && touchedAround(*this, map, p) > 0;
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

void place(BakedLight& baked, const Plan& plan, const Unit& unit, const UnitLight& light) {
  for (std::uint32_t b = 0; b < unit.blocks; ++b) {
    const Block& block = plan.blocks[unit.firstBlock + b];
    const BlockLight& blockLight = light.blocks[b];
    const int map = plan.packed.packing.places[block.chart].map;
    std::size_t at = 0;
    for (int y = 0; y < block.size.y; ++y)
      for (int x = 0; x < block.size.x; ++x) {
        const auto index = static_cast<std::size_t>(y * block.size.x + x);
        const ivec2 texel = block.corner + ivec2(x, y);
        const bool touched = blockLight.touched[index / 8] >> (index % 8) & 1;
        if (!isOf(plan, block.chart, texel)) {
          if (touched) at += 3;
          continue;
        }
        const ivec2 p = placed(plan, block.chart, texel);
        auto& texels = touched ? baked.texels.touched : baked.texels.hidden;
        texels[static_cast<std::size_t>(map)]
              [static_cast<std::size_t>(p.y) * baked.texels.side + p.x] = true;
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
    for (std::size_t i = begin; i < end; ++i)
      dilateMap(baked.maps[i], baked.texels, static_cast<int>(i));
  });
  parallelFor(baked.groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) dilateGroup(baked.groups[i], baked.texels);
  });
}

}  // namespace lucerna::bake
