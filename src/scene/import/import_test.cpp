// Files that assimp reads, through the child process. LUCERNA_WORKER names the test worker.
#include "scene/import/import.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "scene/import/ac3d_text.hpp"
#include "scene/import/mesh_build.hpp"
#include "scene/import/scene_stream.hpp"
#include "scene/load.hpp"

namespace lucerna::scene {
namespace {

using testing::Contains;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Import : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  void writePicture(const std::string& name, u8vec4 color, int channels) {
    Image image(4, 4, channels, ComponentType::U8);
    for (int i = 0; i < 16 * channels; ++i)
      image.as<std::uint8_t>()[static_cast<std::size_t>(i)] = color[i % channels];
    ASSERT_TRUE(writeImage(folder_ / name, image));
  }
  TestFolder folder_;
};

constexpr const char* kQuad =
    "mtllib q.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl m\nf 1/1 2/2 3/3 4/4\n";

TEST_F(Import, ObjGivesPhongMaterialsAndOurTextureOrigin) {
  write("q.mtl", "newmtl m\nKd 0.5 0.25 1\nKs 0.1 0.2 0.3\nNs 40\nKe 1 0 0\nd 0.5\n");
  const Result<Scene> scene = importScene(write("q.obj", kQuad));
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->materials.size(), 1u);
  const Material& m = scene->materials[0];
  EXPECT_EQ(m.model, MaterialModel::Phong);
  EXPECT_EQ(m.albedo, vec4(0.5f, 0.25f, 1.f, 0.5f));
  EXPECT_EQ(m.alphaMode, AlphaMode::Blend);
  EXPECT_EQ(m.specular, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.shininess, 40.f);
  EXPECT_EQ(m.emissive, vec3(1, 0, 0));
  const Mesh& mesh = scene->meshes[0];
  EXPECT_EQ(mesh.triangleCount(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(mesh.texCoords[0][i].y, 1.f - mesh.positions[i].y);
}

TEST_F(Import, OpacityPicturesBecomeAlphaAndHeightMapsAreLeftOut) {
  write("q.mtl", "newmtl m\nmap_Kd c.png\nmap_d d.png\nmap_bump h.png\n");
  writePicture("c.png", {10, 20, 30, 255}, 3);
  writePicture("d.png", {7, 7, 7, 255}, 1);
  writePicture("h.png", {90, 90, 90, 255}, 3);
  const Result<Scene> scene = importScene(write("q.obj", kQuad));
  ASSERT_TRUE(scene) << scene.error().message;
  const Material& m = scene->materials[0];
  EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
  EXPECT_FALSE(m.normalTexture.used());
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("'h.png' is a height map")));
  const Image& image = *scene->textures[m.albedoTexture.texture].image;
  ASSERT_EQ(image.channels(), 4);
  EXPECT_EQ(image.pixel<std::uint8_t>(1, 1)[0], 10);
  EXPECT_EQ(image.pixel<std::uint8_t>(1, 1)[3], 7);
}

// assimp makes it 0.6 grey; the textures of such libraries would come out dark.
TEST_F(Import, TexturesWithoutADiffuseColourAreNotDarkened) {
  write("q.mtl", "newmtl m\n\tmap_Kd c.png\n");
  writePicture("c.png", {10, 20, 30, 255}, 3);
  const fs::path path = write("q.obj", kQuad);
  EXPECT_EQ(importScene(path)->materials[0].albedo, vec4(1.f));
  write("q.mtl", "newmtl m\n\tKd 0.6 0.6 0.6\n\tmap_Kd c.png\n");
  EXPECT_EQ(importScene(path)->materials[0].albedo, vec4(0.6f, 0.6f, 0.6f, 1.f));
}

// One of the two quads of a TORCS tree would be missing from every side.
// One point light in a document of one triangle; `technique` is its <technique_common>.
std::string colladaWith(const std::string& technique) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
 <library_lights><light id="lamp" name="lamp"><technique_common>)" +
         technique + R"(</technique_common></light></library_lights>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
   <accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
    <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s">
  <node id="n"><instance_geometry url="#g"/></node>
  <node id="l"><translate>1 2 3</translate><instance_light url="#lamp"/></node>
 </visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";
}

