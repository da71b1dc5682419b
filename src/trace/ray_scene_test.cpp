#include "trace/ray_scene.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::trace {
namespace {

using testing::addMaterial;
using testing::addSquare;

std::vector<Hit> closest(const RayScene& scene, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  scene.closest(rays, hits);
  return hits;
}
std::vector<vec3> transmittance(const RayScene& scene, const std::vector<Ray>& rays) {
  std::vector<vec3> shares(rays.size());
  scene.transmittance(rays, shares);
  return shares;
}

TEST(RayScene, FindsTheNearestWithinItsBounds) {
  scene::Scene scene = testing::emptyScene();
  addMaterial(scene);
  for (const float z : {-4.f, -2.f, -3.f}) addSquare(scene, {0, 0, z}, {1, 0, 0}, {0, 1, 0});
  const RayScene rays(scene, mat4(1.f));
  const auto hits = closest(
      rays, {{.near = 0.f}, {.near = 2.5f}, {.near = 2.5f, .far = 2.9f}, {.originW = {2, 0, 0}}});
  EXPECT_EQ(hits[0].spot.object, 1u);
  EXPECT_EQ(hits[0].t, 2.f);
  EXPECT_EQ(hits[1].spot.object, 2u);
  EXPECT_FALSE(hits[2].any());
  EXPECT_FALSE(hits[3].any());
}

// Packets and their rests give every ray its own answer.
TEST(RayScene, ManyRaysAreAsManySingleOnes) {
  scene::Scene scene = testing::emptyScene();
  addMaterial(scene);
  Random random(5);
  const auto place = [&] {
    return vec3(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-9, -1));
  };
  for (int i = 0; i < 40; ++i)
    addSquare(scene, place(), {0.5f, 0.1f, 0}, {0, 0.3f, random.uniform(-1, 1)});
  const RayScene rays(scene, mat4(1.f));
  std::vector<Ray> all;
  for (int i = 0; i < 1003; ++i) all.push_back({.directionW = place()});
  const auto hits = closest(rays, all);
  const auto shares = transmittance(rays, all);
  int count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Hit alone = closest(rays, {all[i]})[0];
    EXPECT_EQ(hits[i].spot.object, alone.spot.object) << i;
    EXPECT_EQ(hits[i].t, alone.t) << i;
    EXPECT_EQ(shares[i], vec3(alone.any() ? 0.f : 1.f)) << i;
    count += alone.any();
  }
  EXPECT_GT(count, 100);
  EXPECT_LT(count, 900);
}

TEST(RayScene, InstancesStandWhereTheirNodesAre) {
  scene::Scene scene = testing::emptyScene();
  addMaterial(scene);
  addSquare(scene, vec3(0), {1, 0, 0}, {0, 1, 0});
  scene::Object again = scene.objects[0];
  again.node =
      addNode(scene, "again", glm::scale(glm::translate(mat4(1.f), vec3(5, 0, -2)), vec3(-3)));
  scene.objects.push_back(again);
  updateTransforms(scene);
  const RayScene rays(scene, mat4(1.f));
  const Hit hit = closest(rays, {{.originW = {7.5f, 0, 0}}})[0];
  EXPECT_EQ(hit.spot.object, 1u);
  EXPECT_EQ(hit.t, 2.f);
  // Scaled by -3 the front turns from +z to -z.
  EXPECT_TRUE(rays.lookup().frontFacing(hit.spot, vec3(0, 0, 1)));
  const SurfacePoint point = rays.lookup().at(hit.spot, {0, 0, -1});
  EXPECT_NEAR(point.positionW.x, 7.5f, 1e-5f);
  EXPECT_EQ(point.normalW, vec3(0, 0, 1)) << "the side that is seen";
}

// Left half opaque, right half a hole.
scene::Texture halfHole() {
  auto image = std::make_shared<Image>(2, 1, 4, ComponentType::U8);
  std::ranges::fill(image->as<std::uint8_t>(), std::uint8_t{255});
  image->pixel<std::uint8_t>(1, 0)[3] = 0;
  scene::Texture texture;
  texture.image = image;
  texture.nearest = true;
  texture.wrapS = texture.wrapT = scene::Wrap::ClampToEdge;
  return texture;
}

TEST(RayScene, HolesOfAlphaTestLetThrough) {
  scene::Scene scene = testing::emptyScene();
  scene.textures.push_back(halfHole());
  scene::Material& material = addMaterial(scene);
  material.alphaMode = scene::AlphaMode::Mask;
  material.albedoTexture.texture = 0;
  addSquare(scene, {0, 0, -2}, {1, 0, 0}, {0, 1, 0});
  const RayScene rays(scene, mat4(1.f));
  const std::vector<Ray> both{{.originW = {-0.5f, 0, 0}}, {.originW = {0.5f, 0, 0}}};
  EXPECT_TRUE(closest(rays, both)[0].any());
  EXPECT_FALSE(closest(rays, both)[1].any());
  EXPECT_EQ(transmittance(rays, both)[0], vec3(0.f));
  EXPECT_EQ(transmittance(rays, both)[1], vec3(1.f));
}

