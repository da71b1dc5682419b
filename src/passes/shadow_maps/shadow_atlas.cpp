#include "passes/shadow_maps/shadow_atlas.hpp"

#include <algorithm>

#include "core/check.hpp"

namespace lucerna::passes {

std::uint64_t ShadowAtlas::Run::cells() const {
  const int count = cellsOf(size);
  return (~std::uint64_t{0} >> (kCells - count)) << (index * count);
}

void ShadowAtlas::reshape(int side, int mostLayers) {
  if (side == side_ && mostLayers == mostLayers_) return;
  side_ = side;
  mostLayers_ = mostLayers;
  used_.clear();
  runs_.clear();
}

std::vector<ShadowAtlas::Square> ShadowAtlas::place(std::span<const Wish> wishes) {
  int cells = 0;
  for (const Wish& wish : wishes) cells += cellsOf(wish.size);
  CHECK(cells <= kCells * mostLayers_, "{} cells for maps of {}", kCells * mostLayers_, cells);
  if (!placeBesideOthers(wishes)) {
    // Into empty layers, large squares first, all fit without gaps; by half as many layers again
    // they seldom have to.
    const int needed = (cells + kCells - 1) / kCells;
    const int wanted = layers() == 0 ? needed : needed + needed / 2;
    used_.resize(static_cast<std::size_t>(std::max(layers(), std::min(wanted, mostLayers_))));
    runs_.clear();
    CHECK(placeBesideOthers(wishes), "maps of {} cells do not fit {} layers", cells, layers());
  }
  std::vector<Square> squares;
  for (const Wish& wish : wishes) squares.push_back(squareOf(runs_.at(wish.key)));
  return squares;
}

bool ShadowAtlas::placeBesideOthers(std::span<const Wish> wishes) {
  std::map<std::uint64_t, Run> kept;
  std::vector<Wish> others;
  std::ranges::fill(used_, 0u);
  for (const Wish& wish : wishes) {
    const auto run = runs_.find(wish.key);
    if (run == runs_.end() || run->second.size != wish.size) {
      others.push_back(wish);
      continue;
    }
    kept.insert(*run);
    used_[static_cast<std::size_t>(run->second.layer)] |= run->second.cells();
  }
  runs_ = std::move(kept);
  std::ranges::stable_sort(others, {}, &Wish::size);
  return std::ranges::all_of(others, [&](const Wish& wish) { return placeNew(wish); });
}

bool ShadowAtlas::placeNew(const Wish& wish) {
  for (Run run{.size = wish.size}; run.layer < layers(); ++run.layer) {
    std::uint64_t& used = used_[static_cast<std::size_t>(run.layer)];
    for (run.index = 0; run.index < kCells / cellsOf(run.size); ++run.index) {
      if (used & run.cells()) continue;
      used |= run.cells();
      runs_[wish.key] = run;
      return true;
    }
  }
  return false;
}

// Each two bits of the index, from the highest, choose a quarter.
ShadowAtlas::Square ShadowAtlas::squareOf(const Run& run) const {
  Square square{.layer = run.layer, .side = side_};
  for (int level = run.size - 1; level >= 0; --level) {
    square.side /= 2;
    const int quarter = run.index >> (2 * level) & 3;
    square.corner += square.side * ivec2(quarter & 1, quarter >> 1);
  }
  return square;
}

}  // namespace lucerna::passes
