#include "scene/bvh.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "core/random.hpp"

namespace lucerna::scene {
namespace {

vec3 randomPoint(Random& random, float extent) {
  const float x = random.uniform(-extent, extent), y = random.uniform(-extent, extent);
  return {x, y, random.uniform(-extent, extent)};
}

std::vector<Aabb> randomBoxes(std::size_t count, std::uint64_t seed, float extent, float size) {
  Random random(seed);
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    box.grow(randomPoint(random, extent));
    const float x = random.uniform(0, size), y = random.uniform(0, size);
    box.max += vec3(x, y, random.uniform(0, size));
  }
  return boxes;
}

Frustum randomFrustum(Random& random, float extent) {
  const vec3 eye = randomPoint(random, extent), target = randomPoint(random, extent);
  const mat4 viewFromWorld = glm::lookAt(eye, target, vec3(0.1f, 1.f, 0.02f));
  const float fovY = random.uniform(0.05f, 2.f), aspect = random.uniform(0.3f, 3.f);
  const float far = random.below(3) == 0 ? std::numeric_limits<float>::infinity()
                                         : random.uniform(0.2f, 2.f) * extent;
  return frustumOf(perspectiveReversed(fovY, aspect, 0.1f, far) * viewFromWorld);
}

std::vector<std::uint32_t> bruteForce(const Frustum& frustum, std::span<const Aabb> boxes) {
  std::vector<std::uint32_t> items;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (intersects(frustum, boxes[i])) items.push_back(i);
  return items;
}

std::vector<std::uint32_t> sortedQuery(const Bvh& bvh, const Frustum& frustum) {
  std::vector<std::uint32_t> items;
  bvh.query(frustum, items);
  std::sort(items.begin(), items.end());
  return items;
}

TEST(Bvh, FindsTheFirstSideOfABoxOnARay) {
  const auto boxes = randomBoxes(500, 11, 50.f, 8.f);
  Bvh bvh;
  bvh.build(boxes);
  Random random(5);
  int found = 0, around = 0;
  for (int i = 0; i < 300; ++i) {
    // Every third from inside a box.
    const vec3 origin =
        i % 3 == 0 ? boxes[static_cast<std::size_t>(i)].center() : randomPoint(random, 50.f);
    const vec3 direction = randomPoint(random, 1.f);
    float expected = std::numeric_limits<float>::infinity();
    for (const Aabb& box : boxes) {
      const RaySpan span = spanInside(box, origin, direction);
      around += span.first == 0.f && span.last >= 0.f;
      if (span.first <= span.last)
        expected = std::min(expected, span.first > 0.f ? span.first : span.last);
    }
    found += std::isfinite(expected);
    EXPECT_EQ(bvh.firstSide(origin, direction), expected);
  }
  EXPECT_GT(found, 50);
  EXPECT_GE(around, 100);
  EXPECT_TRUE(std::isinf(Bvh().firstSide(vec3(0), vec3(1, 0, 0))));
}

TEST(Bvh, FindsExactlyWhatTestingEveryBoxFinds) {
  const std::vector<Aabb> boxes = randomBoxes(100'000, 1, 1000, 8);
  Bvh bvh;
  bvh.build(boxes);
  Random random(2);
  std::size_t found = 0;
  for (int view = 0; view < 1000; ++view) {
    const Frustum frustum = randomFrustum(random, 1000);
    const std::vector<std::uint32_t> expected = bruteForce(frustum, boxes);
    ASSERT_EQ(sortedQuery(bvh, frustum), expected) << "view " << view;
    found += expected.size();
  }
  EXPECT_GT(found, 0u);
}

// Coordinates on a coarse grid put box faces exactly on each other and on the planes.
TEST(Bvh, AgreesWhereBoxesTouchThePlanes) {
  Random random(3);
  std::vector<Aabb> boxes(5000);
  for (Aabb& box : boxes) {
    box.grow(glm::round(randomPoint(random, 8)));
    box.max += glm::round(glm::abs(randomPoint(random, 2)));
  }
  Bvh bvh;
  bvh.build(boxes);
  for (int view = 0; view < 200; ++view) {
    const vec3 low = glm::round(randomPoint(random, 8));
    const Frustum frustum =
        frustumOf(orthographicReversed(low.x, low.x + 4, low.y, low.y + 4, low.z, low.z + 4));
    ASSERT_EQ(sortedQuery(bvh, frustum), bruteForce(frustum, boxes)) << "view " << view;
  }
}

TEST(Bvh, FindsExactlyTheBoxesThatABoxMeets) {
  std::vector<Aabb> boxes = randomBoxes(5000, 5, 50, 3);
  for (Aabb& box : boxes) box = {glm::round(box.min), glm::round(box.max)};  // some only touch
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  boxes.push_back({vec3(-kInfinity), vec3(kInfinity)});
  boxes.emplace_back();  // empty
  Bvh bvh;
  bvh.build(boxes);
  Random random(6);
  std::size_t found = 0;
  for (int i = 0; i < 200; ++i) {
    Aabb asked;
    asked.grow(glm::round(randomPoint(random, 60)));
    asked.grow(glm::round(randomPoint(random, 60)));
    std::vector<std::uint32_t> expected, got;
    for (std::uint32_t k = 0; k < boxes.size(); ++k)
      if (!boxes[k].empty() && glm::all(glm::lessThanEqual(boxes[k].min, asked.max)) &&
          glm::all(glm::greaterThanEqual(boxes[k].max, asked.min)))
        expected.push_back(k);
    bvh.query(asked, got);
    std::ranges::sort(got);
    ASSERT_EQ(got, expected);
    found += got.size() - 1;
  }
  EXPECT_GT(found, 200u);
}

TEST(Bvh, EveryNodeHoldsItsChildrenAndEveryItemIsInOneLeaf) {
  const std::vector<Aabb> boxes = randomBoxes(3000, 4, 50, 3);
  Bvh bvh;
  bvh.build(boxes);
  std::vector<int> seen(boxes.size(), 0);
  const auto holds = [](const Aabb& outer, const Aabb& inner) {
    return glm::all(glm::lessThanEqual(outer.min, inner.min)) &&
           glm::all(glm::greaterThanEqual(outer.max, inner.max));
  };
  for (const Bvh::Node& node : bvh.nodes()) {
    if (node.count == 0) {
      EXPECT_TRUE(holds(node.box, bvh.nodes()[node.first].box));
      EXPECT_TRUE(holds(node.box, bvh.nodes()[node.first + 1].box));
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      EXPECT_TRUE(holds(node.box, boxes[bvh.items()[i]]));
      ++seen[bvh.items()[i]];
    }
  }
  EXPECT_THAT(seen, testing::Each(1));
}

TEST(Bvh, IsTheSameEveryTime) {
  const std::vector<Aabb> boxes = randomBoxes(3000, 5, 50, 3);
  Bvh a, b;
  a.build(boxes);
  b.build(randomBoxes(10, 6, 1, 1));
  b.build(boxes);
  EXPECT_TRUE(std::equal(a.items().begin(), a.items().end(), b.items().begin(), b.items().end()));
  ASSERT_EQ(a.nodes().size(), b.nodes().size());
}

TEST(Bvh, LeavesEmptyBoxesOutAndKeepsUnboundedOnes) {
  std::vector<Aabb> boxes = randomBoxes(20, 7, 5, 1);
  boxes[3] = Aabb{};
  boxes[4] = Aabb{vec3(-std::numeric_limits<float>::infinity()),
                  vec3(std::numeric_limits<float>::infinity())};
  boxes[5] = Aabb{vec3(-3e38f), vec3(3e38f)};
  Bvh bvh;
  bvh.build(boxes);
  EXPECT_THAT(bvh.items(), testing::Not(testing::Contains(3u)));
  Random random(8);
  for (int view = 0; view < 50; ++view) {
    const Frustum frustum = randomFrustum(random, 5);
    const std::vector<std::uint32_t> items = sortedQuery(bvh, frustum);
    EXPECT_EQ(items, bruteForce(frustum, boxes));
    EXPECT_THAT(items, testing::Contains(5u));
  }
}

// So near that the reciprocal of their distance overflows.
TEST(Bvh, HandlesBoxesThatAreAllButEqual) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 20; ++i)
    boxes.push_back(
        {vec3(0.f), vec3(static_cast<float>(i) * std::numeric_limits<float>::denorm_min())});
  Bvh bvh;
  bvh.build(boxes);
  EXPECT_EQ(bvh.items().size(), boxes.size());
}

