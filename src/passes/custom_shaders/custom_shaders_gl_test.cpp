#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/testing.hpp"

namespace lucerna {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr uvec2 kSize{33, 33};  // odd: the middle pixel looks along the axis

// Where CustomShaders may stand, and the value to look at.
struct Way {
  std::vector<std::string> rows;
  std::string value;
};
const Way kAfter{
    {"Cull", "GBuffer", "TiledLighting", "CustomShaders", "Background", "Transparency"},
    "Transparency.color"};
const Way kBefore{
    {"Cull", "GBuffer", "CustomShaders", "TiledLighting", "Background", "Transparency"},
    "Transparency.color"};
const Way kForward{{"Cull", "Forward", "Background", "Transparency"}, "Transparency.color"};

class CustomShaders : public ::testing::Test {
 protected:
  CustomShaders() : scene_(testing::emptyScene()) { scene_.background.color = vec3(0, 0, 0.25f); }
  void TearDown() override { testing::expectNoDebugMessages(); }

  // A shader file of the user's; its body follows the include.
  static std::string shader(const std::string& name, const std::string& body) {
    const fs::path folder = fs::path(::testing::TempDir()) / "lucerna_custom_shaders";
    fs::create_directories(folder);
    std::ofstream(folder / name) << "#include \"render/custom_shader.glsl\"\n" << body;
    return (folder / name).string();
  }
  static std::string constant() {
    return shader("constant.frag",
                  "uniform vec3 tint = vec3(0);\n"
                  "vec3 radianceOf(Surface s) { return tint; }\n");
  }
  // A wall that shows `tint` by the constant shader.
  scene::Material& addCustomWall(float distance, vec3 tint) {
    scene::Material& wall = testing::addWall(scene_, distance);
    wall.shader.file = constant();
    wall.shader.parameters = {{.name = "tint", .size = 3, .value = vec4(tint, 0)}};
    return wall;
  }
  static scene::Texture greyTexture() {
    scene::Texture texture;
    texture.image = std::make_shared<const Image>([] {
      Image image(1, 1, 4, ComponentType::U8);
      std::ranges::fill(image.as<std::uint8_t>(), std::uint8_t{128});
      return image;
    }());
    return texture;
  }
  // Makes the object added last a cube of the given side at a place.
  void asCube(vec3 center, float side) {
    scene::Node& node = scene_.nodes[scene_.objects.back().node];
    node.translation = center;
    node.scale = vec3(side);
    updateTransforms(scene_);
  }
  Image picture(const Way& way) {
    return testing::valueOf(scene_, testing::rows(way.rows), kSize, way.value);
  }
  std::string faultOf(const std::string& file) {
    testing::addWall(scene_, 3.f).shader.file = file;
    return fault();
  }
  std::string fault() {
    testing::SceneRenderer renderer(scene_);
    const auto output = renderer.render(testing::rows(kAfter.rows), kSize);
    if (output) return "";
    EXPECT_EQ(output.error().kind, ErrorKind::Pipeline);
    return output.error().message;
  }

