// Which samples lie inside of solids, beside boxes of which that is known.
#include "bake/hidden.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bake/unit_light.hpp"
#include "core/random.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::bake {
namespace {

using trace::testing::addMaterial;
using trace::testing::addSquare;
using trace::testing::emptyScene;

struct Box {
  vec3 centre{0.f}, half{1.f};
  quat turn{1.f, 0.f, 0.f, 0.f};

  // m out of it: below 0 inside.
  float distance(vec3 p) const {
    const vec3 d = glm::abs(glm::inverse(turn) * (p - centre)) - half;
    return std::max({d.x, d.y, d.z});
  }
};

// Six squares, turned by their nodes.
void addBox(scene::Scene& scene, const Box& box) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      vec3 n(0.f), a(0.f), b(0.f);
      n[axis] = side * box.half[axis];
      a[(axis + 1) % 3] = box.half[(axis + 1) % 3];
      b[(axis + 2) % 3] = side * box.half[(axis + 2) % 3];
      addSquare(scene, n, a, b);
      scene::Node& node = scene.nodes[scene.objects.back().node];
      node.translation = box.centre;
      node.rotation = box.turn;
    }
  updateTransforms(scene);
}

// A floor, and boxes all over each other: large ones, posts and walls thinner than a texel.
std::vector<Box> manyBoxes(Random& random) {
  std::vector<Box> boxes{{.centre = {0, -0.4f, 0}, .half = {5, 0.4f, 5}}};
  for (int i = 0; i < 30; ++i) {
    const auto any = [&](float low, float high) {
      return vec3(random.uniform(low, high), random.uniform(low, high), random.uniform(low, high));
    };
    Box& box = boxes.emplace_back();
    box.centre = any(-3.f, 3.f) * vec3(1.f, 0.3f, 1.f);
    box.half = any(0.1f, 1.2f);
    if (i % 3 == 1) box.half.x = 0.03f;
    if (i % 5 == 1) box.half.z = 0.03f;
    if (i % 2) box.turn = glm::angleAxis(random.uniform(0.f, 6.f), glm::normalize(any(-1.f, 1.f)));
  }
  return boxes;
}

// Of all samples with `side` along a texel's side: visit(sample, where it lies, whether it is
// left).
template <typename Visit>
void eachSample(const scene::Scene& scene, int side, const Visit& visit) {
  BakeSettings settings;
  settings.density = 7.f;
  settings.pack.side = 1024;
  Result<Plan> plan = makePlan(scene, settings);
  ASSERT_TRUE(plan) << plan.error().message;
  const LightScene light(*plan);
  HiddenSamples hidden(*plan, light.rays, light.occluders, light.parts);
  for (const Block& block : plan->blocks) {
    Samples all;
    ChartSampler(plan->world, plan->charts.charts[block.chart], side).sample(block, all);
    Samples left = all;
    hidden.remove(left, block.chart);
    const auto at = [](const Samples& s, std::size_t i) { return vec3(s.x[i], s.y[i], s.z[i]); };
    std::size_t next = 0;  // of those left, which keep their order
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool isLeft = next < left.size() && at(left, next) == at(all, i);
      next += isLeft;
      visit(at(all, i), isLeft);
    }
    EXPECT_EQ(next, left.size());
  }
}

struct Counts {
  std::size_t inside = 0, outside = 0, insideLeft = 0, outsideGone = 0;
};
Counts count(const scene::Scene& scene, const std::vector<Box>& boxes, int side) {
  Counts counts;
  eachSample(scene, side, [&](vec3 p, bool isLeft) {
    float distance = 1e9f;
    for (const Box& box : boxes) distance = std::min(distance, box.distance(p));
    // Samples are that far off their own box.
    if (distance > -1e-3f && distance < 1e-6f) return;
    ++(distance < 0.f ? counts.inside : counts.outside);
    counts.insideLeft += distance < 0.f && isLeft;
    counts.outsideGone += distance > 0.f && !isLeft;
  });
  return counts;
}

TEST(HiddenSamples, AreThoseInsideOfBoxes) {
  Random random(5);
  for (int k = 0; k < 5; ++k) {
    scene::Scene scene = emptyScene();
    addMaterial(scene).doubleSided = false;
    const std::vector<Box> boxes = manyBoxes(random);
    for (const Box& box : boxes) addBox(scene, box);
    const Counts one = count(scene, boxes, 1);
    EXPECT_GT(one.inside, 3000u);
    EXPECT_GT(one.outside, 3000u);
    EXPECT_EQ(one.insideLeft, 0u) << k;
    EXPECT_EQ(one.outsideGone, 0u) << k;
    // Of several to a texel, also those go that something divides from the texel's middle.
    const Counts many = count(scene, boxes, 4);
    EXPECT_EQ(many.insideLeft, 0u) << k;
    EXPECT_LT(many.outsideGone, many.outside / 10) << k;
  }
}

}  // namespace
}  // namespace lucerna::bake
