// One surface, one light, one formula; through TiledLighting and through Forward.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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
    const bool deferred = GetParam() == "TiledLighting";
    const graph::Pipeline pipeline =
        testing::rows(deferred ? std::vector<std::string>{"Cull", "GBuffer", "TiledLighting"}
                               : std::vector<std::string>{"Cull", "Forward"});
    return testing::valueOf(scene, pipeline, kSize, GetParam() + ".color");
  }
  void TearDown() override { testing::expectNoDebugMessages(); }
};
INSTANTIATE_TEST_SUITE_P(By, Shading, ::testing::Values("TiledLighting", "Forward"),
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

// Specular-glossiness head on: as above with F0 stated, and the diffuse part reduced by it.
TEST_P(Shading, SpecularGlossinessFollowsItsFormulaHeadOn) {
  scene::Scene scene = testing::emptyScene();
  scene::Material& wall = testing::addWall(scene, 3.f);
  wall.model = scene::MaterialModel::SpecularGlossiness;
  wall.albedo = {0.8f, 0.4f, 0.2f, 1.f};
  wall.specular = {0.5f, 0.25f, 0.05f};
  wall.roughness = 153.f / 255.f;
  wall.metallic = 1.f;  // belongs to the other model
  testing::addLight(scene, lightOf(scene::LightKind::Directional, 2.f), {0, 0, 0}, {0, 0, -1});
  updateTransforms(scene);
  const float alpha = wall.roughness * wall.roughness;
  const vec3 f0 = wall.specular;
  const vec3 diffuse = vec3(wall.albedo) * (1.f - 0.5f);
  const vec3 expected = 2.f * ((1.f - f0) * diffuse / kPi + 0.25f * f0 / (kPi * alpha * alpha));
  expectNear(testing::centerOf(radiance(scene)), expected, 0.02f);
}

TEST_P(Shading, TheSpecularTextureHoldsColourAndGlossiness) {
  scene::Scene scene = testing::emptyScene();
  Image texel(1, 1, 4, ComponentType::U8);
  const std::array<std::uint8_t, 4> values = {188, 255, 0, 51};  // sRGB 0.5, 1, 0; a fifth
  std::ranges::copy(values, texel.pixel<std::uint8_t>(0, 0));
  scene.textures.push_back({.name = "texel", .image = std::make_shared<const Image>(texel)});
  scene::Material& wall = testing::addWall(scene, 3.f);
  wall.model = scene::MaterialModel::SpecularGlossiness;
  wall.albedo = {0.f, 0.f, 0.f, 1.f};
  wall.specular = {1.f, 0.5f, 1.f};
  wall.roughness = 0.f;
  wall.specularTexture.texture = 0;
  testing::addLight(scene, lightOf(scene::LightKind::Directional, 2.f), {0, 0, 0}, {0, 0, -1});
  updateTransforms(scene);
  const float alpha = 0.8f * 0.8f;
  const vec3 expected = 0.5f / (kPi * alpha * alpha) * vec3(0.5f, 0.5f, 0.f);
  expectNear(testing::centerOf(radiance(scene)), expected, 0.02f);
}

TEST_P(Shading, UnlitSurfacesShowTheirColourInAnyLight) {
  scene::Scene scene = testing::emptyScene();
  scene.ambient = vec3(0.5f);
  scene::Material& wall = testing::addWall(scene, 3.f);
  wall.model = scene::MaterialModel::Unlit;
  wall.albedo = {0.25f, 0.5f, 1.f, 1.f};
  wall.emissive = vec3(5.f);  // belongs to the other models
  testing::addLight(scene, lightOf(scene::LightKind::Directional, 9.f), {0, 0, 0}, {0, 0, -1});
  updateTransforms(scene);
  expectNear(testing::centerOf(radiance(scene)), vec3(0.25f, 0.5f, 1.f), 0.02f);
}

// One pixel wide: the middle row or column for a line, the middle pixel for a point. Without
// normals they are unlit, with one they take light.
TEST_P(Shading, LinesAndPointsAreOnePixelWide) {
  scene::Scene scene = testing::emptyScene();
  scene.materials.emplace_back().albedo = {0.5f, 1.f, 0.25f, 1.f};
  scene::Mesh line;
  line.positions = {{-10, 0, 0}, {10, 0, 0}};
  line.colors.assign(2, u8vec4(255, 0, 255, 255));
  line.lines = {0, 1};
  line.bounds = {vec3(-10, 0, 0), vec3(10, 0, 0)};
  scene.meshes.push_back(line);
  testing::addObject(scene, 1, 0, glm::translate(mat4(1.f), vec3(0, 0, -5)));
  updateTransforms(scene);
  const auto lit = [&] {
    const Image values = converted(radiance(scene), ComponentType::F32, 3);
    std::vector<ivec2> pixels;
    for (int y = 0; y < values.height(); ++y)
      for (int x = 0; x < values.width(); ++x)
        if (values.pixel<float>(x, y)[0] > 0.f) pixels.emplace_back(x, y);
    return pixels;
  };
  const vec3 color(0.5f, 0.f, 0.25f);
  EXPECT_EQ(lit().size(), kSize.x);
  EXPECT_EQ(lit().front(), ivec2(0, kSize.y / 2));
  expectNear(testing::centerOf(radiance(scene)), color, 0.02f);

  scene::Mesh& mesh = scene.meshes[1];
  mesh.lines.clear();
  mesh.positions[0] = vec3(0.f);
  mesh.points = {0};
  mesh.bounds = {vec3(0.f), vec3(0.f)};
  updateTransforms(scene);
  EXPECT_EQ(lit(), std::vector<ivec2>{ivec2(kSize / 2u)});
  expectNear(testing::centerOf(radiance(scene)), color, 0.02f);

  mesh.normals.assign(2, vec3(0, 0, 1));
  EXPECT_TRUE(lit().empty());
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
