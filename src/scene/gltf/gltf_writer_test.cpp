#include "scene/gltf/gltf_writer.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "scene/gltf/gltf_structure.hpp"
#include "scene/gltf/same_scene.hpp"
#include "scene/load.hpp"

namespace lucerna::scene {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Material named(const char* name, MaterialModel model = MaterialModel::MetallicRoughness) {
  Material material;
  material.name = name;
  material.model = model;
  return material;
}

Material textured(std::uint32_t texture) {
  Material material;
  material.albedoTexture.texture = texture;
  return material;
}

// One triangle a mesh, each on a node of its own.
struct Small {
  Scene scene;

  Small() {
    scene.name = "small";
    scene.lights.reserve(8);  // references stay
  }

  Object& add(const Material& material) {
    const auto index = static_cast<std::uint32_t>(scene.meshes.size());
    Mesh mesh;
    mesh.positions = {vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)};
    mesh.normals.assign(3, vec3(0, 0, 1));
    mesh.indices = {0, 1, 2};
    mesh.bounds = {vec3(0, 0, 0), vec3(1, 1, 0)};
    scene.meshes.push_back(mesh);
    scene.materials.push_back(material);
    Node node;
    node.name = fmt::format("node {}", index);
    addNode(scene, node);
    return addObject(index, index, index);
  }
  Object& addObject(std::uint32_t node, std::uint32_t mesh, std::uint32_t material) {
    Object object;
    object.node = node;
    object.mesh = mesh;
    object.material = material;
    return scene.objects.emplace_back(object);
  }
  std::uint32_t addTexture(std::shared_ptr<const Image> image) {
    Texture& made = scene.textures.emplace_back();
    made.name = "picture";
    made.image = std::move(image);
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
  }
  Light& light(const char* name, LightKind kind) {
    Light& made = scene.lights.emplace_back();
    made.name = name;
    made.kind = kind;
    made.node = 0;
    return made;
  }
  GltfReport write(const GltfSettings& settings = {}) {
    updateTransforms(scene);
    const Result<GltfReport> report = writeGltf(scene, folder.path(), settings);
    EXPECT_TRUE(report) << report.error().message;
    for (const GltfLightmap& map : settings.lightmaps)
      EXPECT_TRUE(writeText(folder / map.file, ""));
    EXPECT_THAT(GltfStructure::faultsOf(folder / "scene.gltf"), IsEmpty());
    json = nlohmann::json::parse(*readText(folder / "scene.gltf"));
    return *report;
  }
  Scene read() {
    const Result<Scene> back = loadScene((folder / "scene.gltf").string());
    EXPECT_TRUE(back) << back.error().message;
    return *back;
  }

  TestFolder folder;
  nlohmann::json json;
};

std::shared_ptr<Image> picture(int side, std::uint8_t value) {
  auto image = std::make_shared<Image>(side, side, 3, ComponentType::U8);
  for (std::size_t i = 0; i < image->as<std::uint8_t>().size(); ++i)
    image->as<std::uint8_t>()[i] = static_cast<std::uint8_t>(value + 7 * i);
  return image;
}

TEST(GltfWriter, MaterialsComeBack) {
  Small small;
  const std::uint32_t first = small.addTexture(picture(4, 1)),
                      second = small.addTexture(picture(2, 9));
  small.scene.textures[first].wrapS = Wrap::ClampToEdge;
  small.scene.textures[first].nearest = true;
  small.scene.textures[second].wrapT = Wrap::MirroredRepeat;
  TextureSlot slot;
  slot.texture = first;
  slot.offset = vec2(0.25f, 0.f);
  slot.scale = vec2(2.f, 3.f);
  slot.rotation = 0.5f;
  Material metal = named("metal");
  metal.alphaMode = AlphaMode::Mask;
  metal.alphaCutoff = 0.3f;
  metal.doubleSided = true;
  metal.albedo = vec4(0.1f, 0.2f, 0.3f, 0.4f);
  metal.albedoTexture = slot;
  metal.emissive = vec3(10.f, 2.f, 0.1f);
  metal.emissiveTexture.texture = metal.normalTexture.texture = second;
  metal.metallicRoughnessTexture.texture = second;
  metal.occlusionTexture.texture = first;
  metal.normalScale = 0.7f;
  metal.metallic = 0.6f;
  metal.roughness = 0.3f;
  metal.occlusionStrength = 0.8f;
  small.add(metal);
  Material sign = named("sign", MaterialModel::Unlit);
  sign.alphaMode = AlphaMode::Blend;
  sign.albedo = vec4(0.3f, 0.4f, 0.5f, 0.6f);
  small.add(sign);
  Material glossy = named("glossy", MaterialModel::SpecularGlossiness);
  glossy.albedo = vec4(0.3f, 0.4f, 0.5f, 1.f);
  glossy.roughness = 0.25f;
  glossy.specular = vec3(0.1f, 0.2f, 0.7f);
  glossy.specularTexture = slot;
  small.add(glossy);
  EXPECT_THAT(small.write().notes, IsEmpty());
  const Scene back = small.read();
  EXPECT_THAT(back.warnings, IsEmpty());
  for (std::size_t i = 0; i < 3; ++i)
    expectSameMaterial(small.scene, small.scene.materials[i], back, back.materials[i]);
  EXPECT_EQ(small.json["images"].size(), 2u);  // each once
  // For readers without the extension.
  EXPECT_FLOAT_EQ(small.json["materials"][2]["pbrMetallicRoughness"]["baseColorFactor"][0], 0.09f);
}

