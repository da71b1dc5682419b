#include "scene/scene_json.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/file.hpp"
#include "core/progress.hpp"
#include "image/image_file.hpp"
#include "scene/scene_json_fixture.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

TEST_F(SceneJson, ChangesTheMaterialOfAFileThatHasNone) {
  write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("bare.lucerna.json",
        R"({"lucerna": "scene/1", "materials": {"default": {"albedo": [1, 0, 0]}}})");
  const Result<Scene> scene = loadScene(path("bare.obj"));
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->materials.size(), 1u);
  EXPECT_EQ(vec3(scene->materials[0].albedo), vec3(1, 0, 0));
}

TEST_F(SceneJson, OpacityOfOneLeavesTheAlphaModeAlone) {
  write("tri.mtl", "newmtl paint\nKd 0.5 0.5 0.5\nd 0.5\n");
  write("tri.lucerna.json", R"({"lucerna": "scene/1", "materials": {"paint": {"opacity": 1}}})");
  const Result<Scene> scene = loadScene(path("tri.obj"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].alphaMode, AlphaMode::Blend);
}

TEST_F(SceneJson, NothingReflectsMoreThanItGets) {
  EXPECT_THAT(faultsOf(R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
                           "materials": {"paint": {"albedo": [3, 0, 0]}}})"),
              HasSubstr("/materials/paint/albedo"));
  write("tri.mtl", "newmtl paint\nKd 3 0.5 0.5\n");
  const Result<Scene> scene = loadScene(path("tri.obj"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(vec3(scene->materials[0].albedo), vec3(1.f, 0.5f, 0.5f));
  EXPECT_THAT(scene->warnings, testing::Contains(HasSubstr("reflects more than it gets")));
}

TEST_F(SceneJson, BesideAFileIsReadWithIt) {
  write("tri.lucerna.json", R"({"lucerna": "scene/1",
    "materials": {"paint": {"model": "metallic-roughness", "metallic": 1, "albedo": [1, 0, 0]}},
    "lights": [{"kind": "point", "position": [1, 2, 3], "units": "relative", "intensity": 2}],
    "exposure": -1.5})");
  const Result<Scene> scene = loadScene(path("tri.obj"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].model, MaterialModel::MetallicRoughness);
  EXPECT_EQ(vec3(scene->materials[0].albedo), vec3(1, 0, 0));
  ASSERT_EQ(scene->lights.size(), 1u);
  EXPECT_FLOAT_EQ(scene->lights[0].intensity, 2.f * kPi);
  EXPECT_EQ(placeLights(*scene)[0].positionW, vec3(1, 2, 3));
  EXPECT_EQ(scene->exposure, -1.5f);
}

TEST_F(SceneJson, IncludesArePlaced) {
  write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"},
    {"file": "tri.obj", "translation": [10, 0, 0], "rotation": [0, 0, 90], "scale": 2}]})");
  const Result<Scene> scene = loadScene(path("s.json"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangleCount(), 2u);
  EXPECT_LT(glm::length(scene->boundsW().min - vec3(0, 0, 0)), 1e-5f);
  EXPECT_LT(glm::length(scene->boundsW().max - vec3(10, 2, 0)), 1e-5f);
}

