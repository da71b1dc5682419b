// System B's lights.ini, edge lights and emission textures: thesis, appendix C.1.
#include "scene/import/lights_ini.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "core/file.hpp"
#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "scene/load.hpp"

namespace lucerna::scene {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

const fs::path kExample = fs::path(LUCERNA_SOURCE_DIR) / "tests/scenes/lamps";

// Listings C.1 and C.2, word for word.
constexpr const char* kThesis = R"(CONFIG
//uhel orezu plosneho zdroje svetla
area_light_cutoff 90
//kvadraticky utlum plosneho zdroje svetla
area_light_att 0.2
//intenzita plosneho zdroje svetla
area_light_intensity 10
//tolerance pro rozdelovani trojuhelniku
interpolation_tolerance 32
//rozliseni mapy osvetleni
lightmap_size 2048
//vykreslovani plosnych zdroju svetla(1=zapnuto, 0=vypnuto)
render_area_lights 1
//vykreslovani zaplat map osvetleni(1=zapnuto, 0=vypnuto)
render_dynamic_lights 1
//vykreslovani mapt osvetleni(1=zapnuto, 0=vypnuto)
render_lightmap 1
//scena pro generovani map - cesta k 3D modelu je v config/resources.txt
render_scene RACE2
END

LIGHT0
//shader pro vykresleni mapy osvetleni - pouze rasterizacni generator map
shader lightmap_spot
//informace, ze svetlo ma byt dynamicke(1=zapnuto, 0=vypnuto)
blink 1
//barva svetla, cervena slozka
R 4.0
//barva svetla, zelena slozka
G 4.0
//barva svetla, modra slozka
B 2.0
//orez reflektoru ve stupnich - zaporne cislo vykresli bodove svetlo
cut 60
//ignorovani blizkych objektu - pouze rasterizacni generator map
near 3
//spot efekt svetla
spot 0.5
//konstantni utlum svetla
att0 0.01
//linearni utlum svetla
att1 0.02
//kvadraticky utlum svetla
att2 0.05
END
)";

TEST(LightsIni, TheListingsOfTheThesisAreRead) {
  const LightsIni ini = parseLightsIni(kThesis, "lights.ini");
  EXPECT_THAT(ini.warnings, IsEmpty());
  BakeHints defaults = parseLightsIni("CONFIG\nEND\n", "lights.ini").bake;
  EXPECT_FALSE(defaults.patchTolerance) << "the baker's is finer";
  defaults.patchTolerance = ini.bake.patchTolerance;
  EXPECT_EQ(ini.bake, defaults);
  EXPECT_TRUE(ini.bake.maps && ini.bake.patches && ini.bake.areaLights);
  ASSERT_TRUE(ini.bake.area);
  EXPECT_FLOAT_EQ(ini.bake.area->cut, kPi / 2.f);
  EXPECT_EQ(ini.bake.area->attenuation, 0.2f);
  EXPECT_EQ(ini.bake.area->intensity, 10.f);
  EXPECT_EQ(ini.bake.mapSize, 2048);
  EXPECT_FLOAT_EQ(ini.bake.patchTolerance.value(), 32.f * 8.f / 255.f);
  ASSERT_EQ(ini.groups.size(), 1u);
  const LightGroupIni& group = ini.groups.at(0);
  EXPECT_TRUE(group.blink);
  EXPECT_EQ(group.color, vec3(4, 4, 2));
  EXPECT_EQ(group.cut, 60.f);
  EXPECT_EQ(group.spot, 0.5f);
  EXPECT_EQ(group.attenuation, vec3(0.01f, 0.02f, 0.05f));
}

