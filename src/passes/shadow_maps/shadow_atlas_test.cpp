#include "passes/shadow_maps/shadow_atlas.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"

namespace lucerna::passes {
namespace {

using Square = ShadowAtlas::Square;
using Wish = ShadowAtlas::Wish;

int cellsOf(const std::vector<Wish>& wishes) {
  int cells = 0;
  for (const Wish& wish : wishes) cells += ShadowAtlas::cellsOf(wish.size);
  return cells;
}

// Texels of all layers that more than one square covers, or that lie outside.
int faultsOf(const std::vector<Square>& squares, int side, int layers) {
  std::vector<int> covered(static_cast<std::size_t>(side * side * layers));
  int faults = 0;
  for (const Square& square : squares)
    for (int y = square.corner.y; y < square.corner.y + square.side; ++y)
      for (int x = square.corner.x; x < square.corner.x + square.side; ++x) {
        const bool inside = x >= 0 && y >= 0 && x < side && y < side && square.layer < layers;
        faults +=
            !inside ||
            covered[(static_cast<std::size_t>(square.layer * side) + static_cast<std::size_t>(y)) *
                        static_cast<std::size_t>(side) +
                    static_cast<std::size_t>(x)]++ > 0;
      }
  return faults;
}

// Wishes that come, go and change their sizes, as many as fit.
void change(std::vector<Wish>& wishes, Random& random, int budget) {
  for (Wish& wish : wishes)
    if (random.uniform() < 0.1f) wish.size = static_cast<int>(random.below(ShadowAtlas::kSizes));
  std::erase_if(wishes, [&](const Wish&) { return random.uniform() < 0.05f; });
  for (int i = 0; i < 6; ++i) {
    const Wish wish{random.below(400), static_cast<int>(random.below(ShadowAtlas::kSizes))};
    if (std::ranges::find(wishes, wish.key, &Wish::key) == wishes.end()) wishes.push_back(wish);
  }
  while (cellsOf(wishes) > budget) wishes.pop_back();
}

// 37 is odd: halves are rounded.
TEST(ShadowAtlas, SquaresNeverOverlap) {
  for (const int side : {16, 37, 40}) {
    constexpr int kLayers = 5;
    ShadowAtlas atlas;
    atlas.reshape(side, kLayers);
    Random random(1);
    std::vector<Wish> wishes;
    for (int frame = 0; frame < 500; ++frame) {
      change(wishes, random, kLayers * ShadowAtlas::kCells);
      const std::vector<Square> squares = atlas.place(wishes);
      ASSERT_EQ(squares.size(), wishes.size());
      ASSERT_EQ(faultsOf(squares, side, kLayers), 0) << "side " << side << ", frame " << frame;
      ASSERT_LE(atlas.layers(), kLayers);
      for (std::size_t i = 0; i < wishes.size(); ++i)
        ASSERT_EQ(squares[i].side, side >> wishes[i].size);
    }
  }
}

// Where there is room for it, what others do moves nothing.
TEST(ShadowAtlas, WhatDoesNotChangeStays) {
  constexpr int kLayers = 8;
  ShadowAtlas atlas;
  atlas.reshape(64, kLayers);
  Random random(2);
  std::vector<Wish> wishes;
  std::map<std::uint64_t, std::pair<int, Square>> before;
  int stayed = 0, moved = 0;
  for (int frame = 0; frame < 300; ++frame) {
    const int layers = atlas.layers();
    change(wishes, random, kLayers * ShadowAtlas::kCells / 2);
    const std::vector<Square> squares = atlas.place(wishes);
    std::map<std::uint64_t, std::pair<int, Square>> now;
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      const auto& [key, size] = wishes[i];
      now[key] = {size, squares[i]};
      const auto found = before.find(key);
      if (found == before.end() || found->second.first != size || atlas.layers() != layers)
        continue;
      ++(found->second.second == squares[i] ? stayed : moved);
    }
    before = std::move(now);
  }
  EXPECT_GT(stayed, 1000);
  EXPECT_LT(moved, stayed / 20) << "all are placed anew where layers have no gap that is large";
  const std::vector<Square> squares = atlas.place(wishes);
  EXPECT_EQ(atlas.place(wishes), squares);
}

TEST(ShadowAtlas, ABudgetCanBeFilledToTheLastCell) {
  constexpr int kLayers = 3;
  ShadowAtlas atlas;
  atlas.reshape(64, kLayers);
  std::vector<Wish> wishes;  // small ones first, so that their order does not help
  for (std::uint64_t key = 0; key < 84; ++key)
    wishes.push_back({key, key < 64 ? 3 : key < 80 ? 2 : 1});
  ASSERT_EQ(cellsOf(wishes), kLayers * ShadowAtlas::kCells);
  EXPECT_EQ(faultsOf(atlas.place(wishes), 64, kLayers), 0);
  // Three of four of the smallest go, scattered; larger ones take their room.
  std::erase_if(wishes, [](const Wish& wish) { return wish.size == 3 && wish.key % 4 != 0; });
  wishes.push_back({100, 1});
  wishes.push_back({101, 1});
  wishes.push_back({102, 1});
  ASSERT_EQ(cellsOf(wishes), kLayers * ShadowAtlas::kCells);
  EXPECT_EQ(faultsOf(atlas.place(wishes), 64, kLayers), 0);
  EXPECT_EQ(atlas.layers(), kLayers);
}

TEST(ShadowAtlas, LayersAreThoseNeededAndFallOnlyWithTheShape) {
  ShadowAtlas atlas;
  atlas.reshape(64, 10);
  EXPECT_EQ(atlas.layers(), 0);
  atlas.place(std::vector<Wish>{{1, 0}, {2, 1}, {3, 3}});
  EXPECT_EQ(atlas.layers(), 2);
  atlas.place({});
  EXPECT_EQ(atlas.layers(), 2);
  atlas.reshape(64, 9);
  EXPECT_EQ(atlas.layers(), 0);
}

}  // namespace
}  // namespace lucerna::passes
