#include "scene/builtin/builtin.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"

namespace lucerna::scene {
namespace {

using testing::HasSubstr;

Scene make(const std::string& spec) {
  Result<Scene> scene = makeBuiltin(spec);
  CHECK(static_cast<bool>(scene), "{}", scene.error().message);
  return std::move(scene).value();
}

template <typename T>
void addHash(std::uint64_t& hash, const std::vector<T>& stream) {
  hash = hashBytes(std::as_bytes(std::span(stream)), hash);
}

// Of everything that a thread or a seed could change.
std::uint64_t hashOf(const Scene& scene) {
  std::uint64_t hash = 0;
  for (const Mesh& mesh : scene.meshes) {
    addHash(hash, mesh.positions);
    addHash(hash, mesh.normals);
    addHash(hash, mesh.texCoords[0]);
    addHash(hash, mesh.indices);
  }
  for (const Texture& texture : scene.textures) {
    hash = hashBytes(texture.image->bytes(), hash);
    for (const auto& face : texture.faces) hash = hashBytes(face->bytes(), hash);
  }
  for (const Node& node : scene.nodes)
    hash = hashBytes(std::as_bytes(std::span(&node.worldFromNode, 1)), hash);
  for (const Light& light : scene.lights)
    hash = hashBytes(std::as_bytes(std::span(&light.color, 1)), hash);
  for (const Animation& animation : scene.animations)
    for (const AnimationChannel& channel : animation.channels) addHash(hash, channel.values);
  return hash;
}

void expectSoundMesh(const Mesh& mesh) {
  SCOPED_TRACE(mesh.name);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.texCoords[0].size(), mesh.positions.size());
  ASSERT_EQ(mesh.indices.size() % 3, 0u);
  ASSERT_FALSE(mesh.indices.empty());
  for (const vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-4);
  for (const vec2& uv : mesh.texCoords[0])
    ASSERT_TRUE(std::abs(uv.x) < 1e4f && std::abs(uv.y) < 1e4f);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (int k = 0; k < 3; ++k) ASSERT_LT(mesh.indices[i + k], mesh.positions.size());
    const vec3 p = mesh.positions[mesh.indices[i]];
    const vec3 cross = glm::cross(mesh.positions[mesh.indices[i + 1]] - p,
                                  mesh.positions[mesh.indices[i + 2]] - p);
    ASSERT_GT(glm::length(cross), 0.f) << "triangle " << i / 3;
    for (int k = 0; k < 3; ++k)
      ASSERT_GT(glm::dot(cross, mesh.normals[mesh.indices[i + k]]), 0.f) << "triangle " << i / 3;
  }
}

void expectSlot(const Scene& scene, const TextureSlot& slot) {
  ASSERT_TRUE(!slot.used() || slot.texture < scene.textures.size());
}

void expectSound(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) expectSoundMesh(mesh);
  for (const Material& material : scene.materials) {
    expectSlot(scene, material.albedoTexture);
    expectSlot(scene, material.emissiveTexture);
    expectSlot(scene, material.normalTexture);
    for (const CustomShader::Picture& picture : material.shader.textures)
      ASSERT_LT(picture.texture, scene.textures.size());
  }
  for (const Texture& texture : scene.textures) ASSERT_NE(texture.image, nullptr);
  for (const Object& object : scene.objects) {
    ASSERT_LT(object.node, scene.nodes.size());
    ASSERT_LT(object.mesh, scene.meshes.size());
    ASSERT_LT(object.material, scene.materials.size());
    ASSERT_FALSE(object.boundsW.empty());
  }
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    ASSERT_TRUE(scene.nodes[i].parent == kNone || scene.nodes[i].parent < i);
  for (const Light& light : scene.lights) ASSERT_LT(light.node, scene.nodes.size());
  for (const Camera& camera : scene.cameras) ASSERT_LT(camera.node, scene.nodes.size());
}