// What alpha tests go by is the opacity that shading works out with everything else.
TEST(RayScene, OpacityIsThatOfTheSurface) {
  scene::Scene scene = testing::emptyScene();
  Random random(3);
  for (const int channels : {4, 3, 2, 1}) {
    auto image = std::make_shared<Image>(3, 2, channels, ComponentType::U8);
    for (std::uint8_t& value : image->as<std::uint8_t>())
      value = static_cast<std::uint8_t>(random.uniform(0, 255));
    scene::Texture& texture = scene.textures.emplace_back();
    texture.image = image;
    texture.wrapT = scene::Wrap::MirroredRepeat;
  }
  for (const auto combine : {scene::Combine::Modulate, scene::Combine::Decal, scene::Combine::Blend,
                             scene::Combine::Add, scene::Combine::Replace})
    for (std::uint32_t texture = 0; texture < 5; ++texture) {
      scene::Material& material = addMaterial(scene);
      material.alphaMode = scene::AlphaMode::Blend;
      material.albedo.w = 0.7f;
      material.combine = combine;
      material.albedoTexture = {.texture = texture < 4 ? texture : scene::kNoTexture,
                                .offset = {0.3f, -0.2f},
                                .scale = vec2(2.5f)};
      addSquare(scene, {0, 0, -2}, {1, 0, 0}, {0, 1, 0});
      scene.meshes.back().colors = {{255, 0, 0, 40}, {0, 0, 0, 80}, {0, 0, 0, 160}, {0, 0, 0, 255}};
    }
  const MaterialLookup lookup(scene, mat4(1.f));
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object)
    for (const vec2 at : {vec2(0.1f, 0.2f), vec2(0.6f, 0.3f), vec2(0.05f, 0.9f)}) {
      const Spot spot{.object = object, .triangle = 1, .barycentric = at};
      EXPECT_EQ(lookup.opacity(spot), lookup.at(spot, {0, 0, -1}).opacity) << object;
    }
}

// The product of what panes let through, whatever their order; nothing behind a wall.
TEST(RayScene, PanesMultiply) {
  scene::Scene scene = testing::emptyScene();
  vec3 product(1.f);
  for (int i = 0; i < 5; ++i) {
    product *= testing::addPane(scene, i);
    addSquare(scene, {0, 0, -1.f - static_cast<float>((i * 2) % 5)}, {1, 0, 0}, {0, 1, 0});
  }
  addMaterial(scene);
  addSquare(scene, {0, 0, -9}, {1, 0, 0}, {0, 1, 0});
  const RayScene rays(scene, mat4(1.f));
  // Off the diagonal, where both triangles of a square would be met.
  const auto shares = transmittance(rays, {{.originW = {0.3f, 0, 0}, .far = 8.f},
                                           {.originW = {0.3f, 0, 0}},
                                           {.originW = {0.3f, 0, 0}, .far = 0.5f}});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shares[0][c], product[c], 1e-6f);
  EXPECT_EQ(shares[1], vec3(0.f));
  EXPECT_EQ(shares[2], vec3(1.f));
}

// Backs less fronts of all that is met: boxes within boxes, which do not hide each other. What has
// two sides and what is seen through are no solids.
TEST(RayScene, CountsTheSolidsAround) {
  scene::Scene scene = testing::emptyScene();
  const auto addBox = [&](float half) {
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-half, half}) {
        vec3 n(0.f), a(0.f), b(0.f);
        n[axis] = a[(axis + 1) % 3] = side;
        b[(axis + 2) % 3] = half;
        addSquare(scene, n, a, b);
      }
  };
  addMaterial(scene).doubleSided = false;
  addBox(1.f);
  addBox(3.f);
  addMaterial(scene).doubleSided = true;
  addBox(2.f);
  testing::addPane(scene, 1);
  scene.materials.back().doubleSided = false;
  addBox(4.f);
  const RayScene rays(scene, mat4(1.f));
  std::vector<Ray> asked;
  std::vector<int> counts(4);
  for (const float x : {0.5f, 1.5f, 3.5f, -5.f})
    asked.push_back({.originW = {x, 0.1f, 0.2f}, .directionW = {1.f, 0.03f, 0.02f}});
  rays.solidsAround(asked, counts);
  EXPECT_EQ(counts, (std::vector<int>{2, 1, 0, 0}));
}

// Fronts and backs are told in the world, however the object that has them is turned.
TEST(RayScene, TurnedObjectsKeepTheirFronts) {
  for (const float scale : {1.f, -1.f}) {
    scene::Scene scene = testing::emptyScene();
    addMaterial(scene).doubleSided = false;
    addSquare(scene, {0, 0, -2}, {1, 0, 0}, {0, 1, 0});  // faces +z
    scene::Node& node = scene.nodes[scene.objects[0].node];
    node.rotation = glm::angleAxis(kPi, vec3(0, 1, 0));  // now at z = 2, and faces -z
    node.scale = {scale, 1, 1};                          // mirrored, its front stays where it is
    updateTransforms(scene);
    const RayScene rays(scene, mat4(1.f));
    const std::vector<Ray> asked{{.originW = {0.3f, 0.1f, 0}, .directionW = {0.01f, 0.02f, 1}},
                                 {.originW = {0.3f, 0.1f, 5}, .directionW = {0.01f, 0.02f, -1}}};
    std::vector<int> counts(2);
    rays.solidsAround(asked, counts);
    EXPECT_EQ(counts, (std::vector<int>{-1, 1})) << scale;
    // A pane dims the light that its front faces.
    const vec3 dimmed = testing::addPane(scene, 1);
    scene.materials[1].doubleSided = false;
    scene.objects[0].material = 1;
    const auto shares = transmittance(RayScene(scene, mat4(1.f)), asked);
    EXPECT_EQ(shares[0], vec3(1.f)) << scale;
    EXPECT_EQ(shares[1], dimmed) << scale;
  }
}

}  // namespace
}  // namespace lucerna::trace