TEST_F(SceneJson, AFileIsReadOnceHoweverOftenItIsIncluded) {
  write("lost.obj", "mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
  std::string includes = R"({"file": "inner.json"}, {"file": "builtin:atrium?lights=1"},
                            {"file": "builtin:atrium?lights=1"})";
  for (int i = 0; i < 500; ++i)
    includes += fmt::format(R"(, {{"file": "tri.obj", "translation": [{0}, 0, 0]}},
                                 {{"file": "./lost.obj", "translation": [{0}, 0, 1]}})",
                            i);
  write("inner.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
                          "materials": {"paint": {"albedo": [1, 0, 0]}}})");
  write("s.json", R"({"lucerna": "scene/1", "include": [)" + includes + "]}");
  const Result<Scene> scene = loadScene(path("s.json"));
  ASSERT_TRUE(scene) << scene.error().message;
  const Result<Scene> atrium = loadScene("builtin:atrium?lights=1");
  EXPECT_EQ(scene->meshes.size(), atrium->meshes.size() + 2);
  EXPECT_EQ(scene->textures.size(), atrium->textures.size());
  // Materials are shared within a JSON only: each may change them.
  EXPECT_EQ(scene->materials.size(), atrium->materials.size() + 3);
  EXPECT_EQ(scene->objects.size(), 2 * atrium->objects.size() + 1001);
  EXPECT_EQ(scene->lights.size(), 2 * atrium->lights.size());
  EXPECT_THAT(scene->warnings,
              testing::ElementsAre(AllOf(HasSubstr("lost.obj: "), HasSubstr("lost.mtl"))));
  EXPECT_EQ(vec3(scene->materials[scene->objects[0].material].albedo), vec3(1, 0, 0));
  EXPECT_EQ(vec3(scene->materials[scene->objects.back().material - 1].albedo), vec3(0.5f));
  EXPECT_FLOAT_EQ(scene->objects.back().boundsW.min.x, 499.f);
}

TEST_F(SceneJson, AnIncludeThatFailsIsToldOnce) {
  const std::string faults = faultsOf(R"({"lucerna": "scene/1", "include": [
    {"file": "nowhere.obj"}, {"file": "nowhere.obj"}, {"file": "other.obj"}]})");
  EXPECT_EQ(faults.find("nowhere.obj: no such file"), faults.rfind("nowhere.obj: no such file"));
  EXPECT_THAT(faults, HasSubstr("/include/2/file: "));
}

TEST_F(SceneJson, LightSettingsChangeALightByName) {
  write("inner.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
    "lights": [{"name": "lamp", "kind": "point", "position": [0, 0, 1]}]})");
  write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "inner.json"}],
    "lightSettings": {"lamp": {"radius": 0.25, "group": "street", "attenuation": [1, 0, 1]}}})");
  const Result<Scene> scene = loadScene(path("s.json"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->lights[0].radius, 0.25f);
  EXPECT_EQ(scene->lights[0].group, "street");
  EXPECT_EQ(scene->lights[0].attenuation, vec3(1, 0, 1));
}

TEST_F(SceneJson, MaterialsTakeTexturesCombinesAndGeneratedCoordinates) {
  writePicture("moss.png", 4, 2);
  for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"})
    writePicture(std::string(face) + ".png", 4, 4);
  write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
    "materials": {"paint": {
      "albedoTexture": {"file": "moss.png", "wrap": "mirror", "combine": "blend",
                        "blendColor": [1, 0.5, 0], "coordinates": "eye-linear",
                        "planeS": [1, 0, 0, 0.5], "scale": [2, 3], "rotation": 90},
      "emissive": [1, 1, 1],
      "emissiveTexture": {"faces": ["px.png", "nx.png", "py.png", "ny.png", "pz.png", "nz.png"]}}},
    "background": {"faces": ["px.png", "nx.png", "py.png", "ny.png", "pz.png", "nz.png"]}})");
  const Result<Scene> scene = loadScene(path("s.json"));
  ASSERT_TRUE(scene) << scene.error().message;
  const Material& paint = scene->materials[0];
  ASSERT_EQ(scene->textures.size(), 2u) << "the cube map is shared";
  const Texture& moss = scene->textures[paint.albedoTexture.texture];
  EXPECT_EQ(moss.image->width(), 4);
  EXPECT_EQ(moss.wrapT, Wrap::MirroredRepeat);
  EXPECT_EQ(paint.combine, Combine::Blend);
  EXPECT_EQ(paint.blendColor, vec3(1, 0.5f, 0));
  EXPECT_EQ(paint.albedoTexture.coordinates, Coordinates::EyeLinear);
  EXPECT_EQ(paint.albedoTexture.planeS, vec4(1, 0, 0, 0.5f));
  EXPECT_EQ(paint.albedoTexture.planeT, vec4(0, 1, 0, 0));
  EXPECT_EQ(paint.albedoTexture.scale, vec2(2, 3));
  EXPECT_NEAR(paint.albedoTexture.rotation, glm::half_pi<float>(), 1e-6f);
  EXPECT_EQ(scene->textures[paint.emissiveTexture.texture].faces.size(), 6u);
  EXPECT_EQ(paint.emissiveTexture.coordinates, Coordinates::Reflection);
  EXPECT_EQ(scene->background.texture, paint.emissiveTexture.texture);
  EXPECT_TRUE(usesTextureEnvironment(paint));
}

