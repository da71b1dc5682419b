// Shadow-map projections: what the thesis and the paper promise of them, for any light and view.
#include "render/shadow_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/frustum.hpp"
#include "core/random.hpp"

namespace lucerna::render {
namespace {

const Aabb kBoxW{vec3(-100, 0, -400), vec3(100, 30, 20)};

// From a street, 1.7 m above it.
scene::View streetView(vec3 forwardW = {0, 0, -1}) {
  scene::View view;
  view.viewFromWorld = glm::lookAt(vec3(0, 1.7f, 0), vec3(0, 1.7f, 0) + forwardW,
                                   std::abs(forwardW.y) < 0.9f ? vec3(0, 1, 0) : vec3(0, 0, 1));
  view.worldFromView = glm::inverse(view.viewFromWorld);
  view.near = 0.1f;
  view.far = 500.f;
  view.clipFromView = perspectiveReversed(0.9f, 1.6f, view.near, view.far);
  return view;
}

// At `degrees` from the view direction of streetView().
vec3 lightAt(double degrees) {
  const double angle = degrees * kPi / 180.;
  return {0.f, -static_cast<float>(std::sin(angle)), -static_cast<float>(std::cos(angle))};
}

// Points of the box that the view sees, towards the corners more than inside.
std::vector<vec3> visiblePoints(const scene::View& view, int count) {
  const std::vector<vec3> body = visibleBody(std::vector{view}, kBoxW);
  Random random(7);
  std::vector<vec3> points = body;
  while (!body.empty() && points.size() < static_cast<std::size_t>(count)) {
    vec3 sum(0.f);
    float weights = 0.f;
    for (const vec3& corner : body) {
      const float weight = std::pow(random.uniform(), 8.f);
      sum += weight * corner;
      weights += weight;
    }
    points.push_back(sum / weights);
  }
  return points;
}

vec3 ndcOf(const ShadowProjection& projection, vec3 pointW) {
  const vec4 clip = projection.clipFromWorld() * vec4(pointW, 1.f);
  return vec3(clip) / clip.w;
}

// The ground and two rows of houses.
scene::Bvh street() {
  std::vector<Aabb> boxes{{vec3(-100, 0, -400), vec3(100, 0, 20)}};
  for (int i = 0; i < 8; ++i)
    for (const float x : {-30.f, 15.f}) {
      const vec3 corner(x, 0.f, -50.f * static_cast<float>(i) - 20.f);
      boxes.push_back({corner, corner + vec3(15, 25, 40)});
    }
  scene::Bvh bvh;
  bvh.build(boxes);
  return bvh;
}

float warpOf(vec3 directionW, const std::vector<scene::View>& views) {
  return automaticWarp(directionW, visibleBody(views, kBoxW), visibleSamples(views, street()),
                       viewerOf(views));
}

ShadowProjection projectionOf(vec3 directionW, const scene::View& view, float warpFactor = 1.f) {
  const std::vector<scene::View> views{view};
  const std::vector<vec3> body = visibleBody(views, kBoxW);
  const Viewer viewer = viewerOf(views);
  return directionalProjection(directionW, body, kBoxW, viewer,
                               warpFactor * warpOf(directionW, views), 0.f);
}

// Where the light is in line with the view there is nothing to warp; on the way there nothing
// jumps: from one tenth of a degree to the next no point moves over the map by a fiftieth of it
// more than it does in a uniform map, whose points move because the light does.
TEST(ShadowProjection, ASweepOfTheLightIsFiniteWithoutPopsAndCoversAllReceivers) {
  const scene::View view = streetView();
  const std::vector<vec3> points = visiblePoints(view, 200);
  std::vector<vec3> last, lastUniform;
  for (int step = 0; step <= 1800; ++step) {
    const vec3 directionW = lightAt(0.1 * step);
    const ShadowProjection projection = projectionOf(directionW, view);
    const float warp = warpOf(directionW, {view});
    if (step == 0 || step == 1800) {
      EXPECT_NEAR(warp, 0.f, 1e-3f) << "fell back to a uniform map";
    }
    const ShadowProjection uniformProjection = projectionOf(directionW, view, 0.f);
    std::vector<vec3> here, uniform;
    for (const vec3& point : points) {
      here.push_back(ndcOf(projection, point));
      uniform.push_back(ndcOf(uniformProjection, point));
      for (int axis = 0; axis < 2; ++axis) {
        ASSERT_TRUE(std::isfinite(here.back()[axis]));
        EXPECT_LE(std::abs(here.back()[axis]), 1.0001f) << "at " << 0.1 * step << " degrees";
      }
      EXPECT_GE(here.back().z, -1e-5f);
      EXPECT_LE(here.back().z, 1.f);
    }
    for (std::size_t i = 0; i < last.size(); ++i) {
      EXPECT_LT(glm::distance(vec2(here[i]), vec2(last[i])),
                0.04f + glm::distance(vec2(uniform[i]), vec2(lastUniform[i])))
          << "at " << 0.1 * step << " degrees, point " << i;
    }
    last = here, lastUniform = uniform;
  }
}

TEST(ShadowProjection, ManyViewsAndLightsCoverAllReceivers) {
  Random random(3);
  const auto direction = [&] {
    vec3 d(0.f);
    while (glm::length(d) < 0.1f || glm::length(d) > 1.f)
      d = {random.uniform(-1.f, 1.f), random.uniform(-1.f, 1.f), random.uniform(-1.f, 1.f)};
    return glm::normalize(d);
  };
  for (int i = 0; i < 200; ++i) {
    const scene::View view = streetView(direction());
    const ShadowProjection projection = projectionOf(direction(), view, random.uniform(0.f, 4.f));
    for (const vec3& point : visiblePoints(view, 50)) {
      const vec3 ndc = ndcOf(projection, point);
      EXPECT_LE(std::max(std::abs(ndc.x), std::abs(ndc.y)), 1.001f);
      EXPECT_GE(ndc.z, -1e-4f);
      EXPECT_LE(ndc.z, 1.f);
    }
  }
}

// Eyes that look different ways share a map that shows what either sees.
TEST(ShadowProjection, AGroupsMapCoversWhatEachOfItsViewsSees) {
  const std::vector<scene::View> views{streetView({0.3f, 0, -1}), streetView({-0.9f, 0, -0.2f})};
  const vec3 directionW = glm::normalize(vec3(-0.3f, -1, 0.2f));
  const std::vector<vec3> body = visibleBody(views, kBoxW);
  const ShadowProjection projection = directionalProjection(
      directionW, body, kBoxW, viewerOf(views), warpOf(directionW, views), 0.f);
  for (const scene::View& view : views)
    for (const vec3& point : visiblePoints(view, 50)) {
      const vec3 ndc = ndcOf(projection, point);
      EXPECT_LE(std::max(std::abs(ndc.x), std::abs(ndc.y)), 1.001f);
      EXPECT_GE(ndc.z, -1e-4f);
    }
}

// Whatever lies between a receiver and the light is in the map, wherever the camera is.
TEST(ShadowProjection, CastersBehindTheCameraAreInTheMap) {
  const scene::View view = streetView();
  const vec3 directionW = glm::normalize(vec3(0, -1, -3));  // the light comes from behind
  const ShadowProjection projection = projectionOf(directionW, view);
  const vec3 receiver(1, 0, -4), caster = receiver - 12.f * directionW;
  ASSERT_GT(caster.z, 2.f) << "behind the camera";
  const vec3 ndc = ndcOf(projection, caster);
  EXPECT_LE(ndc.z, 1.f);
  EXPECT_GT(ndc.z, ndcOf(projection, receiver).z);
  EXPECT_LT(glm::distance(vec2(ndc), vec2(ndcOf(projection, receiver))), 1e-4f);
  EXPECT_TRUE(intersects(frustumOf(projection.clipFromWorld()), {caster, caster}));
}

// The worth of it: texels near the camera are far smaller than a uniform map's.
TEST(ShadowProjection, TheWarpMakesTexelsSmallWhereTheCameraIs) {
  const scene::View view = streetView();
  const vec3 directionW = glm::normalize(vec3(-0.3f, -1, 0.2f));
  const auto texelAt = [&](const ShadowProjection& p, vec3 point) {
    const float w = (p.clipFromWorld() * vec4(point, 1.f)).w;
    return std::max(p.side.x * w, p.side.y * w * w);
  };
  const vec3 here(0, 0, -4), there(0, 0, -380);
  const ShadowProjection uniform = projectionOf(directionW, view, 0.f);
  const ShadowProjection warped = projectionOf(directionW, view);
  EXPECT_FLOAT_EQ(texelAt(uniform, here), texelAt(uniform, there));
  EXPECT_LT(texelAt(warped, here), 0.2f * texelAt(uniform, here));
  EXPECT_LT(texelAt(warped, there), 20.f * texelAt(uniform, there));
}

// The stated size of texels is that of the matrix.
TEST(ShadowProjection, SidesAreThoseOfTheMatrix) {
  const scene::View view = streetView();
  const vec3 directionW = glm::normalize(vec3(-0.3f, -1, 0.2f));
  const ShadowProjection p = projectionOf(directionW, view);
  const mat4 world = glm::inverse(p.viewFromWorld);
  for (const vec3 point : {vec3(0, 0, -4), vec3(10, 3, -80)}) {
    const float w = (p.clipFromWorld() * vec4(point, 1.f)).w, step = 1e-3f * w;
    const float dx = std::abs(ndcOf(p, point + step * vec3(world[0])).x - ndcOf(p, point).x);
    const float dy = std::abs(ndcOf(p, point + step * vec3(world[1])).y - ndcOf(p, point).y);
    EXPECT_NEAR(2.f * step / dx, p.side.x * w, 0.02f * p.side.x * w);
    EXPECT_NEAR(2.f * step / dy, p.side.y * w * w, 0.02f * p.side.y * w * w);
    EXPECT_LE(std::abs(ndcOf(p, point + step * vec3(world[1])).x - ndcOf(p, point).x) / dy,
              p.shear * p.side.y * w * w / (p.side.x * w));
  }
}

TEST(ShadowProjection, ALampsMapIsCroppedToWhatIsSeen) {
  const std::vector<scene::View> views{streetView()};
  const LightPyramid lamp{
      .positionW = {0, 8, -20}, .axisW = {0, -1, 0}, .tangent = 1.f, .reach = 20.f};
  const ShadowProjection projection = localProjection(lamp, litBody(lamp, views, kBoxW), 0.f);
  EXPECT_LE(projection.side.x, 2.001f);
  for (const vec3 point : {vec3(0, 0, -20), vec3(3, 0, -22), vec3(-3, 1, -24)}) {
    const vec3 ndc = ndcOf(projection, point);
    EXPECT_LE(std::max(std::abs(ndc.x), std::abs(ndc.y)), 1.f);
    EXPECT_GE(ndc.z, 0.f);
    EXPECT_LT(ndc.z, 1.f);
  }
  const LightPyramid behind{
      .positionW = {0, 8, 15}, .axisW = {0, -1, 0}, .tangent = 0.5f, .reach = 20.f};
  EXPECT_TRUE(litBody(behind, views, kBoxW).empty());
  // Half of what this one lights is beside the picture.
  const LightPyramid beside{
      .positionW = {22, 8, -20}, .axisW = {0, -1, 0}, .tangent = 1.f, .reach = 20.f};
  const ShadowProjection cropped = localProjection(beside, litBody(beside, views, kBoxW), 0.f);
  const vec3 seen = ndcOf(cropped, {15, 0, -20}), unseen = ndcOf(cropped, {29, 0, -20});
  EXPECT_LE(std::max(std::abs(seen.x), std::abs(seen.y)), 1.f);
  EXPECT_GT(std::max(std::abs(unseen.x), std::abs(unseen.y)), 1.f);
}

}  // namespace
}  // namespace lucerna::render