// docs/user/scene-files.md: strength 1 is pi candela; a colour above 1 is strength.
TEST_F(Import, StrengthsOfColladaLightsAreRelative) {
  Result<Scene> scene =
      importScene(write("lamp.dae", colladaWith("<point><color>0.5 1 0.25</color></point>")));
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->lights.size(), 1u);
  EXPECT_EQ(scene->lights[0].kind, LightKind::Point);
  EXPECT_EQ(scene->lights[0].color, vec3(0.5f, 1.f, 0.25f));
  EXPECT_FLOAT_EQ(scene->lights[0].intensity, kPi);
  EXPECT_EQ(scene->lights[0].attenuation, vec3(1.f, 0.f, 0.f));

  scene = importScene(
      write("lamp.dae",
            colladaWith("<point><color>2 4 1</color><constant_attenuation>0</constant_attenuation>"
                        "<quadratic_attenuation>0.5</quadratic_attenuation></point>")));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->lights[0].color, vec3(0.5f, 1.f, 0.25f));
  EXPECT_FLOAT_EQ(scene->lights[0].intensity, 4.f * kPi);
  EXPECT_EQ(scene->lights[0].attenuation, vec3(0.f, 0.f, 0.5f));
  updateTransforms(*scene);
  EXPECT_EQ(placeLights(*scene)[0].positionW, vec3(1, 2, 3));
}

TEST_F(Import, StrengthsOfFbxLightsArePercents) {
  const auto fbx = [](const char* decay) {
    return std::string(R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7300
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",100
	}
}
Objects:  {
	Geometry: 1, "Geometry::g", "Mesh" {
		Vertices: *9 {
			a: 0,0,0,1,0,0,0,1,0
		}
		PolygonVertexIndex: *3 {
			a: 0,1,-3
		}
	}
	Model: 2, "Model::m", "Mesh" {
		Version: 232
	}
	NodeAttribute: 3, "NodeAttribute::lamp", "Light" {
		Properties70:  {
			P: "Color", "Color", "", "A",1,0.5,0.25
			P: "Intensity", "Number", "", "A",300
			P: "LightType", "enum", "", "",0
			P: "DecayType", "enum", "", "",)") +
           decay + R"(
			P: "DecayStart", "Number", "", "A",4
		}
		TypeFlags: "Light"
	}
	Model: 4, "Model::lamp", "Light" {
		Version: 232
	}
}
Connections:  {
	C: "OO",2,0
	C: "OO",1,2
	C: "OO",4,0
	C: "OO",3,4
}
)";
  };
  for (const auto& [decay, attenuation] :
       {std::pair{"1", vec3(0, 0.5f, 0)}, std::pair{"2", vec3(0, 0, 0.125f)}}) {
    const Result<Scene> scene = importScene(write("lamp.fbx", fbx(decay)));
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->lights.size(), 1u);
    EXPECT_EQ(scene->lights[0].color, vec3(1.f, 0.5f, 0.25f));
    EXPECT_FLOAT_EQ(scene->lights[0].intensity, 3.f * kPi);
    EXPECT_EQ(scene->lights[0].attenuation, attenuation) << "decay " << decay;
  }
}

TEST_F(Import, SurfacesOfAc3dShowBothSides) {
  const Result<Scene> scene = importScene(write("q.ac", R"(AC3Db
MATERIAL "" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 10 trans 0
OBJECT world
kids 1
OBJECT poly
numvert 3
0 0 0
1 0 0
0 1 0
numsurf 1
SURF 0x30
mat 0
refs 3
0 0 0
1 1 0
2 0 1
kids 0
)"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->materials.at(0).doubleSided);
}

TEST_F(Import, FilesWithoutMaterialsShowBothSides) {
  constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  constexpr const char* kPly =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const auto& [name, text] : {std::pair("t.obj", kTriangle), std::pair("t.ply", kPly)}) {
    const Result<Scene> scene = loadScene(write(name, text).string());
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->materials.at(scene->objects.at(0).material).doubleSided) << name;
  }
}

TEST_F(Import, NormalMapsInBumpSlotsAreUsed) {
  write("q.mtl", "newmtl m\nmap_bump n.png\n");
  writePicture("n.png", {128, 128, 255, 255}, 3);
  const Result<Scene> scene = loadScene(write("q.obj", kQuad).string());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->materials[0].normalTexture.used());
  EXPECT_EQ(scene->meshes[0].tangents.size(), scene->meshes[0].positions.size());
}

TEST_F(Import, TexturesAreFoundWhereOtherMachinesPutThem) {
  write("q.mtl", "newmtl m\nmap_Kd C:\\art\\Wall.PNG\n");
  fs::create_directories(folder_ / "textures");
  writePicture("textures/wall.png", {10, 20, 30, 255}, 3);
  const Result<Scene> scene = importScene(write("q.obj", kQuad));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->textures[0].image->width(), 4);
  EXPECT_THAT(scene->warnings, testing::IsEmpty());
}

