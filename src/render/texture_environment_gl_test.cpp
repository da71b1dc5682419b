// Texture environment and generated coordinates against OpenGL's formulas worked out on the CPU.
#include <gtest/gtest.h>

#include "support/testing.hpp"

namespace lucerna {
namespace {

using scene::Combine;
using scene::Coordinates;

constexpr uvec2 kSize{33, 33};  // odd: the middle pixel looks along the axis

template <typename Color>
std::shared_ptr<const Image> picture(int side, int channels, const Color& color) {
  Image image(side, side, channels, ComponentType::F32);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const vec2 p = (vec2(x, y) + 0.5f) / static_cast<float>(side);
      const vec4 texel = color(p);
      std::copy_n(&texel.x, channels, image.pixel<float>(x, y));
    }
  return std::make_shared<const Image>(std::move(image));
}

scene::Texture textureOf(std::shared_ptr<const Image> image) {
  scene::Texture texture;
  texture.image = std::move(image);
  return texture;
}

// What a wall shows in ambient light 1: its albedo, over black times its opacity if it is blended.
vec3 shown(const scene::Scene& scene, const char* kept) {
  const bool forward = std::string(kept) == "Forward.color";
  const auto rows = forward ? testing::rows({"Cull", "Forward", "Transparency"})
                            : testing::rows({"Cull", "GBuffer", "TiledLighting", "Transparency"});
  return testing::centerOf(testing::valueOf(scene, rows, kSize, kept));
}

void expectNear(vec3 found, vec3 expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
}

// Table 3.22 of the OpenGL 2.1 specification, columns of RGB and RGBA textures.
vec4 combinedByTheTable(Combine combine, vec4 f, vec4 s, vec3 blend, bool alpha) {
  const vec3 cf(f), cs(s);
  switch (combine) {
    case Combine::Modulate:
      return vec4(cf * cs, alpha ? f.w * s.w : f.w);
    case Combine::Decal:
      return vec4(alpha ? cf * (1 - s.w) + cs * s.w : cs, f.w);
    case Combine::Blend:
      return vec4(cf * (1.f - cs) + blend * cs, alpha ? f.w * s.w : f.w);
    case Combine::Add:
      return vec4(glm::min(cf + cs, 1.f), alpha ? f.w * s.w : f.w);
    case Combine::Replace:
      return vec4(cs, alpha ? s.w : f.w);
  }
  return f;
}

class TextureEnvironment : public ::testing::TestWithParam<Combine> {
 protected:
  void TearDown() override { testing::expectNoDebugMessages(); }
};
std::string nameOf(const ::testing::TestParamInfo<Combine>& info) {
  constexpr const char* kNames[] = {"Modulate", "Decal", "Blend", "Add", "Replace"};
  return kNames[static_cast<int>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Combines, TextureEnvironment,
                         ::testing::Values(Combine::Modulate, Combine::Decal, Combine::Blend,
                                           Combine::Add, Combine::Replace),
                         nameOf);

TEST_P(TextureEnvironment, FollowsOpenGLsTableWithAndWithoutAlpha) {
  const vec4 color(0.6f, 0.3f, 0.8f, 0.75f), texel(0.5f, 0.25f, 0.75f, 0.4f);
  const vec3 blend(0.9f, 0.1f, 0.2f);
  for (const int channels : {3, 4}) {
    SCOPED_TRACE(channels);
    scene::Scene scene = testing::emptyScene();
    scene.ambient = vec3(1.f);
    scene.textures.push_back(textureOf(picture(4, channels, [&](vec2) { return texel; })));
    scene::Material& wall = testing::addWall(scene, 3.f);
    wall.albedo = color;
    wall.albedoTexture.texture = 0;
    wall.combine = GetParam();
    wall.blendColor = blend;
    const vec4 expected = combinedByTheTable(GetParam(), color, texel, blend, channels == 4);
    expectNear(shown(scene, "Forward.color"), vec3(expected), 0.002f);
    // Eight bits of sRGB.
    expectNear(shown(scene, "TiledLighting.color"), vec3(expected), 0.006f);
    wall.alphaMode = scene::AlphaMode::Blend;
    wall.transmission = vec3(0.f);
    expectNear(shown(scene, "Transparency.color"), vec3(expected) * expected.w, 0.002f);
  }
}

class Generated : public ::testing::Test {
 protected:
  Generated() {
    scene_.ambient = vec3(1.f);
    scene_.textures.push_back(
        textureOf(picture(256, 4, [](vec2 p) { return vec4(p.x, p.y, 0, 1); })));
    material().albedoTexture.texture = 0;
  }
  void TearDown() override { testing::expectNoDebugMessages(); }

  scene::Material& material() { return scene_.materials[0]; }
  scene::Node& node() { return scene_.nodes[scene_.objects[0].node]; }
  // The texture coordinates in the middle of the picture, (u, v) with v downwards.
  vec2 coordinates() {
    updateTransforms(scene_);
    return vec2(shown(scene_, "Forward.color"));
  }
  static void expectNear(vec2 found, vec2 expected) {
    EXPECT_NEAR(found.x, expected.x, 0.003f);
    EXPECT_NEAR(found.y, expected.y, 0.003f);
  }

  // The wall's front is at 3 m; in object space it is z = 0.5 and reaches from -0.5 to 0.5.
  scene::Scene scene_ = [] {
    scene::Scene scene = testing::emptyScene();
    testing::addWall(scene, 3.f);
    return scene;
  }();
};

TEST_F(Generated, ObjectLinearFollowsThePlanesInObjectSpace) {
  material().albedoTexture.coordinates = Coordinates::ObjectLinear;
  material().albedoTexture.planeS = {1.f, 0.f, 0.4f, 0.1f};
  material().albedoTexture.planeT = {0.f, 0.5f, 0.2f, 0.3f};
  node().translation += vec3(1.f, -2.f, 0.f);  // the wall is scaled by 10
  // The middle pixel sees (-1, 2, -3) m of the wall: (-0.1, 0.2, 0.5) in object space.
  const vec2 st(-0.1f + 0.4f * 0.5f + 0.1f, 0.5f * 0.2f + 0.2f * 0.5f + 0.3f);
  expectNear(coordinates(), {st.x, 1 - st.y});
}

TEST_F(Generated, EyeLinearStaysWithTheEye) {
  scene::TextureSlot& slot = material().albedoTexture;
  slot.coordinates = Coordinates::EyeLinear;
  slot.planeS = {0.2f, 0.f, -0.1f, 0.05f};
  slot.planeT = {0.f, 0.2f, 0.f, 0.6f};
  const vec2 st(0.1f * 3.f + 0.05f, 0.6f);
  expectNear(coordinates(), {st.x, 1 - st.y});
  node().translation.x += 0.7f;  // the wall slides under the pattern
  expectNear(coordinates(), {st.x, 1 - st.y});
}

TEST_F(Generated, TheSlotsTransformComesAfter) {
  scene::TextureSlot& slot = material().albedoTexture;
  slot.coordinates = Coordinates::EyeLinear;
  slot.planeS = {0.f, 0.f, 0.f, 0.25f};
  slot.planeT = {0.f, 0.f, 0.f, 0.5f};
  slot.scale = {2.f, 0.5f};
  slot.offset = {0.1f, 0.2f};
  expectNear(coordinates(), {0.1f + 2.f * 0.25f, 0.2f + 0.5f * 0.5f});
}

TEST_F(Generated, SphereMapFollowsItsFormula) {
  material().albedoTexture.coordinates = Coordinates::SphereMap;
  for (const vec2 turn : {vec2(0.f), vec2(0.3f, 0.f), vec2(0.f, -0.25f), vec2(-0.4f, 0.2f)}) {
    const quat rotation =
        glm::angleAxis(turn.x, vec3(0, 1, 0)) * glm::angleAxis(turn.y, vec3(1, 0, 0));
    node().rotation = rotation;
    const vec3 r = glm::reflect(vec3(0, 0, -1), rotation * vec3(0, 0, 1));
    const float m = 2.f * std::sqrt(r.x * r.x + r.y * r.y + (r.z + 1) * (r.z + 1));
    expectNear(coordinates(), {r.x / m + 0.5f, 1.f - (r.y / m + 0.5f)});
  }
}

TEST_F(Generated, ReflectionLooksUpTheCubeMapInTheWorld) {
  scene::Texture cube;
  for (int face = 0; face < 6; ++face)
    cube.faces.push_back(picture(8, 4, [&](vec2) {
      return vec4(face / 2 == 0, face / 2 == 1, face / 2 == 2, 1) * (face % 2 == 0 ? 1.f : 0.5f);
    }));
  cube.image = cube.faces[0];
  scene_.textures.push_back(std::move(cube));
  material().albedoTexture.texture = 1;
  material().albedoTexture.coordinates = Coordinates::Reflection;
  const auto seen = [&](vec3 axis, float degrees) {
    node().rotation = glm::angleAxis(glm::radians(degrees), axis);
    updateTransforms(scene_);
    // Drivers may round down when they store half floats.
    return glm::round(shown(scene_, "Forward.color") * 1000.f) / 1000.f;
  };
  const vec3 x(1, 0, 0), y(0, 1, 0);
  EXPECT_EQ(seen(y, 0.f), vec3(0, 0, 1)) << "back to the eye, +z";
  EXPECT_EQ(seen(y, 45.f), vec3(1, 0, 0)) << "+x";
  EXPECT_EQ(seen(y, -45.f), vec3(0.5f, 0, 0)) << "-x";
  EXPECT_EQ(seen(x, -45.f), vec3(0, 1, 0)) << "+y";
  EXPECT_EQ(seen(x, 45.f), vec3(0, 0.5f, 0)) << "-y";
  EXPECT_EQ(seen(y, 80.f), vec3(0, 0, 0.5f)) << "grazing: on to -z";
  // Turning the eye and the wall together turns what is seen: the map stands in the world.
  scene_.nodes[scene_.cameras[0].node].rotation = glm::angleAxis(glm::radians(90.f), y);
  node().translation = vec3(-3.01f, 0, 0);
  EXPECT_EQ(seen(y, 90.f), vec3(1, 0, 0)) << "looking along -x";
}

TEST_F(Generated, EmissiveTexturesReflectToo) {
  scene::Texture cube;
  for (int face = 0; face < 6; ++face)
    cube.faces.push_back(picture(2, 4, [&](vec2) { return vec4(face == 4 ? 1.f : 0.f); }));
  cube.image = cube.faces[0];
  scene_.textures.push_back(std::move(cube));
  material().albedo = vec4(0, 0, 0, 1);
  material().emissive = vec3(0.5f, 2.f, 1.f);
  material().emissiveTexture.texture = 1;
  material().emissiveTexture.coordinates = Coordinates::Reflection;
  for (const char* kept : {"Forward.color", "TiledLighting.color"})
    EXPECT_EQ(shown(scene_, kept), vec3(0.5f, 2.f, 1.f)) << kept;
}

}  // namespace
}  // namespace lucerna
