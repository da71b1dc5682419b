#include "passes/show_bvh/show_bvh.hpp"

#include <gtest/gtest.h>

namespace lucerna::passes {
namespace {

scene::Bvh rowOfBoxes(int count) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < count; ++i)
    boxes.push_back(
        {vec3(2.f * static_cast<float>(i), 0, 0), vec3(2.f * static_cast<float>(i) + 1.f, 1, 1)});
  scene::Bvh bvh;
  bvh.build(boxes);
  return bvh;
}

TEST(BoxesOfLevel, ZeroIsTheRoot) {
  const scene::Bvh bvh = rowOfBoxes(100);
  const std::vector<Aabb> boxes = boxesOfLevel(bvh, 0);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].min, vec3(0));
  EXPECT_EQ(boxes[0].max, vec3(199, 1, 1));
}

TEST(BoxesOfLevel, CoverTheSceneOnEveryLevel) {
  const scene::Bvh bvh = rowOfBoxes(100);
  std::size_t leaves = 0;
  for (const scene::Bvh::Node& node : bvh.nodes()) leaves += node.count > 0;
  EXPECT_EQ(boxesOfLevel(bvh, -1).size(), leaves);
  EXPECT_EQ(boxesOfLevel(bvh, 63).size(), leaves) << "below the leaves there is nothing to split";
  std::size_t before = 0;
  for (int level = 0; level < 8; ++level) {
    const std::vector<Aabb> boxes = boxesOfLevel(bvh, level);
    EXPECT_GE(boxes.size(), before);
    before = boxes.size();
    Aabb all;
    for (const Aabb& box : boxes) all.grow(box);
    EXPECT_EQ(all.min, vec3(0));
    EXPECT_EQ(all.max, vec3(199, 1, 1));
  }
}

TEST(BoxesOfLevel, OfAnEmptySceneAreNone) {
  scene::Bvh bvh;
  bvh.build({});
  EXPECT_TRUE(boxesOfLevel(bvh, -1).empty());
}

}  // namespace
}  // namespace lucerna::passes
