// Scenes with faults that are known.
#include "bake/preflight.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "bake/estimate.hpp"
#include "scene/builtin/builtin.hpp"

namespace lucerna::bake {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void addObject(scene::Scene& scene, std::uint32_t node, std::uint32_t material) {
  scene::Object& object = scene.objects.emplace_back();
  object.node = node;
  object.mesh = 0;
  object.material = material;
}

// A floor of two triangles, one of them twice and turned, a needle, and one that is no triangle.
scene::Scene oddScene() {
  scene::Scene scene;
  scene::Mesh& mesh = scene.meshes.emplace_back();
  mesh.positions = {vec3(0),        vec3(4, 0, 0),    vec3(4, 0, -4),
                    vec3(0, 0, -4), vec3(kNan, 0, 0), vec3(2, 0, 0)};
  mesh.indices = {0, 1, 2, 0, 2, 3, 3, 0, 2, 0, 1, 5, 0, 1, 4};
  scene.materials.emplace_back();
  scene.materials.emplace_back().model = scene::MaterialModel::Unlit;
  scene::addNode(scene, "floor", mat4(1.f));
  addObject(scene, 0, 0);
  scene::updateTransforms(scene);
  return scene;
}

Preflight inspected(const scene::Scene& scene) {
  const auto plan = makePlan(scene, {});
  EXPECT_TRUE(plan) << plan.error().message;
  return inspect(*plan);
}

TEST(Preflight, CountsOddTriangles) {
  const Preflight found = inspected(oddScene());
  EXPECT_EQ(found.duplicate, 1u);
  EXPECT_EQ(found.degenerate, 1u);
  EXPECT_EQ(found.notFinite, 1u);
  EXPECT_EQ(found.moving + found.bending + found.unlit + found.lights, 0u);
}

TEST(Preflight, CountsWhatMovesAndIsUnlit) {
  scene::Scene scene = oddScene();
  scene.nodes[scene::addNode(scene, "child", mat4(1.f))].parent = 0;
  addObject(scene, 1, 1);
  scene::AnimationChannel turn;
  turn.node = 0;
  scene.animations.push_back({.name = "turn", .channels = {turn}});
  scene::updateTransforms(scene);
  Preflight found = inspected(scene);
  EXPECT_EQ(found.moving, 2u);  // the child moves with its parent
  EXPECT_EQ(found.unlit, 1u);
  scene.animations[0].playing = false;
  EXPECT_EQ(inspected(scene).moving, 0u);
}

TEST(Preflight, NamesWhatIsHuge) {
  scene::Scene scene = oddScene();
  scene.meshes[0].positions.push_back(vec3(2, 1e30f, 0));
  scene.meshes[0].indices.insert(scene.meshes[0].indices.end(), {0, 1, 6, 1, 4, 6});
  const auto plan = makePlan(scene, {});
  ASSERT_TRUE(plan);
  const Preflight found = inspect(*plan);
  EXPECT_EQ(found.huge, 2u);
  EXPECT_EQ(found.notFinite, 1u);
  EXPECT_THAT(plan->warnings, ::testing::Contains(HasSubstr("2 triangles are too large")));
  EXPECT_THAT(
      plan->warnings,
      ::testing::Contains("1 triangles have corners that are no numbers: they are left out"));
  EXPECT_THAT(plan->warnings, ::testing::Contains("1 triangles have no area and get no light"));
  EXPECT_THAT(inspected(oddScene()).huge, 0u);
}

// A closed box, fronts outwards, and the same with fronts inwards: a room.
scene::Scene boxScene(bool room) {
  scene::Scene scene = oddScene();
  scene::Mesh& mesh = scene.meshes[0];
  mesh.positions.clear();
  for (const float z : {-1.f, 1.f})
    for (const float y : {-1.f, 1.f})
      for (const float x : {-1.f, 1.f}) mesh.positions.emplace_back(x, y, z);
  mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  if (room)
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      std::swap(mesh.indices[i], mesh.indices[i + 1]);
  for (const vec3 at : {vec3(0.1f, 0.2f, 0.f), vec3(0, 3, 0)}) {
    const std::uint32_t node = scene::addNode(scene, "lamp", glm::translate(mat4(1.f), at));
    scene::Light& light = scene.lights.emplace_back();
    light.name = at.y < 1.f ? "inside" : "outside";
    light.kind = scene::LightKind::Point;
    light.node = node;
  }
  scene::updateTransforms(scene);
  return scene;
}

TEST(Preflight, FindsLightsInSolidsOnly) {
  EXPECT_THAT(inspected(boxScene(false)).buried, ElementsAre("inside"));
  EXPECT_THAT(inspected(boxScene(true)).buried, ElementsAre());
  scene::Scene mirrored = boxScene(false);
  mirrored.nodes[0].scale = vec3(-1, 1, 1);
  scene::updateTransforms(mirrored);
  EXPECT_THAT(inspected(mirrored).buried, ElementsAre("inside"));
}

// A bulb in a globe of glass shines out; in one of glass within a closed box it does not. Nor does
// what is open to one side hold a lamp.
TEST(Preflight, GlassAndHousingsAreNoSolids) {
  scene::Scene globe = boxScene(false);
  globe.materials[0].alphaMode = scene::AlphaMode::Blend;
  EXPECT_THAT(inspected(globe).buried, ElementsAre());
  scene::Scene both = globe;
  both.materials.emplace_back();
  scene::addNode(both, "box", glm::scale(mat4(1.f), vec3(2.f)));
  addObject(both, static_cast<std::uint32_t>(both.nodes.size() - 1), 2);
  scene::updateTransforms(both);
  EXPECT_THAT(inspected(both).buried, ElementsAre("inside"));
  for (std::size_t face = 0; face < 6; ++face) {
    scene::Scene housing = boxScene(false);
    std::vector<std::uint32_t>& indices = housing.meshes[0].indices;
    const auto first = indices.begin() + static_cast<std::ptrdiff_t>(6 * face);
    indices.erase(first, first + 6);
    EXPECT_THAT(inspected(housing).buried, ElementsAre()) << face;
  }
}

TEST(Estimate, OfAllUnitsIsOfTheWholeBake) {
  const auto scene = scene::makeBuiltin("builtin:cornell");
  ASSERT_TRUE(scene);
  BakeSettings settings;
  settings.density = 40.f;
  const auto plan = makePlan(*scene, settings);
  ASSERT_TRUE(plan);
  const auto all = estimate(*plan, 1e9);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->units, plan->units.size());
  EXPECT_EQ(all->deviation, 0.);
  EXPECT_GT(all->lightSeconds, 0.);
  const auto little = estimate(*plan, 0.);
  ASSERT_TRUE(little);
  EXPECT_GE(little->units, 1u);
}

}  // namespace
}  // namespace lucerna::bake