// What an outer JSON makes of textures that an inner one gave.
TEST_F(SceneJson, AFileReplacesATextureOfAnyKindAndWrapAloneChangesItsEdges) {
  writePicture("a.png", 4, 2);
  writePicture("b.png", 2, 2);
  write("inner.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
    "materials": {"paint": {
      "albedoTexture": {"file": "a.png", "coordinates": "eye-linear", "scale": [2, 3]},
      "emissiveTexture": {"faces": ["b.png", "b.png", "b.png", "b.png", "b.png", "b.png"]}}}})");
  const auto read = [&](const std::string& albedo, const std::string& emissive) {
    write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "inner.json"}], "materials":
      {"paint": {"albedoTexture": )" +
                        albedo + R"(, "emissiveTexture": )" + emissive + "}}}");
    auto scene = loadScene(path("s.json"));
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? *scene : Scene();
  };
  Scene scene = read(R"({"file": "b.png"})", R"({"file": "b.png", "wrap": "clamp"})");
  TextureSlot albedo = scene.materials.at(0).albedoTexture;
  TextureSlot emissive = scene.materials[0].emissiveTexture;
  EXPECT_EQ(scene.textures[albedo.texture].image->width(), 2);
  EXPECT_EQ(scene.textures[albedo.texture].wrapS, Wrap::Repeat);
  EXPECT_EQ(albedo.coordinates, Coordinates::Mesh);
  EXPECT_EQ(albedo.scale, vec2(2, 3)) << "stays as it was";
  EXPECT_FALSE(scene.textures[emissive.texture].isCube());
  EXPECT_EQ(scene.textures[emissive.texture].wrapT, Wrap::ClampToEdge);
  EXPECT_EQ(emissive.coordinates, Coordinates::Mesh);

  scene = read(R"({"wrap": "mirror"})", R"({"file": "a.png", "wrap": "mirror"})");
  albedo = scene.materials.at(0).albedoTexture;
  emissive = scene.materials[0].emissiveTexture;
  EXPECT_EQ(scene.textures[albedo.texture].image->width(), 4);
  EXPECT_EQ(scene.textures[albedo.texture].wrapS, Wrap::MirroredRepeat);
  EXPECT_EQ(albedo.coordinates, Coordinates::EyeLinear) << "stays as it was";
  EXPECT_EQ(scene.textures[emissive.texture].wrapS, Wrap::MirroredRepeat);

  scene = read(R"({"wrap": "repeat"})", R"({"rotation": 30})");
  EXPECT_EQ(scene.textures.size(), 2u) << "no copy of what repeats already";
}

