#include "passes/mirrors/plan_reflections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "core/random.hpp"
#include "passes/mirrors/mirror_faces.hpp"

namespace lucerna::passes {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

// A grid of squares in the plane z = 0, of side 1 together, that faces +z.
scene::Mesh sheet(int squares = 1) {
  scene::Mesh mesh;
  for (int y = 0; y <= squares; ++y)
    for (int x = 0; x <= squares; ++x) {
      mesh.positions.emplace_back(vec2(x, y) / static_cast<float>(squares) - 0.5f, 0.f);
      mesh.bounds.grow(mesh.positions.back());
    }
  const auto row = static_cast<std::uint32_t>(squares) + 1;
  for (std::uint32_t y = 0; y + 1 < row; ++y)
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x, b = a + 1, c = b + row, d = a + row;
      for (const std::uint32_t i : {a, b, c, a, c, d}) mesh.indices.push_back(i);
    }
  return mesh;
}

// Turns +z into a direction.
mat4 turned(vec3 direction) {
  const vec3 up = std::abs(direction.y) > 0.9f ? vec3(0, 0, 1) : vec3(0, 1, 0);
  return glm::inverse(glm::lookAt(vec3(0), -direction, up));
}

// Six sheets that face away from the middle.
scene::Mesh box() {
  scene::Mesh mesh;
  const scene::Mesh side = sheet();
  for (const vec3 axis : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0),
                          vec3(0, 0, 1), vec3(0, 0, -1)}) {
    const mat4 turn = turned(axis);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const vec3& p : side.positions) {
      mesh.positions.push_back(vec3(turn * vec4(p + vec3(0, 0, 0.5f), 1.f)));
      mesh.bounds.grow(mesh.positions.back());
    }
    for (const std::uint32_t i : side.indices) mesh.indices.push_back(first + i);
  }
  return mesh;
}

TEST(MirrorFaces, OfASheetIsOneOfABoxAreSix) {
  for (const int squares : {1, 20}) {
    const auto faces = facesOf(sheet(squares), mat4(1.f));
    ASSERT_TRUE(faces && faces->size() == 1) << squares;
    EXPECT_LT(glm::distance((*faces)[0].planeW, vec4(0, 0, 1, 0)), 1e-6f);
    for (const vec3& corner : (*faces)[0].cornersW)
      EXPECT_LT(glm::distance(glm::abs(corner), vec3(0.5f, 0.5f, 0)), 1e-6f);
  }
  const auto faces = facesOf(box(), mat4(1.f));
  ASSERT_TRUE(faces);
  EXPECT_THAT(*faces, SizeIs(6));
  for (const MirrorFace& face : *faces) EXPECT_FLOAT_EQ(face.planeW.w, -0.5f) << "outwards";
}

// However they are placed: turned, sheared, flat as a pane, mirrored.
TEST(MirrorFaces, ArePlacedWithTheirObject) {
  mat4 place =
      glm::rotate(glm::translate(mat4(1.f), vec3(5, -2, 9)), 0.7f, glm::normalize(vec3(1, 2, 3)));
  place = place * glm::scale(mat4(1.f), vec3(3, -1, 0.002f));
  place[1] += 0.3f * place[0];
  const auto faces = facesOf(box(), place);
  ASSERT_TRUE(faces);
  ASSERT_THAT(*faces, SizeIs(6));
  const vec4 middle = place[3];
  for (const MirrorFace& face : *faces) {
    EXPECT_NEAR(glm::length(vec3(face.planeW)), 1.f, 1e-5f);
    EXPECT_LT(glm::dot(face.planeW, middle), 0.f) << "the front is outside";
    for (const vec3& corner : face.cornersW)
      EXPECT_NEAR(glm::dot(face.planeW, vec4(corner, 1.f)), 0.f, 1e-4f);
  }
}

TEST(MirrorFaces, MayBeUnevenByLittle) {
  scene::Mesh mesh = sheet(10);
  Random random(2);
  for (vec3& p : mesh.positions) p.z = random.uniform(-1e-5f, 1e-5f);
  // A needle, whose normal says nothing.
  mesh.positions.emplace_back(0.5f, -0.5f, 0.f);
  mesh.positions.emplace_back(0.5f, 0.f, 1e-5f);
  mesh.positions.emplace_back(0.5f, 0.5f, 0.f);
  for (const std::uint32_t back : {3u, 2u, 1u})
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()) - back);
  const auto faces = facesOf(mesh, glm::scale(mat4(1.f), vec3(1, 1, 10)));
  ASSERT_TRUE(faces);
  ASSERT_THAT(*faces, SizeIs(1));
  EXPECT_NEAR((*faces)[0].unevenness, 1e-4f, 3e-5f);
}

TEST(MirrorFaces, OfACurvedMeshAreNone) {
  scene::Mesh mesh = sheet(30);
  for (vec3& p : mesh.positions) p.z = 0.3f * std::sin(5 * p.x);
  EXPECT_FALSE(facesOf(mesh, mat4(1.f)));
}