  scene::Scene scene_;
};

TEST_F(CustomShaders, ShowWhatTheShaderSaysWhereverThePassStands) {
  addCustomWall(3.f, {0.5f, 2.f, 0.125f});
  for (const Way& way : {kAfter, kBefore, kForward})
    EXPECT_EQ(testing::centerOf(picture(way)), vec3(0.5f, 2.f, 0.125f)) << way.rows[2];
}

TEST_F(CustomShaders, HideAndAreHidden) {
  scene_.ambient = vec3(1.f);
  testing::addWall(scene_, 6.f).albedo = vec4(1, 0, 0, 1);
  addCustomWall(4.f, {0, 1, 0});
  asCube({0.3f, 0, -4}, 1.f);
  testing::addWall(scene_, 3.f).albedo = vec4(0, 0, 1, 1);
  asCube({-0.3f, 0, -3}, 0.6f);
  const Image forward = picture(kForward);
  const int y = forward.height() / 2;
  // From left to right: the wall, the ordinary cube, what the custom cube shows beside it.
  // But for the last bit: drivers may round 1 down when they store half floats.
  EXPECT_LT(glm::distance(testing::colorAt(forward, 1, y), vec3(1, 0, 0)), 1e-3f);
  EXPECT_LT(glm::distance(testing::colorAt(forward, 14, y), vec3(0, 0, 1)), 1e-3f);
  EXPECT_LT(glm::distance(testing::colorAt(forward, 21, y), vec3(0, 1, 0)), 1e-3f);
  for (const Way& way : {kAfter, kBefore}) {
    const Image deferred = picture(way);
    float worst = 0.f;
    for (int row = 0; row < forward.height(); ++row)
      for (int x = 0; x < forward.width(); ++x)
        worst = std::max(worst, glm::distance(testing::colorAt(deferred, x, row),
                                              testing::colorAt(forward, x, row)));
    EXPECT_LT(worst, 1e-3f) << way.rows[2];
  }
}

TEST_F(CustomShaders, ShadeLikeTheBuiltInShaderIfTheyCallIt) {
  scene_ = testing::sampleScene();
  for (scene::Material& material : scene_.materials) material.shader = {};
  const Image expected = picture(kForward);
  const std::string same = shader("same.frag", "vec3 radianceOf(Surface s) { return shade(s); }\n");
  for (scene::Material& material : scene_.materials) material.shader = {.file = same};
  for (const Way& way : {kForward, kAfter, kBefore}) {
    const Image found = picture(way);
    EXPECT_TRUE(std::ranges::equal(found.bytes(), expected.bytes())) << way.rows[2];
  }
}

TEST_F(CustomShaders, AreMarkedInTheGBuffer) {
  addCustomWall(3.f, vec3(1.f));
  const Image texels = testing::valueOf(scene_, testing::rows({"Cull", "GBuffer", "ShowGBuffer"}),
                                        kSize, "GBuffer.material");
  EXPECT_EQ(texels.pixel<std::uint8_t>(16, 16)[0], 3);
}

TEST_F(CustomShaders, HaveHolesAndOpacityLikeOthers) {
  scene::Material& wall = addCustomWall(3.f, vec3(1.f));
  wall.albedo.w = 0.25f;
  wall.alphaMode = scene::AlphaMode::Mask;
  for (const Way& way : {kAfter, kBefore, kForward})
    EXPECT_EQ(testing::centerOf(picture(way)), vec3(0, 0, 0.25f)) << "all of it is a hole";
  wall.alphaMode = scene::AlphaMode::Blend;
  for (const Way& way : {kAfter, kBefore, kForward})
    EXPECT_EQ(testing::centerOf(picture(way)), vec3(0.25f, 0.25f, 0.25f + 0.75f * 0.25f));
}

TEST_F(CustomShaders, ReadTexturesParametersAndTheObjectsOwnSpace) {
  scene_.textures.push_back(greyTexture());
  scene::Material& wall = testing::addWall(scene_, 3.f);
  wall.shader.file = shader("inputs.frag",
                            "uniform sampler2D stored;\nuniform sampler2D encoded;\n"
                            "uniform vec2 pair; uniform vec4 four; uniform float one;\n"
                            "vec3 radianceOf(Surface s) {\n"
                            "  return vec3(texture(stored, vec2(0)).r, texture(encoded, vec2(0)).r,"
                            " objectPositionO.z + pair.x + pair.y + four.w + one);\n}\n");
  wall.shader.parameters = {{.name = "pair", .size = 2, .value = vec4(1, 2, 9, 9)},
                            {.name = "four", .size = 4, .value = vec4(9, 9, 9, 4)},
                            {.name = "one", .size = 1, .value = vec4(8)}};
  wall.shader.textures = {{.name = "stored", .texture = 0, .data = true},
                          {.name = "encoded", .texture = 0, .data = false}};
  const vec3 found = testing::centerOf(picture(kAfter));
  EXPECT_NEAR(found.x, 128. / 255., 1e-3);
  EXPECT_NEAR(found.y, 0.2159, 1e-3) << "128 of sRGB";
  EXPECT_NEAR(found.z, 0.5 + 1 + 2 + 4 + 8, 1e-2) << "the wall's front is z = 0.5 of its cube";
}

TEST_F(CustomShaders, KeepTheirParametersToThemselves) {
  const std::string file = shader("glow.frag",
                                  "uniform vec3 glow = vec3(0, 1, 0);\n"
                                  "vec3 radianceOf(Surface s) { return glow; }\n");
  for (const bool stated : {true, false}) {
    for (const float x : {-0.6f, 0.6f}) {
      scene::Material& wall = testing::addWall(scene_, 3.f);
      asCube({x, 0, -3}, 1.f);
      wall.shader.file = file;
      if ((x < 0) == stated)
        wall.shader.parameters = {{.name = "glow", .size = 3, .value = vec4(5, 0, 0, 0)}};
    }
    testing::SceneRenderer renderer(scene_);
    for (int frame = 0; frame < 2; ++frame) {
      const auto output = renderer.render(testing::rows(kAfter.rows), kSize, {kAfter.value});
      ASSERT_TRUE(output) << output.error().message;
      const Image& image = output->kept.at(kAfter.value);
      const vec3 left = testing::colorAt(image, 12, 16), right = testing::colorAt(image, 20, 16);
      EXPECT_EQ(left, stated ? vec3(5, 0, 0) : vec3(0, 1, 0)) << frame;
      EXPECT_EQ(right, stated ? vec3(0, 1, 0) : vec3(5, 0, 0)) << frame;
    }
    scene_ = testing::emptyScene();
  }
}

TEST_F(CustomShaders, IncludeFilesThatStandBesideThem) {
  shader("shared.glsl", "vec3 grey() { return vec3(0.5); }\n");
  testing::addWall(scene_, 3.f).shader.file =
      shader("including.frag",
             "#include \"shared.glsl\"\nvec3 radianceOf(Surface s) { return grey(); }\n");
  EXPECT_EQ(testing::centerOf(picture(kAfter)), vec3(0.5f));
}

TEST_F(CustomShaders, ThatDoNotCompileSayFileAndLine) {
  const std::string file =
      shader("broken.frag", "\nvec3 radianceOf(Surface s) {\n  return vec4(missing);\n}\n");
  EXPECT_THAT(faultOf(file), AllOf(HasSubstr(file + ":4: error"), HasSubstr("missing")));
}

TEST_F(CustomShaders, ThatLackTheirFunctionDoNotLink) {
  EXPECT_THAT(faultOf(shader("empty.frag", "")), HasSubstr("radianceOf"));
}

TEST_F(CustomShaders, WhoseFileIsGoneSayWhich) {
  EXPECT_THAT(faultOf("/nowhere/at/all.frag"), HasSubstr("/nowhere/at/all.frag"));
}

TEST_F(CustomShaders, ThatAreWholeProgramsAreRefused) {
  const fs::path file = fs::path(::testing::TempDir()) / "lucerna_custom_shaders" / "whole.frag";
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "uniform int time;\nlayout(location = 0) out vec4 color;\n"
                         "void main() { color = vec4(time); }\n";
  EXPECT_THAT(faultOf(file.string()), AllOf(HasSubstr("render/custom_shader.glsl"),
                                            HasSubstr("radianceOf"), HasSubstr("whole.frag")));
}

TEST_F(CustomShaders, CannotTakeLucernasNames) {
  scene::Material& wall = addCustomWall(3.f, vec3(1.f));
  wall.shader.parameters = {{.name = "time", .size = 1, .value = vec4(5)}};
  EXPECT_THAT(fault(), HasSubstr("'time'"));
  wall.shader.parameters.clear();
  scene_.textures.push_back(greyTexture());
  wall.shader.textures = {{.name = "normalTexture", .texture = 0, .data = true}};
  EXPECT_THAT(fault(), HasSubstr("'normalTexture'"));
}

TEST_F(CustomShaders, MustFitTheirParametersAndTextures) {
  scene::Material& wall = addCustomWall(3.f, vec3(1.f));
  wall.name = "brick";
  wall.shader.parameters[0].size = 1;
  EXPECT_THAT(fault(),
              AllOf(HasSubstr("'brick'"), HasSubstr("'tint' is float"), HasSubstr("vec3")));
  wall.shader = {.file =
                     shader("textured.frag",
                            "uniform sampler2D bark;\n"
                            "vec3 radianceOf(Surface s) { return texture(bark, vec2(0)).rgb; }")};
  EXPECT_THAT(fault(), AllOf(HasSubstr("sampler2D 'bark'"), HasSubstr("textured.frag")));
  wall.shader = {.file = shader("block.frag",
                                "layout(std140) uniform Mine { vec4 a; };\n"
                                "vec3 radianceOf(Surface s) { return a.rgb; }")};
  EXPECT_THAT(fault(), HasSubstr("'Mine'"));
  wall.shader = {
      .file = shader("image.frag",
                     "uniform isampler2D odd;\n"
                     "vec3 radianceOf(Surface s) { return vec3(texture(odd, vec2(0)).r); }")};
  EXPECT_THAT(fault(), HasSubstr("'odd'"));
}

}  // namespace
}  // namespace lucerna