TEST(LightsIni, WhatIsSilentHasDefaults) {
  const LightsIni ini = parseLightsIni("\xef\xbb\xbfLIGHT7 // none of its keys\r\n\tEND\r\n", "l");
  EXPECT_THAT(ini.warnings, IsEmpty());
  const LightGroupIni& group = ini.groups.at(7);
  EXPECT_FALSE(group.blink);
  EXPECT_EQ(group.color, vec3(1));
  EXPECT_LT(group.cut, 0.f);
  EXPECT_EQ(group.spot, 0.f);
  EXPECT_EQ(group.attenuation, vec3(0, 0, 1));
  EXPECT_EQ(ini.bake.mapSize, 2048);
  EXPECT_EQ(parseLightsIni("LIGHT0\natt0 2\nEND", "l").groups.at(0).attenuation, vec3(2, 0, 0));
}

TEST(LightsIni, SwitchesAndSizesAreTaken) {
  const BakeHints bake = parseLightsIni(
                             "CONFIG\nrender_area_lights 0\nrender_dynamic_lights 0\n"
                             "render_lightmap 0\nlightmap_size 512\narea_light_cutoff 45\n"
                             "area_light_att 0.5\narea_light_intensity 3\nEND",
                             "l")
                             .bake;
  EXPECT_FALSE(bake.areaLights || bake.patches || bake.maps);
  EXPECT_EQ(bake.mapSize, 512);
  EXPECT_FLOAT_EQ(bake.area->cut, kPi / 4.f);
  EXPECT_EQ(bake.area->attenuation, 0.5f);
  EXPECT_EQ(bake.area->intensity, 3.f);
}

TEST(LightsIni, EachFaultIsOneSentenceWithItsLine) {
  const LightsIni ini = parseLightsIni(
      "CONFIG\n"
      "lightmap_size 2048.5\n"
      "render_lightmap yes\n"
      "area_light_atn 0.2\n"
      "END\n"
      "LIGTH1\n"
      "blink 1\n"
      "END\n"
      "LIGHT0\n"
      "R 0,5\n"
      "G nan\n"
      "B 1 2\n"
      "cut 120\n"
      "cut 30\n"
      "cut 40\n"
      "att0 0\n"
      "LIGHT0\n"
      "R 9\n",
      "lights.ini");
  EXPECT_THAT(
      ini.warnings,
      ElementsAre(
          "lights.ini:2: found 'lightmap_size 2048.5', wanted lightmap_size and a whole number "
          "from 16 to 16384; the line is passed over",
          "lights.ini:3: found 'render_lightmap yes', wanted render_lightmap and 0 or 1; the line "
          "is passed over",
          HasSubstr("lights.ini:4: found the unknown key 'area_light_atn' (did you mean "
                    "'area_light_att'?); wanted one of area_light_cutoff, "),
          "lights.ini:6: found 'LIGTH1', wanted a section, CONFIG or LIGHT and a number as in "
          "LIGHT0",
          HasSubstr("lights.ini:10: found 'R 0,5', wanted R and a number"),
          HasSubstr("lights.ini:11: found 'G nan'"), HasSubstr("lights.ini:12: found 'B 1 2'"),
          HasSubstr("lights.ini:13: found 'cut 120', wanted cut and a number from -360 to 90"),
          "lights.ini:15: cut stands twice in LIGHT0; the first counts; remove one",
          "lights.ini:17: LIGHT0 begins before the END of LIGHT0, which line 9 opens; add it",
          HasSubstr("lights.ini:9: LIGHT0 has no attenuation above 0"),
          "lights.ini:17: LIGHT0 stands twice, in line 9 and here; the first counts; remove one"));
  EXPECT_EQ(ini.groups.at(0).color, vec3(1));
  EXPECT_EQ(ini.groups.at(0).cut, 30.f);
  EXPECT_EQ(ini.groups.at(0).attenuation, vec3(0, 0, 1));
}

TEST(LightsIni, AFileWithoutSectionsIsNamed) {
  EXPECT_THAT(parseLightsIni("", "l").warnings, ElementsAre(HasSubstr("holds neither")));
  EXPECT_THAT(parseLightsIni("[lights]\ncount=3\n", "l").warnings,
              ElementsAre(HasSubstr("l:1: found '[lights]'"), HasSubstr("holds neither")));
}

