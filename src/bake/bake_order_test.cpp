// bake.json there and back, what differs, and which shards are missing.
#include "bake/bake_order.hpp"

#include <gmock/gmock.h>

#include <latch>
#include <thread>

#include "bake/shards.hpp"
#include "core/file.hpp"
#include "core/test_folder.hpp"

namespace lucerna::bake {
namespace {

using ::testing::HasSubstr;

BakeOrder someOrder() {
  BakeOrder order{.scene = "builtin:cornell",
                  .plan = 0xfedcba9876543210ull,
                  .processor = "avx2",
                  .settings = {}};
  order.settings.density = 0.1f;
  order.settings.reach = 12.7f;
  order.settings.faintest = 1.f / 3.f;
  order.settings.unwrap = Unwrap::Pairs;
  order.settings.engine = Engine::Octree;
  order.settings.pack = {.side = 512, .gap = 3, .mostMaps = 7};
  order.settings.sampling = {.positions = 4,
                             .finePositions = 8,
                             .lightSamples = 32,
                             .emitterSize = 0.1f,
                             .emitterShare = 0.3f,
                             .skyDirections = 64,
                             .skyPoints = 3};
  order.settings.patchTolerance = 0.3f;
  order.settings.sky = vec3(0.1f, 0.2f, 0.7f);
  order.settings.encodings = {Encoding::Png, Encoding::Rgb9e5};
  order.settings.groups = {"lamps", "always-on"};
  return order;
}

TEST(BakeOrder, ComesBackToTheBit) {
  const BakeOrder order = someOrder();
  const Result<BakeOrder> back = orderFrom(toJson(order), "bake.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(toJson(*back), toJson(order));
  EXPECT_EQ(back->plan, order.plan);
  EXPECT_EQ(back->processor, order.processor);
  EXPECT_EQ(back->settings.density, order.settings.density);
  EXPECT_EQ(back->settings.faintest, order.settings.faintest);
  EXPECT_EQ(back->settings.reach, order.settings.reach);
  EXPECT_EQ(back->settings.sampling.emitterSize, order.settings.sampling.emitterSize);
  EXPECT_EQ(back->settings.patchTolerance, order.settings.patchTolerance);
  EXPECT_EQ(back->settings.sky, order.settings.sky);
  EXPECT_EQ(back->settings.encodings, order.settings.encodings);
  EXPECT_EQ(back->settings.groups, order.settings.groups);
  const Result<BakeOrder> plain = orderFrom(
      toJson({.scene = "a.obj", .plan = 0, .processor = "avx2", .settings = {}}), "bake.json");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ(plain->settings.reach, BakeSettings().reach);
  EXPECT_FALSE(plain->settings.patchTolerance);
}

TEST(BakeOrder, NoTornOneIsTaken) {
  const std::string text = toJson(someOrder());
  for (std::size_t size = 0; size + 2 < text.size(); ++size)
    EXPECT_FALSE(orderFrom(text.substr(0, size), "bake.json")) << size;
}

TEST(BakeOrder, WhatDiffersIsNamed) {
  const TestFolder folder;
  std::filesystem::create_directories(folder / kWorkFolder);
  const BakeOrder first = someOrder();
  ASSERT_TRUE(keepOrder(folder.path(), first));
  EXPECT_TRUE(keepOrder(folder.path(), first));
  BakeOrder other = first;
  other.settings.pack.side = 1024;
  other.settings.groups.clear();
  other.settings.sky = vec3(0.5f, 1.f, 0.f);
  const Status refused = keepOrder(folder.path(), other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
  EXPECT_THAT(refused.error().message,
              HasSubstr("other settings: --size is 512 there, 1024 here, --lights is "
                        "lamps,always-on there, all here, --sky is 0.1,0.2,0.7 there, 0.5,1,0 "
                        "here; give the same"));
  BakeOrder moved = first;
  moved.scene = "elsewhere.obj";
  EXPECT_TRUE(keepOrder(folder.path(), moved));  // the plan says that it is the same
  moved.plan = 1;
  EXPECT_THAT(keepOrder(folder.path(), moved).error().message, HasSubstr("'elsewhere.obj' here"));
  BakeOrder changed = first;
  changed.plan = 1;
  EXPECT_THAT(keepOrder(folder.path(), changed).error().message, HasSubstr("before it changed"));
  BakeOrder elsewhere = first;
  elsewhere.processor = "sse4.2";
  EXPECT_THAT(keepOrder(folder.path(), elsewhere).error().message,
              HasSubstr("of processors with avx2, this one has sse4.2"));
}

TEST(BakeOrder, APresetDiffersByItsName) {
  const TestFolder folder;
  std::filesystem::create_directories(folder / kWorkFolder);
  BakeOrder order{.scene = "a.obj", .plan = 0, .processor = "avx2", .settings = {}};
  ASSERT_TRUE(keepOrder(folder.path(), order));
  order.settings.sampling = kFinal;
  EXPECT_THAT(keepOrder(folder.path(), order).error().message,
              HasSubstr("other settings: --preset is standard there, final here; give"));
  ++order.settings.sampling.positions;
  EXPECT_THAT(
      keepOrder(folder.path(), order).error().message,
      HasSubstr("standard there, none of this version's (5, 8, 32, 0.05, 1, 256, 4) here; give"));
}

TEST(BakeOrder, DamageSaysWhatToDo) {
  const TestFolder folder;
  std::filesystem::create_directories(folder / kWorkFolder);
  ASSERT_TRUE(keepOrder(folder.path(), someOrder()));
  std::string text = toJson(someOrder());
  text[text.find("avx2")] ^= '\x80';
  ASSERT_TRUE(writeText(orderPath(folder.path()), text));
  const auto order = readOrder(folder.path());
  ASSERT_FALSE(order);
  EXPECT_THAT(order.error().message, HasSubstr("bake.json:5:16: found the byte 0xE1"));
  EXPECT_THAT(order.error().message, HasSubstr("work' and bake anew"));
}

TEST(BakeOrder, OfThoseWhoStartTogetherOneCounts) {
  constexpr int kShards = 4;
  for (int round = 0; round < 50; ++round) {
    const TestFolder folder;
    std::filesystem::create_directories(folder / kWorkFolder);
    std::latch start(kShards);
    std::array<bool, kShards> kept{};
    std::vector<std::jthread> shards;
    for (int i = 0; i < kShards; ++i)
      shards.emplace_back([&, i] {
        BakeOrder order = someOrder();
        order.settings.pack.mostMaps = i + 1;
        start.arrive_and_wait();
        kept[static_cast<std::size_t>(i)] = static_cast<bool>(keepOrder(folder.path(), order));
      });
    shards.clear();
    const auto there = readOrder(folder.path());
    ASSERT_TRUE(there);
    EXPECT_EQ(std::ranges::count(kept, true), 1);
    EXPECT_TRUE(kept[static_cast<std::size_t>(there->settings.pack.mostMaps - 1)]);
  }
}

TEST(Shards, ShareOutAllUnitsOnce) {
  for (const int count : {1, 2, 5, 40}) {
    std::vector<int> taken(17, 0);
    for (int i = 1; i <= count; ++i)
      for (const std::uint32_t unit : unitsOf(taken.size(), {.index = i, .count = count}))
        ++taken[unit];
    EXPECT_EQ(std::ranges::count(taken, 1), 17) << count;
  }
}

TEST(Shards, WhatIsMissingIsNamed) {
  std::vector<bool> done(400, true);
  const std::vector<std::filesystem::path> logs{"w/shard-1-of-5.log", "w/shard-2-of-5.log",
                                                "w/shard-4-of-5.log", "w/shard-5-of-5.log",
                                                "w/shard-1-of-1.log"};
  for (const std::uint32_t unit : unitsOf(done.size(), {.index = 3, .count = 5}))
    done[unit] = false;
  EXPECT_EQ(describeMissing(logs, done), "shard 3 of 5 has no log");
  for (std::uint32_t i = 0; i < 17; ++i) done[1 + 5 * i] = false;
  EXPECT_EQ(describeMissing(logs, done),
            "shard 2 of 5 lacks 17 of 80 units; shard 3 of 5 has no log");
  EXPECT_EQ(describeMissing({}, done), "there is no log of any shard");
  done.assign(400, false);
  EXPECT_THAT(describeMissing(std::vector<std::filesystem::path>{"w/shard-9-of-400.log"}, done),
              HasSubstr("; 380 more shards"));
}

}  // namespace
}  // namespace lucerna::bake