constexpr uvec2 kSize{100, 100};

// A camera at the origin that looks along -z with a right angle of view, before sheets.
class Plan : public ::testing::Test {
 protected:
  Plan() {
    scene_.meshes = {sheet(), box()};
    scene_.materials.resize(3);
    scene_.materials[kMirror].reflectivity = 1.f;
    scene_.materials[kTwoSided].reflectivity = 1.f;
    scene_.materials[kTwoSided].doubleSided = true;
    view_.size = kSize;
    view_.window.size = kSize;
    view_.view.clipFromView = perspectiveReversed(kPi / 2, 1.f, 0.1f, 100.f);
  }
  static constexpr std::uint32_t kMirror = 0, kTwoSided = 1, kOther = 2;

  std::uint32_t add(std::uint32_t mesh, std::uint32_t material, const mat4& place) {
    const std::uint32_t node = addNode(scene_, "object", place);
    scene_.objects.push_back({.node = node, .mesh = mesh, .material = material, .boundsW = {}});
    return static_cast<std::uint32_t>(scene_.objects.size() - 1);
  }
  // A sheet of a side that looks towards `direction`.
  std::uint32_t addSheet(vec3 at, vec3 direction, float side, std::uint32_t material = kMirror) {
    const mat4 place = glm::translate(mat4(1.f), at) * turned(direction);
    return add(0, material, glm::scale(place, vec3(side)));
  }
  std::uint32_t addBox(vec3 at, float side = 0.2f) {
    return add(1, kOther, glm::scale(glm::translate(mat4(1.f), at), vec3(side)));
  }

  // Six mirrors around the camera.
  void addRoom() {
    for (const vec3 axis : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0),
                            vec3(0, 0, 1), vec3(0, 0, -1)})
      addSheet(-2.f * axis, axis, 4.f);
  }

  ReflectionPlan plan(int depth = 1, bool backFaces = false, std::size_t budget = 1000) {
    updateTransforms(scene_);
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> mirrors;
    for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
      boxes.push_back(scene_.objects[i].boundsW);
      if (isMirror(scene_.materials[scene_.objects[i].material])) mirrors.push_back(i);
    }
    gpuScene_.scene = &scene_;
    gpuScene_.bvh.build(boxes);
    return planReflections(gpuScene_, view_, mirrors,
                           {.depth = depth, .backFaces = backFaces, .budget = budget});
  }

  scene::Scene scene_;
  render::GpuScene gpuScene_;
  render::ViewData view_;
};

TEST_F(Plan, FitsTheMirrorOnTheScreen) {
  addSheet({0, 0, -4}, {0, 0, 1}, 4.f);
  const auto reflections = plan().reflections;
  ASSERT_THAT(reflections, SizeIs(1));
  const render::Window& part = reflections[0].part;  // half the picture, and a pixel around
  EXPECT_EQ(part.origin, ivec2(24));
  EXPECT_EQ(part.size, uvec2(52));
  EXPECT_LT(glm::distance(reflections[0].planeW, vec4(0, 0, 1, 4)), 1e-6f);
  EXPECT_TRUE(reflections[0].view.mirrored());
}

TEST_F(Plan, SeesInTheMirrorWhatTheMirrorCanShow) {
  addSheet({0, 0, -4}, {0, 0, 1}, 4.f);
  const std::uint32_t before = addBox({0, 0, -3}), far = addBox({3, -3, 6});
  addBox({0, 0, -5});  // behind the mirror
  addBox({4, 0, -2});  // beside what it shows
  addBox({-7.6f, 0, 6});
  EXPECT_THAT(plan().reflections[0].visible, UnorderedElementsAre(before, far));
}

TEST_F(Plan, SharesAPictureAmongMirrorsOfOnePlane) {
  const vec3 normal = glm::normalize(vec3(0.2f, 0.4f, 1.f));
  const vec3 right = glm::normalize(glm::cross(vec3(0, 1, 0), normal));
  std::vector<std::uint32_t> tiles;
  for (int i = -5; i <= 5; ++i)
    tiles.push_back(addSheet(vec3(0, 0, -8) + 0.5f * static_cast<float>(i) * right, normal, 0.4f));
  const std::uint32_t other = addSheet({0, 0, -8.1f}, normal, 0.4f);
  const auto reflections = plan().reflections;
  ASSERT_THAT(reflections, SizeIs(2));
  EXPECT_EQ(reflections[0].mirrors, tiles);
  EXPECT_THAT(reflections[1].mirrors, ElementsAre(other));
  EXPECT_LT(reflections[0].clearance, 1e-3f);
}