// A copy of the example, to be changed.
class Lamps : public testing::Test {
 protected:
  void SetUp() override {
    for (const auto& entry : fs::directory_iterator(kExample))
      fs::copy(entry.path(), folder_ / entry.path().filename());
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  void append(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary | std::ios::app) << text;
  }
  Scene load(const std::string& name = "lamps.obj") {
    Result<Scene> scene = loadScene((folder_ / name).string());
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? std::move(*scene) : Scene();
  }
  TestFolder folder_;
};

TEST_F(Lamps, EdgesAreLightsFromTheirFirstPointTowardsTheirSecond) {
  const Scene scene = load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_EQ(scene.triangleCount(), 4u);
  const std::vector<PlacedLight> lights = placeLights(scene);
  ASSERT_EQ(lights.size(), 4u);
  const vec3 positions[] = {{4, 2.5f, -2}, {-4, 3, 2}, {0, 3, 2}, {4, 3, 2}};
  const vec3 directions[] = {{0, -1, 0}, {0, -1, 0}, vec3(0, -1, -1) / std::sqrt(2.f), {0, -1, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(glm::length(lights[i].positionW - positions[i]), 1e-6f) << i;
    EXPECT_LT(glm::length(lights[i].directionW - directions[i]), 1e-6f) << i;
  }
}

TEST_F(Lamps, GroupsAreTheObjectsWithEdgesCountedFromZero) {
  const Scene scene = load();
  ASSERT_EQ(scene.lights.size(), 4u);
  const Light& porch = scene.lights[0];
  EXPECT_EQ(porch.name, "porch");
  EXPECT_EQ(porch.group, "") << "always on";
  EXPECT_EQ(porch.kind, LightKind::Point);
  EXPECT_EQ(porch.attenuation, vec3(1, 0, 0.5f));
  for (std::size_t i = 1; i < 4; ++i) {
    const Light& street = scene.lights[i];
    EXPECT_EQ(street.name, "street");
    EXPECT_EQ(street.group, "street");
    EXPECT_EQ(street.kind, LightKind::Spot);
    EXPECT_FLOAT_EQ(street.outerCone, kPi / 3.f);
    EXPECT_EQ(street.innerCone, street.outerCone) << "a hard edge";
    EXPECT_EQ(street.exponent, 0.5f);
    EXPECT_EQ(street.attenuation, vec3(0.01f, 0.02f, 0.05f));
  }
}

// C = E_r F_a C_l k_d (L.N), section 4.3, at a white texel: our irradiance over pi.
TEST_F(Lamps, TexelsGetTheThesisLight) {
  const Scene scene = load();
  const auto brightness = [](const PlacedLight& light, vec3 point, vec3 normal) {
    const vec3 to = point - light.positionW;
    const float d = glm::length(to), cosAxis = glm::dot(to / d, light.directionW);
    return light.intensity * attenuationAt(light, d) * coneFactor(light, cosAxis) *
           std::max(glm::dot(normal, -to / d), 0.f) / kPi;
  };
  const PlacedLight street = placeLights(scene).at(1);  // at (-4, 3, 2), downwards
  const vec3 up(0, 1, 0), inside(-4 + 3, 0, 2), outside(-4 + 5.3f, 0, 2);
  const float d = std::sqrt(18.f), cosine = 3.f / d;
  const vec3 expected =
      std::pow(cosine, 0.5f) / (0.01f + 0.02f * d + 0.05f * d * d) * vec3(4, 4, 2) * cosine;
  EXPECT_LT(glm::length(brightness(street, inside, up) - expected), 1e-4f * glm::length(expected));
  EXPECT_EQ(brightness(street, outside, up), vec3(0)) << "beyond 60 degrees";
  const PlacedLight porch = placeLights(scene).at(0);  // at (4, 2.5, -2), everywhere
  const vec3 above(4, 4.5f, -2);
  EXPECT_LT(glm::length(brightness(porch, above, {0, -1, 0}) - vec3(1, 0.6f, 0.25f) / 3.f), 1e-3f);
}

TEST_F(Lamps, NoLightReachesBeyond300Metres) {
  EXPECT_LT(placeLights(load()).at(1).reach, 200.f);
  write("lights.ini", "LIGHT0\natt0 1\nEND\nLIGHT1\natt1 0.001\nEND\n");
  for (const PlacedLight& light : placeLights(load())) EXPECT_EQ(light.reach, 300.f);
}

TEST_F(Lamps, ConfigBecomesBakeHints) {
  BakeHints wanted;
  wanted.area = AreaLightRule{glm::radians(80.f), 0.1f, 5.f};
  wanted.patchTolerance = 16.f * (8.f / 255.f);
  wanted.mapSize = 1024;
  EXPECT_EQ(load().bake, wanted);
  write("lamps.lucerna.json", R"({"lucerna": "scene/1", "bake": {"mapSize": 256, "areaCut": 60}})");
  wanted.mapSize = 256;
  wanted.area->cut = glm::radians(60.f);
  EXPECT_EQ(load().bake, wanted) << "the scene JSON has the last word";
  write("s.json", R"({"lucerna": "scene/1", "include": [{"file": "lamps.obj"}]})");
  EXPECT_EQ(load("s.json").bake, wanted);
  EXPECT_EQ(load("s.json").lights.size(), 4u);
}

TEST_F(Lamps, EmissionTexturesStandBesideTheirPictures) {
  Scene scene = load();
  const auto material = [&](const std::string& name) {
    return *std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const Material& m) { return m.name == name; });
  };
  EXPECT_FALSE(material("stone").emissiveTexture.used());
  EXPECT_EQ(material("stone").emissive, vec3(0));
  const Material windows = material("windows");
  EXPECT_EQ(windows.emissive, vec3(1));
  ASSERT_TRUE(windows.emissiveTexture.used());
  const Texture& map = scene.textures[windows.emissiveTexture.texture];
  EXPECT_EQ(map.name, "wall.png-map");
  EXPECT_EQ(map.image->pixel<std::uint8_t>(1, 1)[0], 255);  // a lit window
  EXPECT_EQ(map.image->pixel<std::uint8_t>(5, 1)[0], 0);    // a dark one
  EXPECT_EQ(scene.textures[windows.albedoTexture.texture].image->pixel<std::uint8_t>(1, 1)[0], 40);

  write("lamps.mtl", "newmtl stone\nnewmtl windows\nKe 2 2 2\nmap_Kd wall.png\n");
  scene = load();
  EXPECT_EQ(material("windows").emissive, vec3(2));
  EXPECT_TRUE(material("windows").emissiveTexture.used());
  write("lamps.mtl", "newmtl stone\nnewmtl windows\nmap_Kd wall.png\nmap_Ke wall.png\n");
  scene = load();
  EXPECT_EQ(material("windows").emissiveTexture.texture, material("windows").albedoTexture.texture);
}