TEST_F(SceneJson, MaterialsBringShadersWithParametersAndTextures) {
  writePicture("grain.png", 2, 2);
  write("rock.frag", "vec3 radianceOf(Surface s) { return shade(s); }\n");
  write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
    "materials": {"paint": {"reflectivity": 0.5, "shader": {"file": "rock.frag",
      "parameters": {"speed": 0.5, "pair": [1, 2], "glow": [3, 4, 5], "four": [6, 7, 8, 9]},
      "textures": {"grain": {"file": "grain.png", "data": true}}}}}})");
  const Result<Scene> scene = loadScene(path("s.json"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->materials[0].reflectivity, 0.5f);
  const CustomShader& shader = scene->materials[0].shader;
  EXPECT_TRUE(fs::path(shader.file).is_absolute());
  EXPECT_EQ(fs::path(shader.file).filename(), "rock.frag");
  ASSERT_EQ(shader.parameters.size(), 4u);  // as the file has them
  EXPECT_EQ(shader.parameters[0].name, "speed");
  EXPECT_EQ(shader.parameters[0].size, 1);
  EXPECT_EQ(shader.parameters[0].value.x, 0.5f);
  EXPECT_EQ(shader.parameters[3].name, "four");
  EXPECT_EQ(shader.parameters[3].value, vec4(6, 7, 8, 9));
  ASSERT_EQ(shader.textures.size(), 1u);
  EXPECT_TRUE(shader.textures[0].data);
  EXPECT_EQ(scene->textures[shader.textures[0].texture].image->width(), 2);
  const auto fault = [&](const std::string& text) {
    return faultsOf(R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
      "materials": {"paint": {"shader": )" +
                    text + "}}}");
  };
  EXPECT_THAT(fault("{}"), HasSubstr("found no \"file\""));
  EXPECT_THAT(fault(R"({"file": "none.frag"})"), HasSubstr("none.frag, which is no file"));
  EXPECT_THAT(fault(R"({"file": "rock.frag", "parameters": {"a": [1]}})"), HasSubstr("2 to 4"));
  EXPECT_THAT(fault(R"({"file": "rock.frag", "parameters": {"a": [1, "b"]}})"),
              HasSubstr("wanted a number"));
  EXPECT_THAT(fault(R"({"file": "rock.frag", "textures": {"a": {}}})"), HasSubstr("\"faces\""));
  EXPECT_THAT(fault(R"({"file": "rock.frag", "textures": {"a": {"wrap": "clamp", "faces":
      ["grain.png", "grain.png", "grain.png", "grain.png", "grain.png", "grain.png"]}}})"),
              HasSubstr("textures/a/wrap: found \"clamp\", wanted nothing"));
}

TEST_F(SceneJson, TexturesThatDoNotFitAreFaults) {
  writePicture("flat.png", 4, 2);
  writePicture("face.png", 4, 4);
  const auto fault = [&](const std::string& slot) {
    return faultsOf(R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
      "materials": {"paint": {"albedoTexture": )" +
                    slot + "}}}");
  };
  EXPECT_THAT(fault(R"({"combine": "decal"})"), HasSubstr("wanted \"file\" or six \"faces\""));
  EXPECT_THAT(fault(R"({"file": "none.png"})"), HasSubstr("none.png"));
  EXPECT_THAT(fault(R"({"file": "flat.png", "combine": "dekal"})"), HasSubstr("'decal'"));
  EXPECT_THAT(fault(R"({"file": "flat.png", "coordinates": "reflection"})"),
              HasSubstr("wanted six \"faces\""));
  EXPECT_THAT(fault(R"({"file": "flat.png", "planeS": [1, 0, 0]})"), HasSubstr("4 numbers"));
  const std::string five = R"("face.png", "face.png", "face.png", "face.png", "face.png", )";
  EXPECT_THAT(fault("{\"faces\": [" + five + "\"face.png\"], \"coordinates\": \"mesh\"}"),
              HasSubstr("\"reflection\""));
  EXPECT_THAT(fault("{\"faces\": [" + five + "\"flat.png\"]}"), HasSubstr("4 x 2"));
  EXPECT_THAT(fault(R"({"faces": ["face.png"]})"), HasSubstr("six pictures"));
  EXPECT_THAT(fault("{\"faces\": [" + five + R"("face.png"], "wrap": "mirror"})"),
              HasSubstr("albedoTexture/wrap: found \"mirror\", wanted nothing: a cube map"));
  EXPECT_THAT(fault("{\"faces\": [" + five + R"("face.png"], "wrap": 5})"),
              HasSubstr("albedoTexture/wrap: found 5, wanted"));
  EXPECT_THAT(fault(R"({"file": "flat.png", "wrap": "clam"})"), HasSubstr("'clamp'"));
  EXPECT_THAT(fault(R"({"wrap": "clamp"})"), HasSubstr("found no picture"));
}

TEST_F(SceneJson, AnglesAreDegreesAndTheFirstCameraIsTheJsons) {
  write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
    "lights": [{"kind": "spot", "position": [0, 4, 0], "direction": [0, -1, 0],
                "innerCone": 30, "outerCone": 60}],
    "cameras": [{"name": "c", "position": [0, 0, 5], "target": [0, 0, 0], "fovY": 90}]})");
  const Result<Scene> scene = loadScene(path("s.json"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(scene->lights[0].outerCone, kPi / 3.f, 1e-6f);
  EXPECT_LT(glm::length(placeLights(*scene)[0].directionW - vec3(0, -1, 0)), 1e-5f);
  EXPECT_EQ(scene->cameras[0].name, "c");
  EXPECT_NEAR(scene->cameras[0].fovY, glm::half_pi<float>(), 1e-6f);
}

TEST_F(SceneJson, AllFaultsAreReportedAtOnceWithLineAndPlace) {
  const std::string faults = faultsOf(R"({
    "lucerna": "scene/1",
    "include": [{"file": "tri.obj"}],
    "materials": {"paintt": {}, "paint": {"shinyness": 3}},
    "lights": [
      {"kind": "pointy"},
      {"kind": "point"},
      {"kind": "point", "position": [0, 0], "intensity": -1}
    ],
    "exposure": "bright"
  })");
  EXPECT_THAT(faults, HasSubstr("s.json:4: /materials/paintt: the scene has no material 'paintt' "
                                "(did you mean 'paint'?)"));
  EXPECT_THAT(faults,
              HasSubstr("/materials/paint/shinyness: found the unknown key 'shinyness' (did you "
                        "mean 'shininess'?)"));
  EXPECT_THAT(faults, HasSubstr("s.json:6: /lights/0/kind: found \"pointy\", wanted one of "
                                "directional, point, spot (did you mean 'point'?)"));
  EXPECT_THAT(faults, HasSubstr("s.json:7: /lights/1: found no \"position\""));
  EXPECT_THAT(faults, HasSubstr("s.json:8: /lights/2/position: found [0,0], wanted a list of 3"));
  EXPECT_THAT(faults, HasSubstr("/lights/2/intensity: found -1, wanted a number of at least 0"));
  EXPECT_THAT(faults, HasSubstr("s.json:10: /exposure: found \"bright\", wanted a number"));
}