TEST(Builtin, RefusesWhatItDoesNotKnow) {
  const auto message = [](const char* spec) {
    const Result<Scene> scene = makeBuiltin(spec);
    return scene ? std::string() : scene.error().message;
  };
  EXPECT_THAT(message("builtin:nihgtcity"), HasSubstr("did you mean 'nightcity'"));
  EXPECT_THAT(message("builtin:atrium?light=3"), HasSubstr("did you mean 'lights'"));
  EXPECT_THAT(message("builtin:atrium?lights=many"), HasSubstr("0 to 4096"));
  EXPECT_THAT(message("builtin:atrium?lights"), HasSubstr("key=value"));
  EXPECT_THAT(message("builtin:atrium?lights=1&lights=2"), HasSubstr("twice"));
  EXPECT_THAT(message("builtin:atrium?kind=sopt"), HasSubstr("did you mean 'spot'"));
  EXPECT_THAT(message("builtin:atrium?moving=1.5"), HasSubstr("0 to 1"));
  EXPECT_THAT(message("builtin:nightcity?blocks=2"), HasSubstr("6 to 64"));
  EXPECT_THAT(message("builtin:nightcity?sun=95,0"), HasSubstr("two numbers"));
  EXPECT_THAT(message("builtin:nightcity?sun=nan,0"), HasSubstr("two numbers"));
  EXPECT_THAT(message("builtin:penumbra?case=fense"), HasSubstr("did you mean 'fence'"));
  EXPECT_THAT(message("builtin:penumbra?case=fence&k=4"), HasSubstr("unknown key 'k'"));
  EXPECT_THAT(message("builtin:penumbra?case=overlap&k=33"), HasSubstr("1 to 32"));
  const Result<Scene> several = makeBuiltin("builtin:atrium?ligths=3&kind=x");
  ASSERT_FALSE(several);
  EXPECT_EQ(several.error().kind, ErrorKind::Input);
  EXPECT_THAT(several.error().message, HasSubstr("'lights'"));
  EXPECT_THAT(several.error().message, HasSubstr("kind"));
}

TEST(Builtin, TheSameBitsForAnyNumberOfThreads) {
  const int before = threadCount();
  for (const char* spec : {"builtin:atrium?moving=0.1", "builtin:nightcity?jitter=1",
                           "builtin:materials", "builtin:mirrors"}) {
    setThreadCount(1);
    const std::uint64_t one = hashOf(make(spec));
    setThreadCount(4);
    EXPECT_EQ(hashOf(make(spec)), one) << spec;
  }
  setThreadCount(before);
  EXPECT_NE(hashOf(make("builtin:atrium?seed=1")), hashOf(make("builtin:atrium?seed=2")));
}