TEST(Bvh, HandlesNothingAndManyEqualBoxes) {
  Bvh bvh;
  bvh.build({});
  EXPECT_TRUE(bvh.nodes().empty());
  Random random(9);
  EXPECT_TRUE(sortedQuery(bvh, randomFrustum(random, 1)).empty());

  const std::vector<Aabb> equal(10'000, Aabb{vec3(-1), vec3(1)});
  bvh.build(equal);
  const Frustum all = frustumOf(orthographicReversed(-5, 5, -5, 5, -5, 5));
  std::vector<std::uint32_t> every(equal.size());
  std::iota(every.begin(), every.end(), 0u);
  EXPECT_EQ(sortedQuery(bvh, all), every);
}

// Sizes and places that double make every surface-area split take off a single box.
TEST(Bvh, StaysWithinItsStackOnLopsidedInput) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 20'000; ++i) {
    const float x = std::ldexp(1.f, i % 80 - 40);
    boxes.push_back({vec3(x), vec3(x * 1.5f)});
  }
  Bvh bvh;
  bvh.build(boxes);
  Random random(10);
  for (int view = 0; view < 20; ++view) {
    const Frustum frustum = randomFrustum(random, 100);
    ASSERT_EQ(sortedQuery(bvh, frustum), bruteForce(frustum, boxes));
  }
}

