// Second sets of coordinates that serve, and some of each kind that do not.
#include "bake/own_unwrap.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "scene/scene.hpp"

namespace lucerna::bake {
namespace {

using ::testing::HasSubstr;

// A scene of one mesh: squares of 1 m in a row along x, each with its own corners.
class OwnUnwrap : public ::testing::Test {
 protected:
  OwnUnwrap() {
    scene_.meshes.emplace_back();
    scene_.materials.emplace_back();
    scene::Object& object = scene_.objects.emplace_back();
    object.node = scene::addNode(scene_, "row", mat4(1.f));
    object.mesh = object.material = 0;
  }

  // The square's place among the coordinates: where its corner, its right and its far end lie.
  void addSquare(vec2 at, vec2 right, vec2 far) {
    scene::Mesh& mesh = scene_.meshes[0];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const std::uint32_t before = first / 4;
    const float x = 2.f * static_cast<float>(before);
    for (const vec3 p : {vec3(x, 0, 0), vec3(x + 1, 0, 0), vec3(x + 1, 0, -1), vec3(x, 0, -1)})
      mesh.positions.push_back(p);
    for (const vec2 uv : {at, at + right, at + right + far, at + far})
      mesh.texCoords[1].push_back(uv);
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  }
  void addSquare(vec2 at) { addSquare(at, {1, 0}, {0, 1}); }

  std::variant<Chart, std::string> unwrap(float density = 10.f, int gap = 2) {
    scene::updateTransforms(scene_);
    world_ = makeWorld(scene_);
    return ownUnwrap(world_, 0, {.density = density, .gap = gap});
  }
  std::string reason(float density = 10.f, int gap = 2) {
    const auto result = unwrap(density, gap);
    return std::holds_alternative<std::string>(result) ? std::get<std::string>(result) : "sound";
  }

  scene::Scene scene_;
  World world_;
};

TEST_F(OwnUnwrap, IsTakenAsItIsInTexels) {
  addSquare({3, 5});
  addSquare({4.5, 5});
  const auto result = unwrap();
  ASSERT_TRUE(std::holds_alternative<Chart>(result)) << std::get<std::string>(result);
  const Chart& chart = std::get<Chart>(result);
  EXPECT_EQ(chart.size, ivec2(25, 10));
  EXPECT_EQ(chart.triangles.size(), 4u);
  EXPECT_EQ(chart.corners[0][1], vec2(10, 0));
  EXPECT_EQ(chart.corners[2][0], vec2(15, 0));
}

TEST_F(OwnUnwrap, IsTakenMirroredAndTurned) {
  addSquare({0, 0}, {0, 1}, {1, 0});
  addSquare({2, 0}, {0, 1}, {-0.5, 0});
  EXPECT_EQ(reason(), "sound");
}

TEST_F(OwnUnwrap, IsNotAskedForWhereThereIsNone) {
  addSquare({0, 0});
  scene_.meshes[0].texCoords[1].clear();
  EXPECT_EQ(reason(), "");
}

TEST_F(OwnUnwrap, MustNotLieOnItself) {
  addSquare({0, 0});
  addSquare({0.5, 0});
  EXPECT_THAT(reason(), HasSubstr("lie on each other"));
}

TEST_F(OwnUnwrap, MustNotBeStretched) {
  addSquare({0, 0});
  addSquare({2, 0}, {0.05, 0}, {0, 0.05});
  EXPECT_THAT(reason(), HasSubstr("is stretched by more than 4"));
}

TEST_F(OwnUnwrap, MustBeFinite) {
  addSquare({0, 0});
  scene_.meshes[0].texCoords[1][2].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(reason(), "it is not finite");
}

TEST_F(OwnUnwrap, MustHaveAnArea) {
  addSquare({0, 0}, {1, 0}, {1, 0});
  EXPECT_EQ(reason(), "it has no area");
}

TEST_F(OwnUnwrap, MustFitIntoAMap) {
  addSquare({0, 0});
  addSquare({1000, 0});
  EXPECT_THAT(reason(), HasSubstr("it needs 10010 x 10 texels at this density"));
}

TEST_F(OwnUnwrap, IsLeftToATextureThatLiesByIt) {
  addSquare({0, 0});
  scene_.textures.emplace_back();
  scene_.materials[0].emissiveTexture.texture = 0;
  scene_.materials[0].emissiveTexture.texCoord = 1;
  EXPECT_EQ(reason(), "its material's textures lie by it");
}

// At 10 texels a unit the first square touches the texels 0 to 9; with the second at 1.2 two are
// free between them.
TEST_F(OwnUnwrap, PartsKeepTheGap) {
  addSquare({0, 0});
  addSquare({1.2, 0});
  EXPECT_EQ(reason(10.f, 2), "sound");
  EXPECT_THAT(reason(10.f, 3), HasSubstr("parts of it are closer than 3 texels"));
}

// The second square begins within a texel, and ends within one: it touches the texels 13 to 23,
// and the third, from 25.2 on, has one free texel before it.
TEST_F(OwnUnwrap, PartsThatBeginWithinATexelOwnAllThatTheyTouch) {
  addSquare({0, 0});
  addSquare({1.39, 0});
  addSquare({2.52, 0});
  EXPECT_EQ(reason(10.f, 1), "sound");
  EXPECT_THAT(reason(10.f, 2), HasSubstr("parts of it are closer than 2 texels"));
}

}  // namespace
}  // namespace lucerna::bake