TEST(GltfWriter, APhongMaterialGetsTheRoughnessOfItsHighlight) {
  Small small;
  small.add(named("dull", MaterialModel::Phong));
  Material shiny = named("shiny", MaterialModel::Phong);
  shiny.specular = vec3(0.5f);
  shiny.shininess = 40.f;
  small.add(shiny);
  EXPECT_THAT(small.write().notes, ElementsAre(HasSubstr("Phong")));
  const Scene back = small.read();
  EXPECT_EQ(back.materials[0].roughness, 1.f);
  EXPECT_EQ(back.materials[0].metallic, 0.f);
  EXPECT_NEAR(back.materials[1].roughness, 1.f / 3.f, 1e-6f);  // (1 / 81)^(1/4)
}

TEST(GltfWriter, PicturesThatAreSharedAreWrittenOnce) {
  Small small;
  const auto image = picture(4, 3);
  for (int i = 0; i < 3; ++i) small.add(textured(small.addTexture(image)));
  small.scene.textures[2].wrapS = Wrap::ClampToEdge;
  small.addTexture(picture(2, 5));  // of no material
  const GltfReport report = small.write();
  EXPECT_EQ(small.json["images"].size(), 1u);
  EXPECT_EQ(small.json["textures"].size(), 3u);
  EXPECT_EQ(small.json["samplers"].size(), 2u);
  std::vector<std::string> names;
  for (const GltfReport::File& file : report.files) names.push_back(file.name);
  EXPECT_THAT(names, ElementsAre("tex-000.png", "scene.bin", "scene.gltf"));
}

TEST(GltfWriter, PicturesOfFloatsBecomeSrgb) {
  Small small;
  auto image = std::make_shared<Image>(1, 1, 4, ComponentType::F32);
  for (int c = 0; c < 4; ++c) image->pixel<float>(0, 0)[c] = std::array{0.5f, 7.f, 0.f, 0.5f}[c];
  small.add(textured(small.addTexture(image)));
  EXPECT_THAT(small.write().notes, ElementsAre(HasSubstr("floats")));
  const Result<Image> back = readImage(small.folder / "tex-000.png");
  ASSERT_TRUE(back);
  const std::uint8_t* p = back->pixel<std::uint8_t>(0, 0);
  EXPECT_THAT(std::vector<int>(p, p + 4), ElementsAre(188, 255, 0, 128));
}

TEST(GltfWriter, ObjectsThatShareAMeshAndAMaterialShareTheGltfMesh) {
  Small small;
  small.add(named("a"));
  for (int i = 0; i < 4; ++i) {
    Node node;
    node.parent = 0;
    node.translation = vec3(i, 0, 0);
    small.addObject(addNode(small.scene, node), 0, 0);
  }
  small.write();
  EXPECT_EQ(small.json["meshes"].size(), 1u);
  EXPECT_EQ(small.json["accessors"].size(), 3u);
  expectSameTriangles(small.scene, small.read());
}