TEST_F(SceneJson, AFormatThatIsMissingOrUnknownIsRefused) {
  EXPECT_THAT(faultsOf("{}"), HasSubstr("found no \"lucerna\""));
  EXPECT_THAT(faultsOf(R"({"lucerna": "scene/9"})"), HasSubstr("wanted \"scene/1\""));
  EXPECT_THAT(faultsOf("[1, 2]"), HasSubstr("wanted an object"));
  EXPECT_THAT(faultsOf("{\n\"lucerna\": }"), HasSubstr("s.json:2:12: is no JSON"));
  EXPECT_THAT(faultsOf(""), HasSubstr("s.json: is empty"));
}

TEST_F(SceneJson, NumbersAndKeysThatMakeNoSenseAreRefused) {
  EXPECT_THAT(faultsOf("{\"lucerna\": \"scene/1\",\n\"exposure\": 1e999}"),
              HasSubstr("s.json:2:18: found the number 1e999"));
  EXPECT_THAT(faultsOf("{\"lucerna\": \"scene/1\", \"exposure\": NaN}"),
              HasSubstr("wanted a finite number"));
  EXPECT_THAT(faultsOf("{\"lucerna\": \"scene/1\", \"exposure\": 1e300}"),
              HasSubstr("/exposure: found 1e+300, wanted a number from -30 to 30"));
  EXPECT_THAT(faultsOf("{\"lucerna\": \"scene/1\",\n\"exposure\": 1,\n\"exposure\": 2}"),
              HasSubstr("s.json:3: the key \"exposure\" stands twice"));
  EXPECT_THAT(faultsOf(R"({"lucerna": "scene/1", "cameras": [
    {"position": [0, 0, 5], "target": [0, 0, 0], "near": 5, "far": 1}]})"),
              HasSubstr("s.json:2: /cameras/0/far: found 1, wanted more than near, 5 m"));
}

