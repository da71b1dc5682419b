#include <gtest/gtest.h>

#include <array>

#include "support/testing.hpp"

namespace lucerna {
namespace {

const std::vector<std::string> kRows = {"Cull", "GBuffer", "TiledLighting", "Background"};

// Four colours: top left red, top right green, bottom left blue, bottom right white; times `scale`.
scene::Texture quarters(float scale) {
  constexpr int kSide = 16;
  Image image(kSide, kSide, 4, ComponentType::F32);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool right = x >= kSide / 2, bottom = y >= kSide / 2;
      const vec3 color = bottom ? (right ? vec3(1) : vec3(0, 0, 1)) : vec3(right ? 0 : 1, right, 0);
      const vec4 texel(scale * color, 1.f);
      std::copy_n(&texel.x, 4, image.pixel<float>(x, y));
    }
  scene::Texture texture;
  texture.name = "quarters";
  texture.image = std::make_shared<const Image>(std::move(image));
  return texture;
}

void expectQuarters(const Image& image, float scale) {
  const auto at = [&](int x, int y) { return testing::colorAt(image, x, y) / scale; };
  const auto near = [](vec3 a, vec3 b) { return glm::distance(a, b) < 0.02f; };
  EXPECT_TRUE(near(at(2, 2), {1, 0, 0})) << "top left";
  EXPECT_TRUE(near(at(13, 2), {0, 1, 0})) << "top right";
  EXPECT_TRUE(near(at(2, 13), {0, 0, 1})) << "bottom left";
  EXPECT_TRUE(near(at(13, 13), {1, 1, 1})) << "bottom right";
}

TEST(Background, ShowsItsColorOnlyWhereNothingWasDrawn) {
  scene::Scene scene = testing::emptyScene();
  scene.background.color = {0.5f, 0.25f, 2.f};
  testing::addWall(scene, 20.f).emissive = vec3(1.f);  // 10 m at 20 m: the middle of the picture
  const Image image = testing::valueOf(scene, testing::rows(kRows), {33, 33}, "Background.color");
  EXPECT_EQ(testing::centerOf(image), vec3(1.f));
  EXPECT_EQ(testing::colorAt(image, 0, 0), vec3(0.5f, 0.25f, 2.f));
  testing::expectNoDebugMessages();
}

TEST(Background, StretchesAPictureOverTheOutputUpright) {
  scene::Scene scene = testing::emptyScene();
  scene.textures.push_back(quarters(1.f));
  scene.background.kind = scene::BackgroundKind::Image;
  scene.background.texture = 0;
  scene.background.intensity = 3.f;
  expectQuarters(testing::valueOf(scene, testing::rows(kRows), {16, 16}, "Background.color"), 3.f);
  testing::expectNoDebugMessages();
}

// The parallax of a picture is that of a wall at the end of the world.
TEST(Background, APictureStandsAtInfinityForTwoEyes) {
  constexpr uvec2 kSize{256, 64};
  scene::Scene picture = testing::emptyScene(), wall = testing::emptyScene();
  picture.textures.push_back(quarters(1.f));  // green from the middle on
  picture.background.kind = scene::BackgroundKind::Image;
  picture.background.texture = 0;
  constexpr float kFar = 1e5f;
  testing::addWall(wall, kFar).emissive = vec3(0, 1, 0);
  scene::Node& place = wall.nodes.back();  // from the middle on, too
  place.translation = {kFar, 0, -2 * kFar};
  place.scale = vec3(2 * kFar);
  updateTransforms(wall);
  wall.cameras[0].far = 0.f;  // as far as there is anything
  // Where green begins in the upper half.
  const auto edgeOf = [&](const scene::Scene& scene, float side) {
    testing::SceneRenderer renderer(scene);
    const scene::View middle = viewOf(scene, scene.cameras[0], 4.f);
    const auto output = renderer.render(testing::rows(kRows), eyeView(middle, side * 0.5f, 3.f),
                                        kSize, {"Background.color"});
    EXPECT_TRUE(output) << output.error().message;
    int x = 0;
    while (x < 256 && testing::colorAt(output->kept.at("Background.color"), x, 2).y < 0.5f) ++x;
    return x;
  };
  EXPECT_EQ(edgeOf(picture, 0), 128);
  for (const float side : {-1.f, 1.f}) {
    EXPECT_NEAR(edgeOf(picture, side), edgeOf(wall, side), 1);
    EXPECT_EQ(edgeOf(wall, side) > 128, side > 0);
    EXPECT_GT(std::abs(edgeOf(wall, side) - 128), 8);
  }
  testing::expectNoDebugMessages();
}

// Each face is what a camera at the origin sees along its axis, upright.
TEST(Background, ACubeMapStandsUprightAroundTheEye) {
  scene::Scene scene = testing::emptyScene();
  scene.background.kind = scene::BackgroundKind::CubeMap;
  scene::Texture& cube = scene.textures.emplace_back();
  for (int face = 0; face < 6; ++face)
    cube.faces.push_back(quarters(1.f + static_cast<float>(face)).image);
  cube.image = cube.faces[0];
  scene.background.texture = 0;
  const std::array<vec3, 6> kAxes = {vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                                     vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
  testing::SceneRenderer renderer(scene);
  for (std::size_t face = 0; face < 6; ++face) {
    SCOPED_TRACE(face);
    // Up and down are seen by tilting the head from -z.
    const vec3 up = face == 2 ? vec3(0, 0, 1) : face == 3 ? vec3(0, 0, -1) : vec3(0, 1, 0);
    scene::View view;
    view.viewFromWorld = glm::lookAt(vec3(0.f), kAxes[face], up);
    view.worldFromView = glm::inverse(view.viewFromWorld);
    view.clipFromView = perspectiveReversed(glm::half_pi<float>(), 1.f, 0.1f, 100.f);
    auto output = renderer.render(testing::rows(kRows), view, {16, 16}, {"Background.color"});
    ASSERT_TRUE(output) << output.error().message;
    expectQuarters(output->kept.at("Background.color"), 1.f + static_cast<float>(face));
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