TEST_F(Lamps, EmissionTexturesAreFoundWherePicturesAre) {
  fs::create_directories(folder_ / "textures");
  fs::rename(folder_ / "wall.png", folder_ / "textures/wall.png");
  fs::rename(folder_ / "wall.png-map", folder_ / "textures/wall.png-map");
  const Scene scene = load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_THAT(scene.textures, Contains(testing::Field(&Texture::name, "textures/wall.png-map")));
}

TEST_F(Lamps, WithoutTheFileEdgesAreNoLights) {
  fs::remove(folder_ / "lights.ini");
  const Scene scene = load();
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("4 points, lines or faces without area")));
  ASSERT_EQ(scene.lights.size(), 1u) << "the headlight";
  EXPECT_EQ(scene.bake, BakeHints{});
}

TEST_F(Lamps, TheFileOfTheSameNameComesFirst) {
  write("lamps.lights.ini", "LIGHT0\nR 3\nEND\nLIGHT1\nEND\n");
  const Scene scene = load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_EQ(placeLights(scene).at(0).intensity, vec3(3, 1, 1) * kPi);
}

TEST_F(Lamps, GroupsAndObjectsThatDoNotMeetAreNamed) {
  append("lights.ini", "LIGHT5\nEND\n");
  append("lamps.obj", "o spare\nv 0 1 0\nv 0 0 0\nl 17 18\n");
  Scene scene = load();
  EXPECT_EQ(scene.lights.size(), 4u);
  EXPECT_THAT(scene.warnings,
              ElementsAre("lights.ini: no section LIGHT2 for object 'spare' and its 1 edges, which "
                          "light nothing; add it",
                          "lights.ini:47: LIGHT5 is of no object: 3 have edges ('l' records), "
                          "counted from 0; it is passed over"));
  write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  scene = load("bare.obj");
  EXPECT_THAT(scene.warnings, ElementsAre(AllOf(HasSubstr("lights.ini:23: describes lights"),
                                                HasSubstr("no object of the scene has edges"))));
  EXPECT_EQ(scene.bake.mapSize, 1024);
}

