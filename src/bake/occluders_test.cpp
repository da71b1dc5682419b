#include "bake/occluders.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/light_scenes.hpp"
#include "bake/shadow_tracer.hpp"
#include "core/random.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;

vec3 inCube(Random& random, float half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

// A rectangle that is lit, and cards around it, all somewhere.
struct Stage {
  scene::Scene scene;
  World world;
  Samples samples;
  vec3 place, normal;

  explicit Stage(Random& random) {
    addSurface(scene);
    const float far = random.uniform(0, 1) < 0.3f ? 1000.f : 3.f;
    place = inCube(random, far);
    const vec3 u = glm::normalize(inCube(random, 1)), v = glm::normalize(inCube(random, 1));
    const vec3 a = u * random.uniform(0.05f, 2.f);
    const vec3 b = glm::normalize(v - u * glm::dot(u, v)) * random.uniform(0.05f, 2.f);
    normal = glm::normalize(glm::cross(a, b));
    addRectangle(scene, place, a, b);
    for (int i = 0; i < 3; ++i) {
      const float size = random.uniform(0.02f, 0.4f);
      addRectangle(scene, place + inCube(random, 3.f), size * inCube(random, 1),
                   size * inCube(random, 1));
    }
    world = makeWorld(scene);
    const Charts charts = makeCharts(world, {.density = 5.f});
    for (const Chart& chart : charts.charts) {
      if (chart.object != 0) continue;
      ChartSampler sampler(world, chart, 1);
      sampler.sample({.size = chart.size}, samples);
      break;
    }
  }
  // Of rays from the points that `from` gives for each sample.
  template <typename From>
  bool anyBlocked(const From& from) const {
    ShadowRays rays;
    rays.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const vec3 to(samples.x[i], samples.y[i], samples.z[i]);
      const vec3 start = from(to);
      rays.fromX[i] = start.x, rays.fromY[i] = start.y, rays.fromZ[i] = start.z;
      rays.toX[i] = to.x, rays.toY[i] = to.y, rays.toZ[i] = to.z;
    }
    std::vector<vec3> shares(rays.size());
    makeEmbreeTracer(world)->trace(rays, shares);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool above =
          glm::dot(normal, vec3(rays.fromX[i], rays.fromY[i], rays.fromZ[i]) - place) > 0.f;
      if (above && shares[i] != vec3(1.f)) return true;
    }
    return false;
  }
};

TEST(Occluders, AreInAShaftIfTheyBlockARay) {
  Random random(3);
  int clear = 0, blocked = 0;
  for (int k = 0; k < 1500; ++k) {
    const Stage stage(random);
    ASSERT_TRUE(stage.samples.planar) << k << ' ' << stage.samples.size() << ' '
                                      << stage.samples.cosine - 1 << ' ' << stage.place.x;
    const vec3 centre = stage.place + inCube(random, 3.f) + stage.normal * random.uniform(0, 3);
    const float radius = random.uniform(0, 1) < 0.5f ? 0.f : random.uniform(0, 0.5f);
    const Occluders occluders(stage.world);
    const bool any = occluders.anyIn(shaftFrom(centre, radius, stage.samples));
    clear += !any;
    for (int i = 0; i < 8; ++i) {
      const vec3 offset = radius * glm::normalize(inCube(random, 1));
      if (!stage.anyBlocked([&](vec3) { return centre + offset; })) continue;
      ++blocked;
      ASSERT_TRUE(any) << k;
    }
  }
  EXPECT_GT(clear, 200);
  EXPECT_GT(blocked, 200);
}

TEST(Occluders, AreInAShaftToTheSunIfTheyBlockARay) {
  Random random(4);
  int clear = 0, blocked = 0;
  for (int k = 0; k < 1500; ++k) {
    const Stage stage(random);
    const vec3 axis = glm::normalize(inCube(random, 1) + stage.normal);
    const float half = random.uniform(0, 1) < 0.5f ? 0.f : random.uniform(0, 0.5f);
    constexpr float kLength = 12.f;
    const Occluders occluders(stage.world);
    const bool any = occluders.anyIn(shaftAlong(axis, std::sin(half), kLength, stage.samples));
    clear += !any;
    for (int i = 0; i < 8; ++i) {
      const vec3 across = glm::normalize(glm::cross(axis, inCube(random, 1)));
      const vec3 toLight = std::cos(half) * axis + std::sin(half) * across;
      if (!stage.anyBlocked([&](vec3 to) { return to + kLength * toLight; })) continue;
      ++blocked;
      ASSERT_TRUE(any) << k;
    }
  }
  EXPECT_GT(clear, 200);
  EXPECT_GT(blocked, 200);
}

}  // namespace
}  // namespace lucerna::bake
