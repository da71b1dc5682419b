#include "passes/cull/cull.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"

namespace lucerna::passes {
namespace {

// The trap "unnormalised frustum planes": a scaled projection shows the same picture, so the planes
// taken from it must find the same objects. Also with the eye inside a box.
TEST(CullFrustum, DoesNotDependOnTheScaleOfTheProjection) {
  Random random(5);
  scene::Bvh bvh;
  std::vector<Aabb> boxes;
  for (int i = 0; i < 500; ++i) {
    const vec3 center(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50));
    boxes.push_back({center - random.uniform(0.1f, 3.f), center + random.uniform(0.1f, 3.f)});
  }
  boxes.push_back({vec3(-1.f), vec3(1.f)});  // around the eye
  bvh.build(boxes);
  const mat4 clip = perspectiveReversed(0.8f, 1.5f, 0.1f, 60.f);
  std::vector<std::uint32_t> expected;
  bvh.query(frustumOf(clip), expected);
  std::ranges::sort(expected);
  EXPECT_THAT(expected, ::testing::Contains(500u));
  EXPECT_LT(expected.size(), 200u);
  for (const float scale : {1e-3f, 1e3f}) {
    std::vector<std::uint32_t> found;
    bvh.query(frustumOf(scale * clip), found);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << "scale " << scale;
  }
}

}  // namespace
}  // namespace lucerna::passes
