// One surface, one light, one formula; through Lighting and through Forward.
#include <gtest/gtest.h>

#include <cmath>

#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{33, 33};  // odd: the middle pixel looks along the axis

scene::Light lightOf(scene::LightKind kind, float intensity) {
  scene::Light light;
  light.kind = kind;
  light.intensity = intensity;
  return light;
}

class Shading : public ::testing::TestWithParam<std::string> {
 protected:
  Image radiance(const scene::Scene& scene) const {
    const bool deferred = GetParam() == "Lighting";
    const graph::Pipeline pipeline =
        testing::rows(deferred ? std::vector<std::string>{"Cull", "GBuffer", "Lighting"}
                               : std::vector<std::string>{"Cull", "Forward"});
    return testing::valueOf(scene, pipeline, kSize, GetParam() + ".color");
  }
  void TearDown() override { testing::expectNoDebugMessages(); }
};
INSTANTIATE_TEST_SUITE_P(By, Shading, ::testing::Values("Lighting", "Forward"),
                         [](const auto& parameter) { return parameter.param; });

void expectNear(vec3 found, vec3 expected, float relative) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(found[c], expected[c], relative * std::max(expected[c], 0.01f)) << "channel " << c;
}

TEST_P(Shading, AWhiteWallInALightOfIntensityPiHasBrightnessOne) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 3.f).model = scene::MaterialModel::Phong;
  testing::addLight(scene, lightOf(scene::LightKind::Directional, kPi), {0, 0, 0}, {0, 0, -1});
  updateTransforms(scene);
  expectNear(testing::centerOf(radiance(scene)), vec3(1.f), 0.002f);
}

TEST_P(Shading, PhongFollowsItsFormula) {
  scene::Scene scene = testing::emptyScene();
  scene.ambient = vec3(0.1f, 0.2f, 0.3f);
  scene::Material& wall = testing::addWall(scene, 3.f);
  wall.model = scene::MaterialModel::Phong;
  wall.albedo = {1.f, 0.5f, 0.25f, 1.f};
  wall.specular = vec3(0.5f);
  wall.shininess = 20.f;
  const vec3 position(0.6f, 0.8f, -0.5f);
  testing::addLight(scene, lightOf(scene::LightKind::Point, 15.f), position, {0, 0, -3});
  updateTransforms(scene);

  const vec3 point(0, 0, -3), normal(0, 0, 1), toEye(0, 0, 1);
  const vec3 toLight = glm::normalize(position - point);
  const float distance = glm::distance(position, point);
  const float e = 15.f / (distance * distance) * [&] {
    const float r = distance / std::sqrt(15.f / kPi * 256.f);
    const float w = 1.f - r * r * r * r;
    return w * w;
  }();
  const float cosLight = glm::dot(normal, toLight);
  const vec3 reflected = glm::reflect(-toLight, normal);
  const vec3 albedo(wall.albedo);
  const vec3 expected = scene.ambient * albedo + albedo * (e * cosLight / kPi) +
                        wall.specular * (e / kPi) * std::pow(glm::dot(toEye, reflected), 20.f);
  expectNear(testing::centerOf(radiance(scene)), expected, 0.01f);
}

TEST_P(Shading, MetallicRoughnessFollowsItsFormulaHeadOn) {
  for (const float roughness : {0.2f, 0.4f, 0.8f})
    for (const float metallic : {0.f, 1.f}) {
      scene::Scene scene = testing::emptyScene();
      scene::Material& wall = testing::addWall(scene, 3.f);
      wall.albedo = {0.8f, 0.4f, 0.2f, 1.f};
      wall.roughness = std::round(roughness * 255.f) / 255.f;  // as the G-buffer stores it
      wall.metallic = metallic;
      testing::addLight(scene, lightOf(scene::LightKind::Directional, 2.f), {0, 0, 0}, {0, 0, -1});
      updateTransforms(scene);
      // n = l = v = h: D = 1 / (pi alpha^2), V = 1/4, F = F0.
      const float alpha = wall.roughness * wall.roughness;
      const vec3 albedo(wall.albedo);
      const vec3 f0 = glm::mix(vec3(0.04f), albedo, metallic);
      const vec3 expected =
          2.f * ((1.f - f0) * (1.f - metallic) * albedo / kPi + 0.25f * f0 / (kPi * alpha * alpha));
      expectNear(testing::centerOf(radiance(scene)), expected, 0.02f);
    }
}

// The trap "specular where l.n <= 0": a light behind the wall whose mirrored ray still meets the
// eye.
TEST_P(Shading, ALightBehindTheSurfaceLeavesNoHighlight) {
  for (const auto model : {scene::MaterialModel::Phong, scene::MaterialModel::MetallicRoughness}) {
    scene::Scene scene = testing::emptyScene();
    scene::Material& wall = testing::addWall(scene, 3.f);
    wall.model = model;
    wall.specular = vec3(1.f);
    wall.shininess = 1.f;
    wall.roughness = 0.9f;
    testing::addLight(scene, lightOf(scene::LightKind::Directional, 100.f), {0, 0, -5},
                      {0.9f, 0, -4});
    testing::addLight(scene, lightOf(scene::LightKind::Point, 100.f), {1, 0, -3.5f}, {0, 0, -3});
    updateTransforms(scene);
    const Image values = converted(radiance(scene), ComponentType::F32, 3);
    for (const float value : values.as<float>()) ASSERT_EQ(value, 0.f);
  }
}

TEST_P(Shading, ALightGivesNothingBeyondItsRange) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 3.f);
  scene::Light light = lightOf(scene::LightKind::Point, 1000.f);
  light.range = 2.9f;
  testing::addLight(scene, light, {0, 0, 0}, {0, 0, -1});
  updateTransforms(scene);
  EXPECT_EQ(testing::centerOf(radiance(scene)), vec3(0.f));
}

TEST_P(Shading, AmbientLightReachesEverySideAndHasAFactor) {
  scene::Scene scene = testing::emptyScene();
  scene.ambient = vec3(0.5f);
  testing::addWall(scene, 3.f).albedo = {0.2f, 1.f, 0.f, 1.f};
  expectNear(testing::centerOf(radiance(scene)), vec3(0.1f, 0.5f, 0.f),
             0.02f);  // 0.2 in eight bits of sRGB is off by up to 1.2 %
}

TEST_P(Shading, EmissionShowsInTheDark) {
  scene::Scene scene = testing::emptyScene();
  testing::addWall(scene, 3.f).emissive = {4.f, 2.f, 0.5f};
  expectNear(testing::centerOf(radiance(scene)), vec3(4.f, 2.f, 0.5f), 0.02f);
}

}  // namespace
}  // namespace lucerna
