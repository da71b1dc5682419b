// The dark side stays dark: rooms, walls and boxes that no light enters, on maps as they are
// stored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake/assemble.hpp"
#include "bake/seams.hpp"
#include "bake/unit_light.hpp"
#include "image/bc6h.hpp"
#include "image/rgb9e5.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::bake {
namespace {

using trace::testing::addLight;
using trace::testing::addMaterial;
using trace::testing::addSquare;
using trace::testing::emptyScene;

// A texel's brightness as a white surface shows it.
constexpr float kLeak = 1.f / 255.f;
constexpr float kStep = 0.25f;  // m, a texel

// One-sided, its front outwards, or inwards for a room. Not on the texels' grid.
void addBox(scene::Scene& scene, vec3 low, vec3 high, bool inwards = false) {
  const vec3 centre = 0.5f * (low + high), half = 0.5f * (high - low);
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      vec3 n(0.f), a(0.f), b(0.f);
      n[axis] = side * half[axis];
      a[(axis + 1) % 3] = half[(axis + 1) % 3];
      b[(axis + 2) % 3] = half[(axis + 2) % 3] * side * (inwards ? -1.f : 1.f);
      addSquare(scene, centre + n, a, b);
    }
}

scene::Scene scene() {
  scene::Scene made = emptyScene();
  addMaterial(made).doubleSided = false;
  return made;
}

scene::Light& addLamp(scene::Scene& scene, vec3 at) {
  scene::Light& lamp = addLight(scene, scene::LightKind::Point, at, {0, -1, 0});
  lamp.intensity = 40.f;
  return lamp;
}

// What the maps show at a place of the surface, filtered as the renderer does, in the encodings
// that show least and most; and where it lies.
struct Shown {
  vec3 positionW, normalW;
  float least = 1e9f, most = 0.f;
};

std::vector<Image> encodings(const Image& map) {
  Image rgb9e5(map.width(), map.height(), 3, ComponentType::F32);
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const std::uint16_t* p = map.pixel<std::uint16_t>(x, y);
      const vec3 c =
          fromRgb9e5(toRgb9e5({floatFromHalf(p[0]), floatFromHalf(p[1]), floatFromHalf(p[2])}));
      for (int i = 0; i < 3; ++i) rgb9e5.pixel<float>(x, y)[i] = c[i];
    }
  return {converted(map, ComponentType::F32, 3), rgb9e5,
          decodeBc6h(encodeBc6h(map), map.width(), map.height())};
}

vec3 lookup(const Image& map, vec2 p) {
  const vec2 at = glm::clamp(p - 0.5f, vec2(0.f), vec2(map.width(), map.height()) - 1.f);
  const ivec2 first = glm::min(ivec2(at), ivec2(map.width(), map.height()) - 2);
  const vec2 share = at - vec2(first);
  const auto texel = [&](int x, int y) {
    const float* c = map.pixel<float>(first.x + x, first.y + y);
    return vec3(c[0], c[1], c[2]);
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x),
                  glm::mix(texel(0, 1), texel(1, 1), share.x), share.y);
}

// Looks everywhere: at a fine grid of places on every triangle, in every encoding.
std::vector<Shown> bake(const scene::Scene& scene, int positions) {
  BakeSettings settings;
  settings.density = 1.f / kStep;
  settings.pack.side = 256;
  settings.sampling.positions = positions;
  Result<Plan> made = makePlan(scene, settings);
  EXPECT_TRUE(made) << made.error().message;
  const Plan& plan = *made;
  const LightScene lightScene(plan);
  UnitLighter lighter(plan, lightScene);
  BakedLight baked = emptyLight(plan);
  for (const Unit& unit : plan.units) putInMaps(baked, plan, unit, lighter.light(unit));
  dilate(baked);
  closeSeams(plan, baked);
  std::vector<std::vector<Image>> maps;
  for (const Image& map : baked.maps) maps.push_back(encodings(map));
  const lightmap::Layout layout = layoutOf(plan);
  std::vector<Shown> shown;
  for (std::size_t o = 0; o < plan.world.objects.size(); ++o) {
    const WorldObject& object = plan.world.objects[o];
    for (std::uint32_t t = 0; t < object.triangleCount; ++t) {
      const lightmap::TrianglePlace& place = layout.objects[object.object][t];
      const std::uint32_t* corners = &plan.world.indices[3 * (object.firstTriangle + t)];
      constexpr int kGrid = 61;
      for (int i = 0; i <= kGrid; ++i)
        for (int j = 0; i + j <= kGrid; ++j) {
          const float u = static_cast<float>(i) / kGrid, v = static_cast<float>(j) / kGrid;
          const auto at = [&](const auto& a, const auto& b, const auto& c) {
            return a * (1.f - u - v) + b * u + c * v;
          };
          Shown s;
          s.positionW = at(plan.world.positions[corners[0]], plan.world.positions[corners[1]],
                           plan.world.positions[corners[2]]);
          s.normalW = plan.world.normals[corners[0]];
          const vec2 p = at(place.corners[0], place.corners[1], place.corners[2]);
          for (const Image& map : maps[static_cast<std::size_t>(place.map)]) {
            const vec3 c = lookup(map, p) / kPi;
            const float brightness = std::max({c.x, c.y, c.z});
            s.least = std::min(s.least, brightness);
            s.most = std::max(s.most, brightness);
          }
          shown.push_back(s);
        }
    }
  }
  return shown;
}