TEST(Atrium, IsSoundAndHasAbout60000Triangles) {
  const Scene scene = make("builtin:atrium?glass=1");
  expectSound(scene);
  EXPECT_GE(scene.triangleCount(), 55'000u);
  EXPECT_LE(scene.triangleCount(), 65'000u);
  EXPECT_EQ(scene.lights.size(), 16u);
  EXPECT_EQ(scene.cameras.size(), 3u);
  EXPECT_EQ(scene.cameras[0].name, "main");
}

TEST(Atrium, HasAsManyLightsOfTheKindAsAskedFor) {
  for (const std::uint32_t count : {0u, 1u, 64u}) {
    const Scene scene = make("builtin:atrium?kind=point&lights=" + std::to_string(count));
    ASSERT_EQ(scene.lights.size(), count);
    for (const Light& light : scene.lights) EXPECT_EQ(light.kind, LightKind::Point);
  }
}

// Points on the floor and the walls are within the reach of several lights.
TEST(Atrium, ReachesOverlap) {
  const Scene scene = make("builtin:atrium?kind=point");
  const std::vector<PlacedLight> lights = placeLights(scene);
  for (const vec3 point : {vec3(0, 0, 0), vec3(8, 0, 15), vec3(-10.5f, 4, -15), vec3(3, 0, -20)}) {
    int reaching = 0;
    for (const PlacedLight& light : lights)
      reaching += glm::length(light.positionW - point) < light.reach;
    EXPECT_GE(reaching, 4);
  }
}

TEST(Atrium, LightsReachAsFarAsAskedFor) {
  for (const PlacedLight& light : placeLights(make("builtin:atrium?reach=7")))
    EXPECT_EQ(light.reach, 7.f);
}

TEST(Atrium, MovesATenthOfItsObjects) {
  Scene scene = make("builtin:atrium?moving=0.1");
  const std::size_t moved = animate(scene, 1.3f).size();
  // A chosen node may carry children, so a few more objects may move.
  EXPECT_NEAR(static_cast<double>(moved), 0.1 * static_cast<double>(scene.objects.size()),
              0.02 * static_cast<double>(scene.objects.size()));
  EXPECT_TRUE(make("builtin:atrium").animations.empty());
}

TEST(NightCity, IsSoundAndAsLargeAsTheThesisCity) {
  const Scene scene = make("builtin:nightcity");
  expectSound(scene);
  EXPECT_GE(scene.triangleCount(), 38'000u);
  EXPECT_LE(scene.triangleCount(), 42'000u);
  const vec3 extent = scene.boundsW().extent();
  EXPECT_NEAR(extent.x * extent.z, 4e6, 0.1e6);
  for (const char* name : {"street", "highway", "tunnel", "aerial"})
    EXPECT_TRUE(std::any_of(scene.cameras.begin(), scene.cameras.end(), [&](const Camera& camera) {
      return camera.name == name;
    })) << name;
}

TEST(NightCity, Has106LampsOfWhich13SwitchAlone) {
  const Scene scene = make("builtin:nightcity");
  EXPECT_EQ(scene.lights.size(), 106u);
  std::set<std::string> groups;
  std::size_t switchable = 0;
  for (const Light& light : scene.lights) {
    if (light.group.empty()) continue;
    ++switchable;
    groups.insert(light.group);
  }
  EXPECT_EQ(switchable, 13u);
  EXPECT_EQ(groups.size(), 13u);
  EXPECT_TRUE(groups.contains("lamp-01"));
  EXPECT_TRUE(groups.contains("lamp-13"));
  for (const PlacedLight& light : placeLights(scene)) {
    EXPECT_GE(light.reach, 36.f);
    EXPECT_LE(light.reach, 73.f);
  }
}

float luminanceAt(const Scene& scene, const TextureSlot& slot, vec2 uv) {
  const Image& image = *scene.textures[slot.texture].image;
  uv -= glm::floor(uv);
  const int x =
      std::min(static_cast<int>(uv.x * static_cast<float>(image.width())), image.width() - 1);
  const int y =
      std::min(static_cast<int>(uv.y * static_cast<float>(image.height())), image.height() - 1);
  const std::uint8_t* pixel = image.pixel<std::uint8_t>(x, y);
  return static_cast<float>(pixel[0] + pixel[1] + pixel[2]);
}

// How many lightmap texels lie on lit parts of emission textures, when eight maps of 2048^2, three
// quarters of them used, are spread over all surfaces. Each texel of the lightmap is one sample of
// its triangle: samples are drawn, not placed, so the count has a standard error of a few hundred.
double emitterPoints(const Scene& scene) {
  constexpr double kTexels = 8 * 2048.0 * 2048.0 * 0.75;
  struct Triangle {
    const Object* object;
    std::size_t first;
    double area;
  };
  std::vector<Triangle> shining;
  double total = 0;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    const mat4& world = scene.nodes[object.node].worldFromNode;
    const bool shines = scene.materials[object.material].emissiveTexture.used();
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) {
        return vec3(world * vec4(mesh.positions[mesh.indices[i + k]], 1));
      };
      const vec3 p = corner(0);
      const double area = 0.5 * glm::length(glm::cross(corner(1) - p, corner(2) - p));
      total += area;
      if (shines) shining.push_back({&object, i, area});
    }
  }
  Random random(1);
  double points = 0;
  for (const Triangle& triangle : shining) {
    const Mesh& mesh = scene.meshes[triangle.object->mesh];
    const TextureSlot& slot = scene.materials[triangle.object->material].emissiveTexture;
    const double texels = triangle.area * kTexels / total;
    const int samples = static_cast<int>(std::ceil(texels));
    int lit = 0;
    for (int s = 0; s < samples; ++s) {
      const float a = std::sqrt(random.uniform()), b = random.uniform();
      const auto uv = [&](std::size_t k) {
        return mesh.texCoords[0][mesh.indices[triangle.first + k]];
      };
      lit +=
          luminanceAt(scene, slot, uv(0) * (1 - a) + uv(1) * (a * (1 - b)) + uv(2) * (a * b)) > 0;
    }
    points += texels * lit / samples;
  }
  return points;
}

TEST(NightCity, LitWindowsGive150000PointsAtEightMaps) {
  for (const char* spec : {"builtin:nightcity", "builtin:nightcity?seed=5&jitter=1&rotate=17"})
    EXPECT_NEAR(emitterPoints(make(spec)), 150'000, 7'500) << spec;
}

TEST(NightCity, RotateTurnsEverythingAndJitterTurnsBuildings) {
  const Scene plain = make("builtin:nightcity"), turned = make("builtin:nightcity?rotate=17");
  const float angle = glm::radians(17.f);
  const vec3 before = placeLights(plain)[5].positionW, after = placeLights(turned)[5].positionW;
  EXPECT_NEAR(after.x, before.x * std::cos(angle) + before.z * std::sin(angle), 1e-2);
  EXPECT_NEAR(after.z, -before.x * std::sin(angle) + before.z * std::cos(angle), 1e-2);

  // Of all upright walls of the blocks, how many are along an axis?
  const auto alignedShare = [](const Scene& scene) {
    std::size_t aligned = 0, walls = 0;
    for (const Mesh& mesh : scene.meshes) {
      if (mesh.name.find("facade") == std::string::npos) continue;
      for (const vec3& normal : mesh.normals) {
        if (std::abs(normal.y) > 0.01f) continue;
        ++walls;
        aligned += std::abs(normal.x) > 0.9999f || std::abs(normal.z) > 0.9999f;
      }
    }
    return static_cast<double>(aligned) / static_cast<double>(walls);
  };
  EXPECT_EQ(alignedShare(plain), 1.0);
  EXPECT_LT(alignedShare(make("builtin:nightcity?jitter=1")), 0.2);
}

TEST(NightCity, SunShinesFromWhereItIsAskedFor) {
  const Scene scene = make("builtin:nightcity?sun=30,90");
  ASSERT_EQ(scene.lights.size(), 107u);
  const PlacedLight sun = placeLights(scene).back();
  EXPECT_EQ(sun.kind, LightKind::Directional);
  EXPECT_NEAR(sun.directionW.x, -std::cos(glm::radians(30.f)), 1e-4);
  EXPECT_NEAR(sun.directionW.y, -0.5f, 1e-4);
  EXPECT_NEAR(sun.directionW.z, 0.f, 1e-4);
  EXPECT_EQ(placeLights(make("builtin:nightcity?sun=30,90&lamps=0")).size(), 1u);
}

TEST(NightCity, FortyBlocksHaveMillionsOfTrianglesInLittleMemory) {
  const Scene scene = make("builtin:nightcity?blocks=40");
  EXPECT_GT(scene.triangleCount(), 2'000'000u);
  EXPECT_GT(scene.lights.size(), 2000u);
  std::size_t bytes = 0;
  for (const Mesh& mesh : scene.meshes)
    bytes += mesh.positions.size() * 32 + mesh.indices.size() * 4;
  EXPECT_LT(bytes, 64u << 20);
}

TEST(Materials, FiveCubesStandInTheThesisOrder) {
  const Scene scene = make("builtin:materials");
  expectSound(scene);
  std::vector<std::pair<float, std::string>> cubes;  // by x
  for (const Object& object : scene.objects) {
    const std::string& name = scene.materials[object.material].name;
    if (name == "floor" || name == "plinth") continue;
    const Node& node = scene.nodes[object.node];
    const bool pane = node.name.starts_with("side");
    cubes.emplace_back((pane ? scene.nodes[node.parent] : node).worldFromNode[3].x, name);
  }
  std::sort(cubes.begin(), cubes.end());
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  std::vector<std::string> names;
  for (const auto& [x, name] : cubes) names.push_back(name);
  EXPECT_THAT(names, testing::ElementsAre("lattice", "chrome", "glass", "waves", "lava"));
  const auto material = [&](const char* name) {
    return *std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const Material& m) { return m.name == name; });
  };
  EXPECT_EQ(material("lattice").alphaMode, AlphaMode::Blend);
  EXPECT_EQ(material("lattice").albedo.w, 1.f) << "its opacity is the texture's";
  EXPECT_EQ(material("chrome").emissiveTexture.coordinates, Coordinates::Reflection);
  EXPECT_LT(material("glass").albedo.w, 1.f);
  EXPECT_EQ(material("waves").albedoTexture.coordinates, Coordinates::EyeLinear);
  EXPECT_TRUE(material("lava").shader.used());
}