TEST_F(Import, WhatIsMissingIsNamed) {
  Result<Scene> scene = importScene(write("q.obj", kQuad));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("material library 'q.mtl'")));
  write("q.mtl", "newmtl m\nmap_Kd lost.png\n");
  scene = importScene(folder_ / "q.obj");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("lost.png is replaced by a checkerboard")));
}

TEST_F(Import, VerticesThatAreNotNumbersCostTheirTriangles) {
  const Result<Scene> scene =
      importScene(write("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangleCount(), 1u);
  EXPECT_THAT(scene->warnings, Contains(HasSubstr("1 triangles have a corner")));
}

TEST_F(Import, TorcsTracksKeepTheirBaseTexture) {
  const fs::path path =
      fs::path(LUCERNA_SOURCE_DIR) / "../shared/scenes/torcs_street-1/street-1.acc";
  if (!fs::exists(path)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  const Result<Scene> scene = importScene(path);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangleCount(), 25508u);
  EXPECT_LT(scene->materials.size(), 50u);
  EXPECT_EQ(scene->textures.size(), 43u);
  EXPECT_THAT(scene->warnings, testing::IsEmpty());
}

TEST_F(Import, SponzaIsWhole) {
  const fs::path path = fs::path(LUCERNA_SOURCE_DIR) / "../shared/scenes/crytek_sponza/sponza.obj";
  if (!fs::exists(path)) GTEST_SKIP() << "no ../shared/scenes beside this checkout";
  const Result<Scene> scene = importScene(path);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangleCount(), 262267u);
  EXPECT_THAT(scene->warnings, testing::IsEmpty());
  int masks = 0, normalMaps = 0;
  for (const Material& m : scene->materials) {
    masks += m.alphaMode == AlphaMode::Mask;
    normalMaps += m.normalTexture.used();
  }
  EXPECT_EQ(masks, 3);
  EXPECT_EQ(normalMaps, 9);
}

TEST_F(Import, ACrashOfTheReaderIsAMessage) {
  const Result<Scene> scene = importScene(write("worker_crashes.obj", kQuad));
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::Input);
  EXPECT_THAT(scene.error().message, HasSubstr("crashed"));
  EXPECT_THAT(scene.error().message, HasSubstr("worker_crashes.obj"));
}

TEST_F(Import, AnAnswerThatIsNoSceneIsAMessage) {
  const Result<Scene> scene = importScene(write("worker_lies.obj", kQuad));
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("does not start as it should"));
}

TEST_F(Import, AHangEndsInTime) {
  const auto start = std::chrono::steady_clock::now();
  const Result<Scene> scene = importScene(write("worker_hangs.obj", kQuad));
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("was killed after 5 s"));
  EXPECT_LT(time.count(), 10.);
}

// Reader and program together stay within 1 GiB: the reader's own memory, its answer in the pipe's
// buffer, which may double while it grows, and the scene made from it.
TEST_F(Import, AMissingWorkerIsNoFaultOfTheFile) {
  const std::string before = std::getenv("LUCERNA_WORKER");
  setenv("LUCERNA_WORKER", "/nowhere/lucerna_worker", 1);
  const Result<Scene> scene = importScene(write("q.obj", kQuad));
  setenv("LUCERNA_WORKER", before.c_str(), 1);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::Failed);
  EXPECT_THAT(scene.error().message, HasSubstr("build or install it again"));
}

TEST(ImportLimits, LieBelowTheBoundAndGrowWithTheFile) {
  const ChildLimits small = importLimits(1000), large = importLimits(100 << 20);
  EXPECT_LE(small.time, std::chrono::seconds(6));
  EXPECT_LE(small.residentBytes + 3 * small.outputBytes, 800u << 20);
  // A million triangles as text of FBX: 126 MiB, 5 s and 2.1 GiB in assimp.
  EXPECT_GE(large.residentBytes, 3ull << 30);
  EXPECT_GE(large.outputBytes, 512u << 20);
  EXPECT_GE(large.time, std::chrono::seconds(50));
}

TEST_F(Import, AHungerForMemoryIsAMessage) {
  const Result<Scene> scene = importScene(write("worker_hungers.obj", kQuad));
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("more than 384 MiB of memory"));
}