// The brightest of the places that `dark` says no light reaches, and the brightest of all.
struct Brightest {
  float dark = 0.f, all = 0.f;
};
template <typename Dark>
Brightest brightest(const std::vector<Shown>& shown, const Dark& dark) {
  Brightest result;
  for (const Shown& s : shown) {
    result.all = std::max(result.all, s.most);
    if (dark(s)) result.dark = std::max(result.dark, s.most);
  }
  return result;
}

class Leaks : public ::testing::TestWithParam<int> {  // positions along a texel's side
 protected:
  // A wall over the floor that is there, with a lamp on one side: the other is dark.
  static void expectDarkBehindAThinWall(scene::Scene& s) {
    addBox(s, {0.31f, -0.5f, -4.5f}, {0.36f, 8.f, 4.5f});
    addLamp(s, {-1.f, 1.f, 0.f});
    const Brightest found = brightest(bake(s, GetParam()), [](const Shown& p) {
      return p.positionW.x > 0.375f && p.positionW.y >= 0.f;
    });
    EXPECT_GT(found.all, 1.f);
    EXPECT_LE(found.dark, kLeak);
  }
};

// A floor that goes on below the walls of a closed room with a lamp in it; walls as thick as two
// texels.
TEST_P(Leaks, AClosedRoomKeepsItsLight) {
  scene::Scene s = scene();
  addSquare(s, {0, 0, 0}, {0, 0, 5}, {5, 0, 0});
  addBox(s, {-1.63f, -0.2f, -1.71f}, {1.57f, 2.33f, 1.69f});        // outside
  addBox(s, {-1.13f, -0.1f, -1.21f}, {1.07f, 1.83f, 1.19f}, true);  // inside
  addLamp(s, {0.1f, 1.2f, 0.2f});
  const Brightest found = brightest(bake(s, GetParam()), [](const Shown& p) {
    return std::abs(p.positionW.x) > 1.6f || std::abs(p.positionW.z) > 1.65f ||
           p.positionW.y > 1.9f;
  });
  EXPECT_GT(found.all, 1.f);
  EXPECT_LE(found.dark, kLeak);
}

