#include <gmock/gmock.h>

#include "scene/scene_json_fixture.hpp"

namespace lucerna::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(SceneJson, BakeHintsAreReadAndWhatTheyLeaveOpenStaysOpen) {
  const auto bakeOf = [&](const std::string& bake) {
    write("s.json",
          R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}], "bake": )" + bake + "}");
    const Result<Scene> scene = loadScene(path("s.json"));
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? scene->bake : BakeHints();
  };
  EXPECT_EQ(bakeOf("{}"), BakeHints());
  BakeHints hints = bakeOf(R"({"mapSize": 512, "patchTolerance": 0.25, "maps": false})");
  EXPECT_EQ(hints.mapSize, 512);
  EXPECT_EQ(hints.patchTolerance, 0.25f);
  EXPECT_FALSE(hints.maps);
  EXPECT_TRUE(hints.patches && hints.areaLights);
  EXPECT_FALSE(hints.area) << "surfaces light by their radiance";
  hints = bakeOf(R"({"areaCut": 60, "areaIntensity": 3, "patches": false})");
  EXPECT_EQ(hints.area, (AreaLightRule{glm::radians(60.f), 0.2f, 3.f}));
  EXPECT_FALSE(hints.patches || hints.mapSize || hints.patchTolerance);
  EXPECT_EQ(bakeOf(R"({"areaAttenuation": 0.5})").area, (AreaLightRule{.attenuation = 0.5f}));
}

TEST_F(SceneJson, BakeHintsOutOfRangeAreFaults) {
  const auto fault = [&](const std::string& bake) {
    return faultsOf(R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}], "bake": )" + bake +
                    "}");
  };
  EXPECT_THAT(fault(R"({"areaCut": 91})"), HasSubstr("/bake/areaCut: found 91, wanted"));
  EXPECT_THAT(fault(R"({"areaAttenuation": 0})"), HasSubstr("/bake/areaAttenuation: found 0"));
  EXPECT_THAT(fault(R"({"areaIntensity": -1})"), HasSubstr("/bake/areaIntensity: found -1"));
  EXPECT_THAT(fault(R"({"patchTolerance": "low"})"), HasSubstr("/bake/patchTolerance: found"));
  EXPECT_THAT(fault(R"({"mapSize": 8})"), HasSubstr("/bake/mapSize: found 8, wanted"));
  EXPECT_THAT(fault(R"({"mapSize": 100.5})"), HasSubstr("/bake/mapSize: found 100.5"));
  EXPECT_THAT(fault(R"({"maps": 1})"), HasSubstr("/bake/maps: found 1"));
  EXPECT_THAT(fault(R"({"areaCutt": 1})"), HasSubstr("did you mean 'areaCut'?"));
}

}  // namespace
}  // namespace lucerna::scene