TEST(GltfWriter, LightsKeepWhatGltfCanSay) {
  Small small;
  small.add({});
  Light& sun = small.light("sun", LightKind::Directional);
  sun.color = vec3(1.f, 0.5f, 0.f);
  sun.intensity = 3.f;
  Light& lamp = small.light("lamp", LightKind::Point);
  lamp.color = vec3(2.f, 1.f, 4.f);
  lamp.intensity = 5.f;
  lamp.attenuation = vec3(0.f, 0.f, 2.f);
  lamp.range = 7.f;
  Light& spot = small.light("spot", LightKind::Spot);
  spot.innerCone = 0.3f;
  spot.outerCone = 0.4f;
  spot.node = kNone;
  small.light("off", LightKind::Point).on = false;
  small.light("head", LightKind::Directional);
  small.scene.headlight = 4;
  EXPECT_THAT(small.write().notes, ElementsAre("a light that is off is left out"));
  const Scene back = small.read();
  ASSERT_EQ(back.lights.size(), 3u);
  const auto sunBack = std::ranges::find(back.lights, "sun", &Light::name);
  EXPECT_EQ(sunBack->kind, LightKind::Directional);
  EXPECT_EQ(sunBack->color * sunBack->intensity, vec3(3.f, 1.5f, 0.f));
  const auto lampBack = std::ranges::find(back.lights, "lamp", &Light::name);
  EXPECT_EQ(lampBack->color * lampBack->intensity, vec3(5.f, 2.5f, 10.f));
  EXPECT_EQ(lampBack->range, 7.f);
  const auto spotBack = std::ranges::find(back.lights, "spot", &Light::name);
  EXPECT_EQ(spotBack->innerCone, 0.3f);
  EXPECT_EQ(spotBack->outerCone, 0.4f);
}

TEST(GltfWriter, ALightOfAnotherAttenuationIsRightHalfwayThroughTheScene) {
  Small small;
  small.add({});
  Light& lamp = small.light("lamp", LightKind::Point);
  lamp.intensity = 4.f;
  lamp.attenuation = vec3(1.f, 2.f, 3.f);
  EXPECT_THAT(small.write().notes, ElementsAre(HasSubstr("square of the distance")));
  const float d = 0.5f * std::sqrt(2.f);
  EXPECT_FLOAT_EQ(small.read().lights[0].intensity / (d * d), 4.f / (1 + 2 * d + 3 * d * d));
}

TEST(GltfWriter, CamerasComeBackAndOpenOnesAreChosen) {
  Small small;
  small.add({});
  small.scene.cameras.resize(3);
  for (Camera& camera : small.scene.cameras) camera.node = 0;
  Camera& eye = small.scene.cameras[0];
  eye.fovY = 0.5f;
  eye.aspect = 1.5f;
  eye.near = 0.2f;
  eye.far = 30.f;
  Camera& plan = small.scene.cameras[1];
  plan.orthographic = true;
  plan.height = 4.f;
  plan.aspect = 2.f;
  plan.far = 9.f;
  small.write();
  const Scene back = small.read();
  ASSERT_EQ(back.cameras.size(), 3u);
  EXPECT_EQ(back.cameras[0].fovY, 0.5f);
  EXPECT_EQ(back.cameras[0].aspect, 1.5f);
  EXPECT_EQ(back.cameras[0].near, 0.2f);
  EXPECT_EQ(back.cameras[0].far, 30.f);
  EXPECT_TRUE(back.cameras[1].orthographic);
  EXPECT_EQ(back.cameras[1].height, 4.f);
  EXPECT_EQ(back.cameras[1].aspect, 2.f);
  EXPECT_GT(back.cameras[2].near, 0.f);
}

TEST(GltfWriter, LinesPointsAndShearComeBack) {
  Small small;
  small.add(named("lines"));
  small.add(named("points"));
  small.scene.meshes[0].lines = {0, 1, 1, 2};
  small.scene.meshes[1].points = {2, 0};
  for (Mesh& mesh : small.scene.meshes) {
    mesh.indices.clear();
    mesh.normals.clear();
  }
  small.add(named("sheared"));
  mat4 shear(1.f);
  shear[1].x = 0.5f;
  small.scene.nodes[2].matrix = shear;
  small.write();
  const Scene back = small.read();
  EXPECT_EQ(back.meshes[0].lines.size(), 4u);
  EXPECT_EQ(back.meshes[1].points.size(), 2u);
  expectSameTriangles(small.scene, back);
}

TEST(GltfWriter, NamesThatAreNoUtf8AreMadeSo) {
  Small small;
  small.add(named("caf\xe9"));
  small.write();
  EXPECT_THAT(small.read().materials[0].name, HasSubstr("caf"));
}

// Two triangles of one mesh in two maps, a third in none.
Mesh mappedMesh() {
  Mesh mesh;
  for (int i = 0; i < 9; ++i) {
    mesh.positions.emplace_back(i % 3 == 1, i % 3 == 2, i / 3);
    mesh.texCoords[1].emplace_back(i, 0);
    mesh.lightmap.emplace_back(0.125f * static_cast<float>(i), 0.5f, 1 - i / 3);
    mesh.indices.push_back(static_cast<std::uint32_t>(i));
  }
  mesh.normals.assign(9, vec3(0, 0, 1));
  return mesh;
}