TEST_F(Plan, LeavesOutMirrorsThatTheWindowDoesNotShow) {
  addSheet({-2, 0, -4}, {0, 0, 1}, 1.f);  // 12 to 38 px from the left
  addSheet({0, 0, 4}, {0, 0, 1}, 1.f);    // behind the camera
  addSheet({9, 0, -4}, {0, 0, 1}, 1.f);   // beside the picture
  EXPECT_THAT(plan().reflections, SizeIs(1));
  view_.window = {.origin = {50, 0}, .size = {50, 100}};
  EXPECT_THAT(plan().reflections, IsEmpty());
  view_.window = {.origin = {20, 45}, .size = {10, 10}};
  const auto reflections = plan().reflections;
  ASSERT_THAT(reflections, SizeIs(1));
  EXPECT_EQ(reflections[0].part.origin, ivec2(20, 45));
  EXPECT_EQ(reflections[0].part.size, uvec2(10));
}

TEST_F(Plan, TurnsThePlaneTowardsTheEye) {
  addSheet({0, 0, -4}, {0, 0, -1}, 1.f);
  EXPECT_THAT(plan().reflections, IsEmpty()) << "its back";
  EXPECT_THAT(plan(1, true).reflections, SizeIs(1));
  addSheet({0, 0, -3}, {0, 0, -1}, 1.f, kTwoSided);
  const auto reflections = plan().reflections;
  ASSERT_THAT(reflections, SizeIs(1));
  EXPECT_LT(glm::distance(reflections[0].planeW, vec4(0, 0, 1, 3)), 1e-6f);
}

// Two mirrors face each other: each shows the other, which is all that there is.
TEST_F(Plan, FollowsMirrorsInMirrorsToTheDepth) {
  addSheet({0, 0, -4}, {0, 0, 1}, 4.f);
  addSheet({0, 0, 4}, {0, 0, -1}, 4.f);
  for (const int depth : {1, 2, 5}) {
    std::vector<Reflection> reflections = plan(depth).reflections;
    int found = 0;
    std::uint32_t width = kSize.x;
    bool mirrored = false;
    while (!reflections.empty()) {
      ASSERT_THAT(reflections, SizeIs(1));
      EXPECT_LE(reflections[0].part.size.x, width);
      width = reflections[0].part.size.x;
      mirrored = !mirrored;
      EXPECT_EQ(reflections[0].view.mirrored(), mirrored);
      EXPECT_THAT(reflections[0].mirrors, ElementsAre(found % 2));
      ++found;
      std::vector<Reflection> within = std::move(reflections[0].within);
      reflections = std::move(within);
    }
    EXPECT_EQ(found, depth);
  }
}

// px of all pictures.
std::vector<std::size_t> areasOf(const std::vector<Reflection>& reflections) {
  std::vector<std::size_t> areas;
  for (const Reflection& reflection : reflections) {
    areas.push_back(std::size_t(reflection.part.size.x) * reflection.part.size.y);
    std::ranges::copy(areasOf(reflection.within), std::back_inserter(areas));
  }
  std::ranges::sort(areas, std::greater());
  return areas;
}

TEST_F(Plan, KeepsTheLargestPicturesOfABudget) {
  addRoom();
  const ReflectionPlan whole = plan(4);
  EXPECT_EQ(whole.beyondBudget, 0);
  const std::vector<std::size_t> areas = areasOf(whole.reflections);
  ASSERT_GT(areas.size(), 30);
  for (const std::size_t budget : {1, 20, 30}) {
    const ReflectionPlan part = plan(4, false, budget);
    EXPECT_EQ(areasOf(part.reflections),
              std::vector(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(budget)));
    EXPECT_GT(part.beyondBudget, 0);
  }
  EXPECT_EQ(plan(4, false, areas.size()).beyondBudget, 0);
  EXPECT_EQ(plan(4, false, areas.size() - 1).beyondBudget, 1);
  const ReflectionPlan deep = plan(16, false, 200);
  EXPECT_THAT(areasOf(deep.reflections), SizeIs(200));
}

void addPlanes(const std::vector<Reflection>& reflections, std::set<std::vector<float>>& planes) {
  for (const Reflection& reflection : reflections) {
    const vec4& p = reflection.planeW;
    planes.insert({p.x, p.y, p.z, p.w});
    addPlanes(reflection.within, planes);
  }
}

// Windows show what the whole picture shows, beyond the budget, too.
TEST_F(Plan, LeavesOutTheSameInAllWindows) {
  addRoom();
  std::set<std::vector<float>> whole, parts;
  addPlanes(plan(4, false, 20).reflections, whole);
  for (const int x : {0, 50})
    for (const int y : {0, 50}) {
      view_.window = {.origin = {x, y}, .size = {50, 50}};
      addPlanes(plan(4, false, 20).reflections, parts);
    }
  EXPECT_EQ(parts, whole);
}

TEST_F(Plan, NamesCurvedMirrors) {
  for (vec3& p : scene_.meshes.emplace_back(sheet(30)).positions) p.z = 0.3f * std::sin(5 * p.x);
  const std::uint32_t curved = add(2, kMirror, glm::translate(mat4(1.f), vec3(0, 0, -4)));
  const ReflectionPlan found = plan(3);
  EXPECT_THAT(found.reflections, IsEmpty());
  EXPECT_THAT(found.curved, ElementsAre(curved));
}

}  // namespace
}  // namespace lucerna::passes