// A crowd that wanders, round after round; now and then nearly all of it.
TEST(Bvh, FindsExactlyTheSameAfterRefitting) {
  std::vector<Aabb> boxes = randomBoxes(20'000, 11, 500, 8);
  Bvh bvh;
  bvh.build(boxes);
  Random random(12);
  int refitted = 0;
  for (int round = 0; round < 40; ++round) {
    const std::size_t count = round % 8 == 7 ? 15'000 : 200;
    std::vector<std::uint32_t> moved;
    std::vector<Aabb> to;
    for (std::size_t i = 0; i < count; ++i) {
      const auto item = static_cast<std::uint32_t>(random.below(20'000));
      const vec3 step = randomPoint(random, 5);
      boxes[item] = {boxes[item].min + step, boxes[item].max + step};
      moved.push_back(item);
      to.push_back(boxes[item]);
    }
    refitted += bvh.refit(moved, to);
    for (int view = 0; view < 10; ++view) {
      const Frustum frustum = randomFrustum(random, 500);
      ASSERT_EQ(sortedQuery(bvh, frustum), bruteForce(frustum, boxes)) << "round " << round;
    }
  }
  EXPECT_EQ(refitted, 40) << "small steps must not build the tree anew";
}

TEST(Bvh, IsBuiltAnewWhereRefittingWouldLeaveAPoorTree) {
  std::vector<Aabb> boxes = randomBoxes(5000, 13, 500, 2);
  Bvh bvh;
  bvh.build(boxes);
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  boxes = randomBoxes(5000, 14, 500, 2);  // everything elsewhere
  EXPECT_FALSE(bvh.refit(all, boxes));
  Bvh fresh;
  fresh.build(boxes);
  EXPECT_TRUE(std::ranges::equal(bvh.items(), fresh.items()));
}

TEST(Bvh, RefitsAcrossEmptyAndUnboundedBoxes) {
  std::vector<Aabb> boxes = randomBoxes(50, 15, 5, 1);
  const Aabb usual = boxes[3];
  Bvh bvh;
  bvh.build(boxes);
  Random random(16);
  const Aabb everywhere{vec3(-std::numeric_limits<float>::infinity()),
                        vec3(std::numeric_limits<float>::infinity())};
  for (const Aabb& box : {Aabb{}, usual, everywhere, Aabb{}, everywhere, usual}) {
    boxes[3] = box;
    const std::uint32_t item = 3;
    EXPECT_FALSE(bvh.refit({&item, 1}, {&box, 1}));
    for (int view = 0; view < 20; ++view) {
      const Frustum frustum = randomFrustum(random, 5);
      EXPECT_EQ(sortedQuery(bvh, frustum), bruteForce(frustum, boxes));
    }
  }
}

}  // namespace
}  // namespace lucerna::scene