// The objects whose material is a mirror, with their corners in the world.
std::vector<std::pair<const Material*, std::vector<vec3>>> mirrorsOf(const Scene& scene) {
  std::vector<std::pair<const Material*, std::vector<vec3>>> mirrors;
  for (const Object& object : scene.objects) {
    const Material& material = scene.materials[object.material];
    if (!isMirror(material)) continue;
    std::vector<vec3> corners;
    for (const vec3& position : scene.meshes[object.mesh].positions)
      corners.push_back(vec3(scene.nodes[object.node].worldFromNode * vec4(position, 1)));
    mirrors.emplace_back(&material, corners);
  }
  return mirrors;
}

vec3 normalOf(const std::vector<vec3>& corners) {
  return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

TEST(Mirrors, ArePlanarTwoFaceEachOtherAndOneReflectsInPart) {
  const Scene scene = make("builtin:mirrors");
  expectSound(scene);
  const auto mirrors = mirrorsOf(scene);
  EXPECT_EQ(mirrors.size(), 5u);
  int facing = 0, partial = 0;
  for (const auto& [material, corners] : mirrors) {
    const vec3 n = normalOf(corners);
    for (const vec3& corner : corners) EXPECT_NEAR(glm::dot(n, corner - corners[0]), 0, 1e-5);
    partial += material->reflectivity < 0.5f;
    for (const auto& [other, otherCorners] : mirrors) {
      const vec3 between = otherCorners[0] - corners[0];
      facing += glm::dot(n, normalOf(otherCorners)) < -0.999f && glm::dot(between, n) > 1;
    }
  }
  EXPECT_EQ(facing, 2) << "each of one pair";
  EXPECT_EQ(partial, 1);
  EXPECT_EQ(mirrorsOf(make("builtin:mirrors?single=1")).size(), 1u);
}

TEST(Mirrors, TheTwinIsTheRoomsMirrorImageWithLightsOfItsOwn) {
  const Scene room = make("builtin:mirrors?single=1"), twin = make("builtin:mirrors?twin=1");
  expectSound(room);
  EXPECT_TRUE(mirrorsOf(twin).empty());
  const std::size_t half = twin.objects.size() / 2;
  ASSERT_EQ(half, room.objects.size() - 1) << "the main mirror is an opening";
  for (std::size_t i = 0; i < half; ++i) {
    const Object &a = twin.objects[i], &b = twin.objects[half + i];
    ASSERT_EQ(a.mesh, b.mesh);
    ASSERT_EQ(a.material, b.material);
    EXPECT_NEAR(a.boundsW.min.z + b.boundsW.max.z, -6, 1e-4);
    EXPECT_NEAR(a.boundsW.min.x, b.boundsW.min.x, 1e-4);
    EXPECT_GE(a.boundsW.min.z, -3 - 1e-4) << twin.nodes[a.node].name;
  }
  const std::vector<PlacedLight> lights = placeLights(twin);
  ASSERT_EQ(lights.size(), 2 * room.lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const PlacedLight& light = lights[i];
    const float side = i < lights.size() / 2 ? 1.f : -1.f;  // of the plane z = -3
    EXPECT_GT(side * (light.positionW.z + 3), 0);
    // Neither its range nor its cone crosses the plane.
    const bool near = side * (light.positionW.z + 3) > light.reach;
    const bool away =
        light.kind == LightKind::Spot &&
        std::acos(light.cosOuter) + std::acos(side * light.directionW.z) < glm::half_pi<float>();
    EXPECT_TRUE(near || away) << twin.lights[light.light].name;
  }
}

TEST(Cornell, HasTheMeasuresOfTheSharedFile) {
  const Scene scene = make("builtin:cornell");
  expectSound(scene);
  EXPECT_EQ(scene.triangleCount(), 36u) << "as CornellBox-Original.obj";
  const Aabb box = scene.boundsW();
  EXPECT_LT(glm::distance(box.min, vec3(-1.02f, 0, -1.04f)), 1e-5f);
  EXPECT_LT(glm::distance(box.max, vec3(1, 1.99f, 0.99f)), 1e-5f);
  EXPECT_EQ(make("builtin:cornell?boxes=0").triangleCount(), 12u);
}

// The far field of a Lambert surface of radiance L and area A: L A cos(angle to its normal).
TEST(Cornell, TheLightGivesWhatTheLampsSurfaceSendsOut) {
  const PlacedLight lamp = placeLights(make("builtin:cornell")).at(0);
  const float area = 0.47f * 0.38f;
  EXPECT_NEAR(lamp.intensity.x, 17 * area, 1e-4);
  EXPECT_NEAR(lamp.intensity.y, 12 * area, 1e-4);
  EXPECT_NEAR(lamp.intensity.z, 4 * area, 1e-4);
  EXPECT_NEAR(glm::pi<float>() * lamp.radius * lamp.radius, area, 1e-5);
  for (const float degrees : {0.f, 30.f, 60.f, 85.f})
    EXPECT_NEAR(coneFactor(lamp, std::cos(glm::radians(degrees))), std::cos(glm::radians(degrees)),
                1e-4);
}

}  // namespace
}  // namespace lucerna::scene