TEST_F(SceneJson, ScalesAreNeitherNothingNorEverything) {
  for (const char* scale : {"1e-15", "[1, 1e-15, 1]", "[1, -1e-15, 1]", "[1e7, 1, 1]", "0"})
    EXPECT_THAT(faultsOf(fmt::format(R"({{"lucerna": "scene/1", "include": [
                  {{"file": "tri.obj", "scale": {}}}]}})",
                                     scale)),
                HasSubstr("/include/0/scale: found"))
        << scale;
  EXPECT_EQ(faultsOf(R"({"lucerna": "scene/1", "include": [
                     {"file": "tri.obj", "scale": [1e-6, -1, 1e6]}]})"),
            "");
}

// A worker that is missing is not the files' fault, and is told once.
TEST_F(SceneJson, WhatIsNoFaultOfAFileEndsTheReading) {
  write("inner.json", R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}]})");
  write("s.json", R"({"lucerna": "scene/1", "exposure": "bright",
                      "include": [{"file": "inner.json"}, {"file": "inner.json"}]})");
  const std::string before = std::getenv("LUCERNA_WORKER");
  setenv("LUCERNA_WORKER", "/nowhere/lucerna_worker", 1);
  const Result<Scene> scene = loadScene(path("s.json"));
  setenv("LUCERNA_WORKER", before.c_str(), 1);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::Failed);
  EXPECT_THAT(scene.error().message,
              AllOf(HasSubstr("tri.obj: the reader"), testing::Not(HasSubstr("exposure"))));
}

TEST_F(SceneJson, IncludesEndWhenTheUserCancels) {
  write("worker_hangs.obj", "v 0 0 0\n");
  write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "worker_hangs.obj"}]})");
  // In a process of its own, since cancelling is for good.
  EXPECT_EXIT(
      {
        Progress::catchInterrupt();
        raise(SIGINT);
        const Result<Scene> scene = loadScene(path("s.json"));
        std::fprintf(stderr, "%s", scene.error().message.c_str());
        std::_Exit(static_cast<int>(scene.error().kind));
      },
      testing::ExitedWithCode(130), "worker_hangs.obj: the reader of this file was cancelled");
}

TEST_F(SceneJson, ACircleOfIncludesIsRefused) {
  write("a.json", R"({"lucerna": "scene/1", "include": [{"file": "b.json"}]})");
  write("b.json", R"({"lucerna": "scene/1", "include": [{"file": "a.json"}]})");
  const Result<Scene> scene = loadScene(path("a.json"));
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("includes itself (a.json -> b.json -> a.json)"));
}

TEST_F(SceneJson, ABombOfIncludesIsRefused) {
  for (int i = 0; i < 20; ++i) {
    const std::string next = fmt::format(R"({{"file": "{}.json"}})", i + 1);
    write(fmt::format("{}.json", i),
          fmt::format(R"({{"lucerna": "scene/1", "include": [{}, {}]}})", next, next));
  }
  write("20.json", R"({"lucerna": "scene/1"})");
  const Result<Scene> scene = loadScene(path("0.json"));
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("scenes take more than 256 MiB; include fewer"));
}

TEST_F(SceneJson, AMissingBackgroundPictureIsAFault) {
  EXPECT_THAT(faultsOf(R"({"lucerna": "scene/1", "background": {"image": "sky.png"}})"),
              AllOf(HasSubstr("/background/image"), HasSubstr("sky.png")));
}

// The limit is one for all pictures, of whichever file.
TEST_F(SceneJson, PicturesMayNotTakeTooMuchTogether) {
  writePicture("a.png", 4, 2);  // 32 bytes
  write("tri.mtl", "newmtl paint\nmap_Kd a.png\n");
  const auto refusal = [&](const std::string& text, std::uint64_t left) {
    write("s.json", text);
    Scene scene;
    SceneLoad load;
    load.textureBytes = kMaxTextureBytes - left;
    const Status status = addSceneJson(scene, path("s.json"), load);
    return status ? std::string() : status.error().message;
  };
  const std::string picture = R"({"lucerna": "scene/1", "background": {"image": "a.png"}})";
  EXPECT_EQ(refusal(picture, 32), "");
  EXPECT_THAT(refusal(picture, 31), HasSubstr("/background/image: the picture cannot be had: it "
                                              "takes 32 B, and with it the textures take more"));
  const std::string include = R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}]})";
  EXPECT_EQ(refusal(include, 32), "");
  EXPECT_THAT(refusal(include, 31), HasSubstr("tri.obj: its textures take 32 B"));
  const std::string both = R"({"lucerna": "scene/1", "include": [{"file": "tri.obj"}],
                               "background": {"image": "a.png"}})";
  EXPECT_THAT(refusal(both, 63), HasSubstr("/background/image"));
}

