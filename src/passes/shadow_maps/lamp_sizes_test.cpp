#include "passes/shadow_maps/lamp_sizes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "passes/shadow_maps/shadow_atlas.hpp"

namespace lucerna::passes {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using Lamp = LampSizes::Lamp;

constexpr int kSmallest = ShadowAtlas::kSizes - 1;
constexpr int kPlenty = 1 << 20;

int cellsOf(const std::vector<Lamp>& lamps, const std::vector<int>& sizes) {
  int cells = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    cells += lamps[i].maps * ShadowAtlas::cellsOf(sizes[i]);
  return cells;
}

// Equal ones of six maps each.
std::vector<Lamp> lampsOf(std::uint32_t count) {
  std::vector<Lamp> lamps;
  for (std::uint32_t i = 0; i < count; ++i)
    lamps.push_back({.light = i, .share = 1.f, .importance = 1.f, .maps = 6});
  return lamps;
}

TEST(LampSizes, HalveWithTheShareOfThePicture) {
  std::vector<Lamp> lamps = lampsOf(6);
  const float shares[] = {1.f, 0.51f, 0.49f, 0.26f, 0.24f, 0.01f};
  for (std::size_t i = 0; i < lamps.size(); ++i) lamps[i].share = shares[i];
  EXPECT_THAT(LampSizes().choose(lamps, kSmallest, kPlenty), ElementsAre(0, 0, 1, 1, 2, 3));
  EXPECT_THAT(LampSizes().choose(lamps, 1, kPlenty), ElementsAre(0, 0, 1, 1, 1, 1));
}

TEST(LampSizes, StayWhileTheShareWavers) {
  LampSizes sizes;
  std::vector<Lamp> lamps = lampsOf(1);
  const auto at = [&](float share) {
    lamps[0].share = share;
    return sizes.choose(lamps, kSmallest, kPlenty)[0];
  };
  EXPECT_EQ(at(0.55f), 0);
  for (const float share : {0.47f, 0.53f, 0.44f, 0.6f}) EXPECT_EQ(at(share), 0);
  EXPECT_EQ(at(0.4f), 1);
  for (const float share : {0.53f, 0.47f, 0.57f, 0.25f, 0.22f}) EXPECT_EQ(at(share), 1);
  EXPECT_EQ(at(0.62f), 0);
}

TEST(LampSizes, TheLeastImportantShrinkUntilAllFit) {
  std::vector<Lamp> lamps = lampsOf(3);
  lamps[1].importance = 0.5f;
  lamps[2].importance = 0.1f;
  const int layer = ShadowAtlas::kCells;
  EXPECT_THAT(LampSizes().choose(lamps, kSmallest, 18 * layer), ElementsAre(0, 0, 0));
  EXPECT_THAT(LampSizes().choose(lamps, kSmallest, 18 * layer - 1), ElementsAre(0, 0, 1));
  EXPECT_THAT(LampSizes().choose(lamps, kSmallest, 13 * layer), ElementsAre(0, 0, 2));
  EXPECT_THAT(LampSizes().choose(lamps, kSmallest, 12 * layer), ElementsAre(0, 1, 2));
}

TEST(LampSizes, TheLastGetNoneWhereNotEvenTheSmallestFit) {
  const std::vector<Lamp> lamps = lampsOf(12);
  const std::vector<int> sizes = LampSizes().choose(lamps, kSmallest, ShadowAtlas::kCells);
  EXPECT_EQ(sizes.size(), 10u) << "of six cells each, in 64";
  EXPECT_THAT(sizes, Each(kSmallest));
}

TEST(LampSizes, EveryBudgetIsKeptAndUsed) {
  Random random(3);
  LampSizes sizes;
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<Lamp> lamps = lampsOf(1 + random.below(80));
    for (Lamp& lamp : lamps)
      lamp = {lamp.light, random.uniform(), random.uniform(),
              1 + static_cast<int>(random.below(6))};
    std::ranges::sort(lamps, std::greater{}, &Lamp::importance);
    const int budget = ShadowAtlas::kCells * (1 + static_cast<int>(random.below(100)));
    const std::vector<int> chosen = sizes.choose(lamps, kSmallest, budget);
    ASSERT_LE(cellsOf(lamps, chosen), budget);
    const std::vector<int> fresh = LampSizes().choose(lamps, kSmallest, budget);
    const std::vector<int> free = LampSizes().choose(lamps, kSmallest, kPlenty);
    if (fresh != free && fresh.size() == lamps.size()) {
      ASSERT_GT(cellsOf(lamps, fresh) + 6 * ShadowAtlas::kCells, budget) << "one halving too many";
    }
  }
}

// Sizes of lamps whose importance wavers by a fifth, and of which one comes and goes.
TEST(LampSizes, DoNotFlickerAtTheEdgeOfABudget) {
  LampSizes sizes;
  std::vector<int> before;
  for (int frame = 0; frame < 40; ++frame) {
    std::vector<Lamp> lamps = lampsOf(8);
    for (Lamp& lamp : lamps)
      lamp.importance = 1.f + 0.1f * std::sin(static_cast<float>(frame + 3 * lamp.light));
    if (frame > 0 && frame % 2 == 0) lamps[7].maps = 5;  // a face that sees nothing now
    std::vector<int> chosen(lamps.size());
    std::ranges::sort(lamps, std::greater{}, &Lamp::importance);
    const std::vector<int> found = sizes.choose(lamps, kSmallest, 42 * ShadowAtlas::kCells);
    for (std::size_t i = 0; i < lamps.size(); ++i) chosen[lamps[i].light] = found[i];
    if (frame > 0) {
      ASSERT_EQ(chosen, before) << "frame " << frame;
    }
    before = chosen;
  }
  EXPECT_GT(std::ranges::count(before, 0), 0);
  EXPECT_LT(std::ranges::count(before, 0), 8);
}

TEST(LampSizes, WhoBecomesMuchMoreImportantGrows) {
  LampSizes sizes;
  std::vector<Lamp> lamps = lampsOf(4);
  lamps[3].importance = 0.5f;
  const int budget = 20 * ShadowAtlas::kCells;
  EXPECT_THAT(sizes.choose(lamps, kSmallest, budget), ElementsAre(0, 0, 0, 1));
  lamps[3].importance = 1.5f;
  EXPECT_THAT(sizes.choose(lamps, kSmallest, budget), ElementsAre(0, 0, 0, 1));
  lamps[3].importance = 20.f;
  std::ranges::sort(lamps, std::greater{}, &Lamp::importance);
  EXPECT_EQ(sizes.choose(lamps, kSmallest, budget)[0], 0);
}

}  // namespace
}  // namespace lucerna::passes
