#include "passes/shadow_maps/lamp_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "passes/shadow_maps/shadow_atlas.hpp"

namespace lucerna::passes {
namespace {

constexpr float kPast = 0.25f;  // of a halving, before a size changes
constexpr float kWorth = 2.f;   // by which a lamp that was smaller has to be more important
constexpr int kFreeShare = 16;  // one part of so many stays free where something grows
constexpr int kNoFormer = -1;

struct Choice {
  LampSizes::Lamp lamp;
  int former = kNoFormer, size = 0;

  int cells() const { return lamp.maps * ShadowAtlas::cellsOf(size); }
  bool grows() const { return former != kNoFormer && size < former; }
  float worthOfACell() const {
    const float worth = lamp.importance * std::exp2(2.f * static_cast<float>(size));
    return grows() ? worth / kWorth : worth;
  }
};

int wantedSize(float share, int former, int smallest) {
  const float halvings = -std::log2(std::max(share, 1e-6f));
  const float kept = static_cast<float>(former);
  if (former != kNoFormer && halvings >= kept - kPast && halvings < kept + 1.f + kPast)
    return former;
  return std::min(static_cast<int>(halvings), smallest);
}

void shrinkToFit(std::vector<Choice>& choices, int smallest, int budget) {
  for (;;) {
    int cells = 0;
    for (const Choice& choice : choices) cells += choice.cells();
    const bool grows = std::ranges::any_of(choices, &Choice::grows);
    if (cells <= (grows ? budget - budget / kFreeShare : budget)) return;
    Choice* least = nullptr;
    for (Choice& choice : choices)
      if (choice.size < smallest && (!least || choice.worthOfACell() <= least->worthOfACell()))
        least = &choice;
    if (!least) return;
    ++least->size;
  }
}

}  // namespace

std::vector<int> LampSizes::choose(std::span<const Lamp> lamps, int smallestSize, int budget) {
  std::vector<Choice> choices;
  int least = 0;  // cells of all at the smallest size
  for (const Lamp& lamp : lamps) {
    least += lamp.maps * ShadowAtlas::cellsOf(smallestSize);
    if (least > budget) break;
    const auto found = former_.find(lamp.light);
    const int former = found == former_.end() ? kNoFormer : std::min(found->second, smallestSize);
    choices.push_back(
        {.lamp = lamp, .former = former, .size = wantedSize(lamp.share, former, smallestSize)});
  }
  shrinkToFit(choices, smallestSize, budget);
  former_.clear();
  std::vector<int> sizes;
  for (const Choice& choice : choices) {
    sizes.push_back(choice.size);
    former_[choice.lamp.light] = choice.size;
  }
  return sizes;
}

}  // namespace lucerna::passes
