#include "app/camera.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/file.hpp"
#include "core/test_folder.hpp"

namespace lucerna::app {
namespace {

using testing::HasSubstr;

constexpr const char* kPath = R"({"lucerna": "camera-path/1", "keyframes": [
  {"time": 0, "position": [0, 1, 0], "target": [0, 1, -1], "fovY": 40},
  {"time": 1, "position": [1, 1, 0], "target": [1, 1, -1], "fovY": 40},
  {"time": 3, "position": [3, 1, 0], "target": [3, 1, -1], "fovY": 60}]})";

float distanceTo(vec3 a, vec3 b) {
  return glm::length(a - b);
}

TEST(CameraPath, PassesThroughItsKeyframesAndStandsStillOutside) {
  const auto path = CameraPath::fromJson(kPath, "path.json");
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_LT(distanceTo(path->at(-5).position, vec3(0, 1, 0)), 1e-6f);
  EXPECT_LT(distanceTo(path->at(1).position, vec3(1, 1, 0)), 1e-6f);
  EXPECT_LT(distanceTo(path->at(9).position, vec3(3, 1, 0)), 1e-6f);
  EXPECT_NEAR(glm::degrees(path->at(3).fovY), 60.f, 1e-4f);
}

TEST(CameraPath, UnevenKeysOfAUniformMotionStayUniform) {
  const auto path = CameraPath::fromJson(kPath, "path.json");
  for (double t = 0; t <= 3; t += 0.125)
    EXPECT_NEAR(path->at(t).position.x, static_cast<float>(t), 1e-5f) << t;
}

TEST(CameraPath, IsSmoothAcrossKeyframes) {
  const auto path = CameraPath::fromJson(R"({"keyframes": [
    {"time": 0, "position": [0, 0, 0], "target": [0, 0, -1]},
    {"time": 1, "position": [1, 2, 0], "target": [0, 0, -1]},
    {"time": 3, "position": [0, 3, 4], "target": [0, 0, -1]}]})",
                                         "path.json");
  ASSERT_TRUE(path) << path.error().message;
  constexpr double kStep = 1e-3;
  const vec3 before =
      (path->at(1).position - path->at(1 - kStep).position) / static_cast<float>(kStep);
  const vec3 after =
      (path->at(1 + kStep).position - path->at(1).position) / static_cast<float>(kStep);
  EXPECT_LT(distanceTo(before, after), 0.02f);
}

TEST(CameraPath, FaultsNameTheKeyframe) {
  const auto faultOf = [](const char* text) {
    const auto path = CameraPath::fromJson(text, "path.json");
    return path ? std::string("it succeeded") : path.error().message;
  };
  EXPECT_THAT(faultOf("{"), HasSubstr("path.json:1:1: is no JSON"));
  EXPECT_THAT(faultOf("[]"), HasSubstr("wanted an object"));
  EXPECT_THAT(faultOf(R"({"lucerna": "scene/1", "keyframes": []})"), HasSubstr("camera-path/1"));
  EXPECT_THAT(faultOf(R"({"keyframes": []})"), HasSubstr("at least one"));
  EXPECT_THAT(
      faultOf(R"({"keyframes": [{"time": 0, "position": [0, 0, 0], "target": [0, 0, 0]}]})"),
      HasSubstr("/keyframes/0: position and target"));
  EXPECT_THAT(faultOf(R"({"keyframes": [{"time": 0, "position": [0, 0], "target": [0, 0, 1]}]})"),
              HasSubstr("/keyframes/0/position: found [0,0], wanted a list of 3 numbers"));
  EXPECT_THAT(faultOf(R"({"keyframes": [{"time": 0, "positon": [0, 0, 0], "target": [0, 0, 1]}]})"),
              HasSubstr("did you mean 'position'"));
  EXPECT_THAT(faultOf(R"({"keyframes": [{"time": 1, "position": [0, 0, 0], "target": [0, 0, 1]},
                                        {"time": 1, "position": [0, 0, 0], "target": [0, 0, 1]}]})"),
              HasSubstr("path.json:2: /keyframes/1: its time 1 does not come after"));
  EXPECT_THAT(
      faultOf(R"({"keyframes": [{"time": 1e999, "position": [0, 0, 0], "target": [0, 0, 1]}]})"),
      HasSubstr("path.json:1:30: found the number 1e999, wanted at most"));
  EXPECT_THAT(faultOf(R"({"keyframes": [{"time": 0, "time": 1}]})"),
              HasSubstr("path.json:1: the key \"time\" stands twice"));
  EXPECT_THAT(faultOf(""), HasSubstr("path.json: is empty"));
}

TEST(Camera, FarMustLieBehindNear) {
  const TestFolder folder;
  const std::filesystem::path file = folder / "depth.json";
  const auto faultOf = [&](const std::string& depth) {
    EXPECT_TRUE(writeText(file, R"({"position": [0, 0, 1], "target": [0, 0, 0],)"
                                "\n" +
                                    depth + "}"));
    const auto pose = readCamera(file);
    return pose ? std::string() : pose.error().message;
  };
  EXPECT_EQ(faultOf(R"("near": 1, "far": 2)"), "");
  EXPECT_EQ(faultOf(R"("near": 1, "far": 0)"), "");
  EXPECT_EQ(faultOf(R"("near": 1)"), "");
  EXPECT_THAT(faultOf(R"("near": 2, "far": 1)"),
              HasSubstr("depth.json:2: /far: found 1, wanted more than near, 2 m"));
  EXPECT_THAT(faultOf(R"("near": 1, "far": 1)"), HasSubstr("wanted more than near"));
  EXPECT_THAT(faultOf(R"("near": -1)"), HasSubstr("/near: found -1, wanted a number from 0"));
}

TEST(Camera, LooksAtItsTargetAlsoStraightDown) {
  for (const vec3 target : {vec3(3, 2, 1), vec3(0, -5, 0), vec3(0, 5, 0), vec3(0, 0, 9)}) {
    const mat4 world = worldFromCamera({.position = vec3(0), .target = target});
    EXPECT_LT(distanceTo(-vec3(world[2]), glm::normalize(target)), 1e-6f);
    EXPECT_NEAR(glm::determinant(mat3(world)), 1.f, 1e-5f);
  }
}

TEST(Camera, IsChosenByNameIndexOrNotAtAll) {
  scene::Scene scene;
  scene.name = "test";
  addCamera(scene, "front", {});
  addCamera(scene, "back", {.position = vec3(0, 0, 5), .target = vec3(0)});
  EXPECT_EQ(*chooseCamera(scene, ""), 0u);
  EXPECT_EQ(*chooseCamera(scene, "back"), 1u);
  EXPECT_EQ(*chooseCamera(scene, "1"), 1u);
  for (const char* wrong : {"2", "-1", "1x", "bakc"}) {
    const auto result = chooseCamera(scene, wrong);
    ASSERT_FALSE(result) << wrong;
    EXPECT_EQ(result.error().kind, ErrorKind::Usage);
    EXPECT_THAT(result.error().message, HasSubstr("0 'front', 1 'back'"));
  }
  EXPECT_THAT(chooseCamera(scene, "bakc").error().message, HasSubstr("did you mean 'back'"));
  EXPECT_EQ(chooseCamera(scene, "/nowhere/camera.json").error().kind, ErrorKind::Input);
}

}  // namespace
}  // namespace lucerna::app