TEST(GltfWriter, MapsSplitPrimitivesAndMaterials) {
  Small small;
  small.add(named("wall"));
  small.scene.meshes[0] = mappedMesh();
  small.write({.lightmaps = {{"map-000.hdr"}, {"map-001.png", 2.5f}}});
  const Scene back = small.read();
  ASSERT_EQ(back.objects.size(), 3u);
  const auto& primitives = small.json["meshes"][0]["primitives"];
  const auto& materials = small.json["materials"];
  EXPECT_FALSE(materials[primitives[0]["material"].get<std::size_t>()].contains("extensions"));
  for (int map = 0; map < 2; ++map) {
    const auto& material = materials[primitives[map + 1]["material"].get<std::size_t>()];
    const auto& light = material["extensions"]["MOZ_lightmap"];
    EXPECT_EQ(material["name"], "wall");
    EXPECT_EQ(light["texCoord"], 1);
    EXPECT_EQ(light["intensity"], map == 0 ? 1.f : 2.5f);
    const auto& texture = small.json["textures"][light["index"].get<std::size_t>()];
    const std::size_t source =
        map == 0 ? texture["extensions"]["MOZ_texture_rgbe"]["source"].get<std::size_t>()
                 : texture["source"].get<std::size_t>();
    EXPECT_EQ(small.json["images"][source]["uri"], map == 0 ? "map-000.hdr" : "map-001.png");
    const Mesh& mesh = back.meshes[back.objects[static_cast<std::size_t>(map) + 1].mesh];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t vertex = static_cast<std::size_t>(1 - map) * 3 + k;
      EXPECT_EQ(mesh.positions[mesh.indices[k]], small.scene.meshes[0].positions[vertex]);
      EXPECT_EQ(mesh.texCoords[1][mesh.indices[k]], vec2(small.scene.meshes[0].lightmap[vertex]));
      EXPECT_EQ(mesh.texCoords[0][mesh.indices[k]], vec2(0.f));
    }
  }
}

TEST(GltfWriter, AMaterialThatUsesTheSecondSetKeepsIt) {
  Small small;
  Material material = textured(small.addTexture(picture(2, 0)));
  material.albedoTexture.texCoord = 1;
  small.add(material);
  small.scene.meshes[0] = mappedMesh();
  small.write({.lightmaps = {{"map-000.exr"}, {"map-001.exr"}}});
  const auto& primitive = small.json["meshes"][0]["primitives"][1];
  const auto& written = small.json["materials"][primitive["material"].get<std::size_t>()];
  EXPECT_EQ(written["extensions"]["MOZ_lightmap"]["texCoord"], 2);
  const Mesh& mesh = small.scene.meshes[0];
  const Scene back = small.read();
  for (std::size_t k = 0; k < 3; ++k) {
    const Mesh& read = back.meshes[back.objects[1].mesh];
    EXPECT_EQ(read.texCoords[1][read.indices[k]], mesh.texCoords[1][3 + k]);
  }
}

TEST(GltfWriter, WithoutPicturesOfLightThePlacesAreLeftOut) {
  Small small;
  small.add({});
  small.scene.meshes[0] = mappedMesh();
  small.write();
  EXPECT_EQ(small.json["meshes"][0]["primitives"].size(), 1u);
  EXPECT_FALSE(small.json.contains("extensionsUsed"));
}

TEST(GltfWriter, TheSameSceneGivesTheSameBytesAndTheReportTellsThem) {
  const Result<Scene> scene = loadScene("builtin:atrium");
  ASSERT_TRUE(scene);
  const TestFolder a, b;
  const Result<GltfReport> first = writeGltf(*scene, a.path()),
                           second = writeGltf(*scene, b.path());
  ASSERT_TRUE(first && second);
  ASSERT_EQ(first->files.size(), second->files.size());
  for (std::size_t i = 0; i < first->files.size(); ++i) {
    EXPECT_EQ(first->files[i].name, second->files[i].name);
    EXPECT_EQ(first->files[i].hash, second->files[i].hash);
    EXPECT_EQ(first->files[i].hash, hashBytes(*readFile(a / first->files[i].name)));
  }
  const auto count = std::distance(fs::directory_iterator(a.path()), fs::directory_iterator());
  EXPECT_EQ(static_cast<std::size_t>(count), first->files.size());
}

TEST(GltfWriter, SaysWhatCannotBeWritten) {
  Small small;
  small.add({});
  const Result<GltfReport> kind =
      writeGltf(small.scene, small.folder.path(), {.lightmaps = {{"map-000.ktx2"}}});
  ASSERT_FALSE(kind);
  EXPECT_EQ(kind.error().kind, ErrorKind::Usage);
  EXPECT_THAT(kind.error().message, HasSubstr("map-000.ktx2"));
  EXPECT_FALSE(writeGltf(small.scene, small.folder / "no such folder"));
}

}  // namespace
}  // namespace lucerna::scene
