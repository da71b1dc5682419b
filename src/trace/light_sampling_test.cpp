#include "trace/light_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "trace/low_discrepancy.hpp"

namespace lucerna::trace {
namespace {

using scene::LightKind;
using scene::PlacedLight;

constexpr std::uint32_t kSamples = 1 << 14;

PlacedLight lightOf(LightKind kind) {
  PlacedLight light;
  light.kind = kind;
  light.positionW = {1, 5, -2};
  light.directionW = glm::normalize(vec3(0.2f, -1.f, 0.1f));
  light.intensity = {3, 2, 1};
  light.reach = kind == LightKind::Directional ? std::numeric_limits<float>::infinity() : 100.f;
  light.cosInner = 0.9f;
  light.cosOuter = 0.2f;
  return light;
}

// Irradiance on a surface that faces `normalW`.
glm::dvec3 irradianceAt(const PlacedLight& light, vec3 positionW, vec3 normalW) {
  glm::dvec3 sum(0.);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const LightSample s = sampleLight(light, positionW, lowDiscrepancyPoint(i, 3));
    EXPECT_NEAR(glm::length(s.toLightW), 1.f, 1e-5f);
    sum += glm::dvec3(s.irradiance * std::max(glm::dot(normalW, s.toLightW), 0.f));
  }
  return sum / static_cast<double>(kSamples);
}

// Whatever its size: that is how the radiance of spheres and cones is defined.
TEST(LightSampling, SpheresAndConesGiveWhatTheLightStates) {
  for (const float radius : {0.f, 0.01f, 0.5f, 3.f}) {
    PlacedLight light = lightOf(LightKind::Point);
    light.radius = radius;
    const vec3 place(0, 0, 1);
    const vec3 toLight = light.positionW - place;
    const glm::dvec3 found = irradianceAt(light, place, glm::normalize(toLight));
    const glm::dvec3 wanted(light.intensity * attenuationAt(light, glm::length(toLight)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / wanted[c], 1., 1e-4) << radius;
  }
  for (const float angle : {0.f, 0.0093f, 0.5f, 2.f}) {
    PlacedLight light = lightOf(LightKind::Directional);
    light.angle = angle;
    const glm::dvec3 found = irradianceAt(light, vec3(0), -light.directionW);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / light.intensity[c], 1., 1e-4) << angle;
  }
}

// A sphere wholly above the horizon gives a tilted surface the cosine of its centre, exactly.
TEST(LightSampling, ATiltedSurfaceGetsTheCosine) {
  PlacedLight light = lightOf(LightKind::Point);
  light.radius = 1.5f;
  const vec3 toLight = glm::normalize(light.positionW);
  const vec3 normal = glm::normalize(toLight + 0.8f * vec3(toLight.y, -toLight.x, 0));
  const double wanted = static_cast<double>(attenuationAt(light, glm::length(light.positionW)) *
                                            glm::dot(normal, toLight));
  EXPECT_NEAR(irradianceAt(light, vec3(0), normal).z / wanted, 1., 1e-4);
}

// The distance ends on the sphere, the disc and nowhere.
TEST(LightSampling, DistancesEndOnTheLight) {
  PlacedLight sphere = lightOf(LightKind::Point), disc = lightOf(LightKind::Spot);
  sphere.radius = disc.radius = 0.7f;
  const vec3 place(0.3f, 0.f, 0.4f);
  for (std::uint32_t i = 0; i < 256; ++i) {
    const vec2 u = lowDiscrepancyPoint(i, 1);
    const LightSample s = sampleLight(sphere, place, u), d = sampleLight(disc, place, u);
    const vec3 onSphere = place + s.toLightW * s.distance, onDisc = place + d.toLightW * d.distance;
    EXPECT_NEAR(glm::distance(onSphere, sphere.positionW), 0.7f, 1e-3f);
    EXPECT_LE(glm::distance(onDisc, disc.positionW), 0.7001f);
    EXPECT_NEAR(glm::dot(onDisc - disc.positionW, disc.directionW), 0.f, 1e-5f);
  }
  EXPECT_TRUE(std::isinf(sampleLight(lightOf(LightKind::Directional), place, vec2(0.5f)).distance));
}

// The quick test never leaves out what a sample would have found.
TEST(LightSampling, NothingThatLightsIsPassedOver) {
  Random random(11);
  int lit = 0, passedOver = 0;
  for (int i = 0; i < 20000; ++i) {
    PlacedLight light = lightOf(static_cast<LightKind>(i % 3));
    light.radius = random.uniform(0, 1);
    light.angle = random.uniform(0, 1);
    if (light.kind != LightKind::Directional) light.reach = random.uniform(0.5f, 8.f);
    light.cosOuter = random.uniform(-0.5f, 0.9f);
    const auto vector = [&](float size) {
      return vec3(random.uniform(-size, size), random.uniform(-size, size),
                  random.uniform(-size, size));
    };
    const vec3 place = light.positionW + vector(6.f), normal = glm::normalize(vector(1.f));
    const LightSample s = sampleLight(light, place, {random.uniform(), random.uniform()});
    const bool lights = glm::dot(s.toLightW, normal) > 1e-5f && s.irradiance.x > 0.f;
    const bool may = mayLight(light, place, normal);
    EXPECT_TRUE(may || !lights) << i;
    lit += lights;
    passedOver += !may;
  }
  EXPECT_GT(lit, 2000);
  EXPECT_GT(passedOver, 8000);
}

TEST(LightSampling, ASpotLightKeepsToItsCone) {
  PlacedLight light = lightOf(LightKind::Spot);
  light.radius = 0.1f;
  const vec3 outside = light.positionW - 2.f * light.directionW;
  EXPECT_EQ(sampleLight(light, outside, vec2(0.3f)).irradiance, vec3(0.f));
  const vec3 onAxis = light.positionW + 2.f * light.directionW;
  EXPECT_GT(sampleLight(light, onAxis, vec2(0.3f)).irradiance.x, 0.f);
}

}  // namespace
}  // namespace lucerna::trace