TEST_F(Import, GarbageIsRefused) {
  for (const char* name : {"g.ac", "g.dae", "g.fbx", "g.ply", "g.3ds", "g.obj"}) {
    const Result<Scene> scene = importScene(write(name, "this is no scene\n\x01\x02\xff at all"));
    ASSERT_FALSE(scene) << name;
    EXPECT_THAT(scene.error().message, HasSubstr(name));
  }
}

TEST(MeshBuild, SmoothsFlatAnglesAndKeepsCreases) {
  Mesh loose;  // three faces around an edge: 0, 20 and 90 degrees
  const vec3 a(0, 0, 0), b(0, 0, 1);
  const auto add = [&](vec3 c) {
    for (const vec3 p : {a, b, c}) {
      loose.indices.push_back(static_cast<std::uint32_t>(loose.positions.size()));
      loose.positions.push_back(p);
    }
  };
  add({1, 0, 0});
  add({std::cos(0.35f), std::sin(0.35f), 0});
  add({0, 1, 0});
  std::size_t dropped = 0;
  const Mesh mesh = buildMesh(loose, dropped);
  EXPECT_EQ(mesh.positions.size(), 7u);  // a and b twice: smooth pair and crease
  EXPECT_EQ(mesh.normals[mesh.indices[0]], mesh.normals[mesh.indices[3]]);
  EXPECT_NE(mesh.normals[mesh.indices[0]], mesh.normals[mesh.indices[6]]);
}

TEST(MeshBuild, DropsIndicesThatPointNowhere) {
  Mesh loose;
  loose.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  loose.indices = {0, 1, 2, 0, 1, 9};
  std::size_t dropped = 0;
  EXPECT_EQ(buildMesh(loose, dropped).triangleCount(), 1u);
  EXPECT_EQ(dropped, 1u);
}

ImportedScene smallScene() {
  ImportedScene imported;
  Scene& scene = imported.scene;
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.meshes[0].indices = {0, 1, 2};
  scene.materials.resize(1);
  scene.materials[0].name = "m";
  scene.materials[0].albedoTexture.texture = 0;
  imported.textures.emplace_back().path = "a.png";
  addNode(scene, "n", mat4(1.f));
  scene.objects.push_back({0, 0, 0, {}});
  scene.lights.emplace_back().node = 0;
  scene.warnings.push_back("w");
  scene.bake.area.emplace();
  scene.bake.mapSize = 512;
  return imported;
}

TEST(SceneStream, ComesBackAsItWas) {
  const Result<ImportedScene> back = readStream(writeStream(smallScene()));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(writeStream(*back), writeStream(smallScene()));
  EXPECT_EQ(back->scene.materials[0].name, "m");
  EXPECT_EQ(back->textures[0].path, "a.png");
  EXPECT_EQ(back->scene.bake, smallScene().scene.bake);
}

TEST(SceneStream, EveryCutIsRefused) {
  const Bytes whole = writeStream(smallScene());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(readStream(std::span(whole).first(size))) << size;
}

TEST(SceneStream, DamageNeverCrashes) {
  const Bytes whole = writeStream(smallScene());
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int value : {0, 1, 127, 255}) {
      Bytes damaged = whole;
      damaged[i] = static_cast<std::byte>(value);
      [[maybe_unused]] const auto result = readStream(damaged);
    }
}

TEST(SceneStream, IndicesOutOfRangeAreRefused) {
  ImportedScene imported = smallScene();
  imported.scene.meshes[0].indices[1] = 3;
  EXPECT_FALSE(readStream(writeStream(imported)));
  imported = smallScene();
  imported.scene.materials[0].albedoTexture.texture = 1;
  EXPECT_FALSE(readStream(writeStream(imported)));
  imported = smallScene();
  imported.scene.nodes[0].parent = 0;
  EXPECT_FALSE(readStream(writeStream(imported)));
  imported = smallScene();
  imported.scene.bake.area->attenuation = 0.f;
  EXPECT_FALSE(readStream(writeStream(imported)));
}

TEST(Ac3d, KeepsOnlyTheBaseLayer) {
  EXPECT_EQ(plainAc3d("AC3Db\r\ntexture \"a b.rgb\" base\ntexture \"s.rgb\" tiled\n"
                      "texture empty_texture_no_mapping shad\nrefs 2\n0 0.1 0.2 0.3 0.4 \n"
                      "1 0.5 0.6\nkids 0"),
            "AC3Db\ntexture \"a b.rgb\"\nrefs 2\n0 0.1 0.2\n1 0.5 0.6\nkids 0\n");
}

}  // namespace
}  // namespace lucerna::scene
