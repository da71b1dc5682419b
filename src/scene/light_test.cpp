#include "scene/light.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lucerna::scene {
namespace {

Light pointLight() {
  Light light;
  light.intensity = kPi;
  return light;
}

TEST(Reach, IsTheStatedRange) {
  Light light = pointLight();
  light.range = 12.f;
  EXPECT_EQ(reach(light), 12.f);
}

TEST(Reach, IsWhereTheAttenuationFallsTo1Of256) {
  Light light = pointLight();
  EXPECT_FLOAT_EQ(reach(light), 16.f);  // 1 / d^2 = 1 / 256
  light.attenuation = {1.f, 0.5f, 0.f};
  EXPECT_FLOAT_EQ(reach(light), 510.f);
  light.attenuation = {0.5f, 0.25f, 0.125f};
  const float d = reach(light);
  EXPECT_NEAR(1.f / (0.5f + 0.25f * d + 0.125f * d * d), 1.f / 256.f, 1e-7f);
}

TEST(Reach, GrowsWithTheBrightestChannel) {
  Light light = pointLight();
  light.color = {0.25f, 4.f, 1.f};
  EXPECT_FLOAT_EQ(reach(light), 32.f);
}

TEST(Reach, IsInfiniteWhereNothingFades) {
  Light light = pointLight();
  light.attenuation = {1.f, 0.f, 0.f};
  EXPECT_TRUE(std::isinf(reach(light)));
  light.kind = LightKind::Directional;
  light.range = 3.f;
  EXPECT_TRUE(std::isinf(reach(light)));
}

TEST(Reach, OfADarkLightIsZero) {
  Light light = pointLight();
  light.intensity = 0.f;
  EXPECT_EQ(reach(light), 0.f);
}

TEST(Attenuation, FadesToZeroAtTheReachWithoutAStep) {
  Light light = pointLight();
  const PlacedLight placed = place(light, mat4(1.f));
  EXPECT_NEAR(attenuationAt(placed, 1.f), 1.f, 1e-4f);
  EXPECT_EQ(attenuationAt(placed, 16.f), 0.f);
  EXPECT_EQ(attenuationAt(placed, 20.f), 0.f);
  float previous = attenuationAt(placed, 0.01f);
  for (float d = 0.02f; d < 16.f; d += 0.01f) {
    const float a = attenuationAt(placed, d);
    EXPECT_LT(a, previous) << d;
    previous = a;
  }
  EXPECT_LT(previous, 1e-6f);
}

TEST(Attenuation, IsFiniteAtTheLightItself) {
  EXPECT_FLOAT_EQ(attenuationAt(place(pointLight(), mat4(1.f)), 0.f), 1e4f);
}

TEST(Attenuation, OfAnInfiniteReachHasNoWindow) {
  Light light = pointLight();
  light.attenuation = {2.f, 0.f, 0.f};
  EXPECT_FLOAT_EQ(attenuationAt(place(light, mat4(1.f)), 1e6f), 0.5f);
}

TEST(Cone, IsOneInsideAndZeroOutside) {
  Light light = pointLight();
  light.kind = LightKind::Spot;
  light.innerCone = 0.3f;
  light.outerCone = 0.6f;
  const PlacedLight placed = place(light, mat4(1.f));
  EXPECT_FLOAT_EQ(coneFactor(placed, std::cos(0.2f)), 1.f);
  EXPECT_EQ(coneFactor(placed, std::cos(0.61f)), 0.f);
  const float half = 0.5f * (placed.cosInner + placed.cosOuter);
  EXPECT_NEAR(coneFactor(placed, half), 0.25f, 1e-5f);
}

TEST(Cone, ExponentNarrowsTheLight) {
  Light light = pointLight();
  light.kind = LightKind::Spot;
  light.innerCone = light.outerCone = 1.5f;
  light.exponent = 8.f;
  EXPECT_FLOAT_EQ(coneFactor(place(light, mat4(1.f)), 0.5f), std::pow(0.5f, 8.f));
}

TEST(Cone, OfOtherKindsIsOne) {
  EXPECT_EQ(coneFactor(place(pointLight(), mat4(1.f)), -1.f), 1.f);
}

TEST(Place, LooksAlongMinusZWithoutTheNodesScale) {
  Light light = pointLight();
  light.ambientIntensity = 0.5f;
  mat4 m = glm::translate(mat4(1.f), vec3(1, 2, 3));
  m = glm::scale(glm::rotate(m, 0.5f * kPi, vec3(0, 1, 0)), vec3(7.f));
  const PlacedLight placed = place(light, m);
  EXPECT_EQ(placed.positionW, vec3(1, 2, 3));
  EXPECT_LT(glm::length(placed.directionW - vec3(-1, 0, 0)), 1e-6f);
  EXPECT_FLOAT_EQ(placed.ambient.x, 0.5f);
}

}  // namespace
}  // namespace lucerna::scene