TEST_F(SceneJson, TheExampleOfTheDocumentationIsGood) {
  const Result<std::string> page =
      readText(fs::path(LUCERNA_SOURCE_DIR) / "docs/user/scene-json.md");
  ASSERT_TRUE(page);
  const std::size_t start = page->find("```json\n") + 8;
  write("s.json", page->substr(start, page->find("```", start) - start));
  for (const char* name : {"hall", "car"}) {
    write(fmt::format("{}.obj", name),
          "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
          "usemtl glass\nf 1 2 3\nusemtl paint\nf 1 2 4\n"
          "usemtl steel\nf 2 3 4\nusemtl sign\nf 2 3 4\n");
  }
  write("m.mtl", "newmtl glass\nnewmtl paint\nnewmtl steel\nnewmtl sign\n");
  writePicture("sign.png", 8, 8);
  const Result<Scene> scene = loadScene(path("s.json"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->lights.size(), 3u);
  EXPECT_EQ(scene->cameras[0].name, "entrance");
  EXPECT_EQ(scene->background.color, vec3(0.3f, 0.45f, 0.7f));
  EXPECT_EQ(scene->bake.mapSize, 1024);
  EXPECT_FALSE(scene->bake.areaLights);
}

// Two clips that put the node at x = 1 and x = 2.
constexpr const char* kClips = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
  "nodes": [{"name": "n"}],
  "buffers": [{"byteLength": 28, "uri": "data:;base64,AAAAAAAAgD8AAAAAAAAAAAAAAEAAAAAAAAAAAA=="}],
  "bufferViews": [{"buffer": 0, "byteLength": 28}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 1, "type": "SCALAR"},
    {"bufferView": 0, "byteOffset": 4, "componentType": 5126, "count": 1, "type": "VEC3"},
    {"bufferView": 0, "byteOffset": 16, "componentType": 5126, "count": 1, "type": "VEC3"}],
  "animations": [
    {"name": "one", "samplers": [{"input": 0, "output": 1}],
     "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
    {"name": "two", "samplers": [{"input": 0, "output": 2}],
     "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]})";

TEST_F(SceneJson, ChoosesAnimationsByFileAndByInclude) {
  write("clips.gltf", kClips);
  const auto places = [&](const std::string& file) {
    auto scene = loadScene(path(file));
    EXPECT_TRUE(scene) << scene.error().message;
    animate(*scene, 0.f);
    std::vector<float> found;
    for (const Node& node : scene->nodes)
      if (node.name == "n") found.push_back(node.translation.x);
    return found;
  };
  EXPECT_EQ(places("clips.gltf"), std::vector<float>{1.f});  // the first, unless ...
  write("clips.lucerna.json", R"({"lucerna": "scene/1", "animation": "two"})");
  EXPECT_EQ(places("clips.gltf"), std::vector<float>{2.f});
  write("s.json", R"({"lucerna": "scene/1", "include": [
    {"file": "clips.gltf"}, {"file": "clips.gltf", "animation": "one"},
    {"file": "clips.gltf", "animation": 1}, {"file": "clips.gltf", "animation": "none"}]})");
  EXPECT_EQ(places("s.json"), (std::vector<float>{2.f, 1.f, 2.f, 0.f}));
  EXPECT_THAT(faultsOf(R"({"lucerna": "scene/1",
    "include": [{"file": "clips.gltf", "animation": "tow"}]})"),
              AllOf(HasSubstr("/include/0/animation"), HasSubstr("did you mean 'two'?")));
}

}  // namespace
}  // namespace lucerna::scene