TEST_F(Lamps, EdgesWithoutADirectionLightNothing) {
  append("lamps.obj", "v 1 1 1\nv 1 1 1\nv nan 1 1\nl 17 18\nl 17 19\n");
  const Scene scene = load();
  EXPECT_EQ(scene.lights.size(), 4u);
  EXPECT_THAT(
      scene.warnings,
      ElementsAre(HasSubstr("lights.ini:34: 2 edges of object 'street' have no direction")));
}

TEST_F(Lamps, AFileThatIsNoTextIsAnError) {
  const auto refusal = [&] {
    const Result<Scene> scene = loadScene((folder_ / "lamps.obj").string());
    if (scene) return std::string();
    EXPECT_EQ(scene.error().kind, ErrorKind::Input);
    return scene.error().message;
  };
  write("lights.ini", std::string("CONFIG\nlightmap_size\0 7\nEND\n", 28));
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("lights.ini:2: found the byte 0x00"), HasSubstr("wanted text")));
  fs::remove(folder_ / "lights.ini");
  fs::create_directory(folder_ / "lights.ini");
  EXPECT_THAT(refusal(), HasSubstr("lights.ini"));
}

TEST_F(Lamps, AFloodOfFaultsIsCounted) {
  std::string text = "LIGHT0\n";
  for (int i = 0; i < 500; ++i) text += "x 1\n";
  write("lights.ini", text + "END\nLIGHT1\nEND\n");
  const Scene scene = load();
  EXPECT_EQ(scene.warnings.size(), 101u);
  EXPECT_EQ(scene.warnings.back(), "lights.ini: and 400 more faults");
}

// Any bytes: no crash, and hints and groups within their ranges.
TEST(LightsIni, DamageIsHarmless) {
  const std::string whole = kThesis;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const char c : {'\n', ' ', '9', 'L', '-', '/', '\xff'}) {
      std::string damaged = whole;
      damaged[i] = c;
      const LightsIni ini = parseLightsIni(damaged, "l");
      ASSERT_TRUE(ini.bake.area && ini.bake.mapSize);
      ASSERT_GE(ini.bake.patchTolerance.value_or(0.f), 0.f);
      ASSERT_GT(ini.bake.area->attenuation, 0.f);
      ASSERT_GE(*ini.bake.mapSize, 16);
      for (const auto& [number, group] : ini.groups) {
        ASSERT_NE(group.attenuation, vec3(0));
        ASSERT_LE(group.cut, 90.f);
      }
    }
}

}  // namespace
}  // namespace lucerna::scene