// A wall thinner than a texel, and a lamp on one side of it: the floor below goes through. The
// texel that the wall divides belongs to the side on which its middle is, so that light filters
// through up to there and no farther.
TEST_P(Leaks, AThinWall) {
  scene::Scene s = scene();
  addSquare(s, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
  expectDarkBehindAThinWall(s);
}

// The same where the floor is of two objects that meet below the wall: what is lit and what is dark
// are of one surface, but for a seam.
TEST_P(Leaks, AThinWallOnASeam) {
  scene::Scene s = scene();
  for (const float side : {-1.f, 1.f})
    addSquare(s, {0.335f + side * 2.f, 0, 0}, {0, 0, 4}, {2, 0, 0});
  expectDarkBehindAThinWall(s);
}

// Two rooms in one corner, divided by a wall; the lamp is in the other.
TEST_P(Leaks, ALampBehindAWall) {
  scene::Scene s = scene();
  addBox(s, {-3, 0, -3}, {3, 3, 3}, true);
  addBox(s, {-0.52f, -0.5f, -3.5f}, {0.18f, 3.5f, 3.5f});
  addLamp(s, {-1.5f, 1.5f, 0.f});
  const Brightest found =
      brightest(bake(s, GetParam()), [](const Shown& p) { return p.positionW.x > 0.185f; });
  EXPECT_GT(found.all, 1.f);
  EXPECT_LE(found.dark, kLeak);
}

// The darkest of what faces up and is in none of the boxes.
struct Box {
  vec3 low, high;
  bool covers(vec3 p) const {
    return p.y < high.y - 1e-3f && p.x > low.x && p.x < high.x && p.z > low.z && p.z < high.z;
  }
};
float darkestSeen(const std::vector<Shown>& shown, const std::vector<Box>& boxes) {
  float darkest = 1e9f;
  std::size_t seen = 0;
  for (const Shown& p : shown) {
    if (p.normalW.y < 0.9f ||
        std::ranges::any_of(boxes, [&](const Box& box) { return box.covers(p.positionW); }))
      continue;
    darkest = std::min(darkest, p.least);
    ++seen;
  }
  EXPECT_GT(seen, 1000u);
  return darkest;
}

void addSun(scene::Scene& scene) {
  addLight(scene, scene::LightKind::Directional, {0, 9, 0}, {0, -1, 0}).intensity = kPi;
}

// Boxes that go through each other on a floor, lit straight from above, so that whatever faces up
// and is seen is lit alike, right to where another box stands on it.
TEST_P(Leaks, BoxesThatIntersectHaveNoDarkEdges) {
  scene::Scene s = scene();
  addSquare(s, {0, 0, 0}, {0, 0, 5}, {5, 0, 0});
  const std::vector<Box> boxes{{{-1.07f, -0.3f, -1.1f}, {0.93f, 1.04f, 0.87f}},
                               {{-0.33f, -0.2f, -0.41f}, {1.88f, 0.59f, 1.43f}}};
  for (const Box& box : boxes) addBox(s, box.low, box.high);
  addSun(s);
  EXPECT_GT(darkestSeen(bake(s, GetParam()), boxes), 0.99f);
}

// A wall that goes into a box, both through an open sheet of floor, lit straight from the side. The
// front of the floor is below what is inside of the box.
TEST_P(Leaks, AWallThatEndsInABoxOnASheetHasNoDarkEdge) {
  scene::Scene s = scene();
  addSquare(s, {0, 0, 0}, {0, 0, 5}, {5, 0, 0});
  const Box box{{-1.07f, -0.3f, -1.1f}, {0.93f, 2.04f, 0.87f}};
  addBox(s, box.low, box.high);
  addBox(s, {0.1f, -0.4f, -0.3f}, {3.3f, 1.37f, 0.2f});
  addLight(s, scene::LightKind::Directional, {0, 0, 9}, {0, 0, -1}).intensity = kPi;
  float darkest = 1e9f;
  for (const Shown& p : bake(s, GetParam()))
    if (p.normalW.z > 0.9f && p.positionW.y > 0.f && p.positionW.x > 1e-3f + box.high.x)
      darkest = std::min(darkest, p.least);
  EXPECT_GT(darkest, 0.99f);
  EXPECT_LT(darkest, 1.01f);
}

// All squares of the scene as one mesh. own: with a second set of coordinates, in which the first
// square has the left and the others, one above the other, the right.
void makeOneMesh(scene::Scene& scene, bool own) {
  constexpr float kScale = 1.f / 32.f;  // of a metre
  scene::Mesh mesh;
  float top = 0.f;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const scene::Mesh& square = scene.meshes[i];
    const vec2 size(glm::distance(square.positions[0], square.positions[1]),
                    glm::distance(square.positions[0], square.positions[3]));
    const vec2 at = i == 0 ? vec2(0.f) : vec2(7.f, top);
    if (i > 0) top += size.y + 1.f;
    for (const std::uint32_t k : square.indices)
      mesh.indices.push_back(k + static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.insert(mesh.positions.end(), square.positions.begin(), square.positions.end());
    mesh.normals.insert(mesh.normals.end(), square.normals.begin(), square.normals.end());
    for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)})
      if (own) mesh.texCoords[1].push_back(kScale * (at + corner * size));
  }
  for (const vec3& p : mesh.positions) mesh.bounds.grow(p);
  scene.meshes = {mesh};
  scene.objects.resize(1);
}

// A floor and a box in it are one mesh.
TEST_P(Leaks, ABoxOfTheFloorsOwnMeshHasNoDarkEdges) {
  const Box box{{-0.33f, -0.2f, -0.41f}, {1.88f, 0.59f, 1.43f}};
  for (const bool own : {false, true}) {
    scene::Scene s = scene();
    addSquare(s, {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
    addBox(s, box.low, box.high);
    makeOneMesh(s, own);
    addSun(s);
    EXPECT_GT(darkestSeen(bake(s, GetParam()), {box}), 0.99f) << own;
  }
}

INSTANTIATE_TEST_SUITE_P(Positions, Leaks, ::testing::Values(1, 4));

}  // namespace
}  // namespace lucerna::bake
