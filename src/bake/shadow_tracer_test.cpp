// The same scenes for all engines, whose answers are known in closed form.
#include "bake/shadow_tracer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::bake {
namespace {

using trace::testing::addMaterial;
using trace::testing::addSquare;
using trace::testing::emptyScene;

struct Engine {
  const char* name;
  std::unique_ptr<ShadowTracer> (*make)(const World& world);
  // One in how many rays slips through where it is aimed at an edge or a corner. 0: none.
  std::size_t slips = 0;
};
const Engine kEngines[] = {
    {"Embree", makeEmbreeTracer, 1000},
    {"Octree", [](const World& world) { return makeOctreeTracer(world); }},
    {"OctreeOfSmallLeaves",
     [](const World& world) { return makeOctreeTracer(world, {.leafSize = 1}); }},
    {"OctreeWithoutMailboxes",
     [](const World& world) {
       return makeOctreeTracer(world, {.leafSize = 1, .mailboxes = false});
     }},
};

struct Segment {
  vec3 from, to;
};

ShadowRays raysOf(const std::vector<Segment>& segments) {
  ShadowRays rays;
  rays.resize(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto& [from, to] = segments[i];
    rays.fromX[i] = from.x, rays.fromY[i] = from.y, rays.fromZ[i] = from.z;
    rays.toX[i] = to.x, rays.toY[i] = to.y, rays.toZ[i] = to.z;
  }
  return rays;
}

class ShadowTracers : public testing::TestWithParam<Engine> {
 protected:
  std::vector<vec3> trace(const scene::Scene& scene, const std::vector<Segment>& segments) const {
    const World world = makeWorld(scene);
    return trace(*GetParam().make(world), segments);
  }
  static std::vector<vec3> trace(const ShadowTracer& tracer, const std::vector<Segment>& segments) {
    std::vector<vec3> shares(segments.size(), vec3(-1.f));
    tracer.trace(raysOf(segments), shares);
    return shares;
  }
};

INSTANTIATE_TEST_SUITE_P(Engines, ShadowTracers, testing::ValuesIn(kEngines),
                         [](const auto& tested) { return std::string(tested.param.name); });

const vec3 kAll(1.f), kNothing(0.f);

vec3 someVec(Random& random, float reach) {
  const float x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
  return {x, y, random.uniform(-reach, reach)};
}

void addTriangles(scene::Scene& scene, const std::vector<vec3>& corners) {
  addSquare(scene, vec3(0), {1, 0, 0}, {0, 1, 0});
  scene::Mesh& mesh = scene.meshes.back();
  mesh = {};
  mesh.positions = corners;
  mesh.indices.resize(corners.size());
  std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
}

TEST_P(ShadowTracers, WithoutTrianglesNothingIsInTheWay) {
  const auto shares = trace(emptyScene(), {{vec3(0), vec3(1)}, {vec3(0), vec3(0)}});
  EXPECT_EQ(shares, (std::vector<vec3>{kAll, kAll}));
  EXPECT_TRUE(trace(emptyScene(), {}).empty());
}

TEST_P(ShadowTracers, OneTriangle) {
  scene::Scene scene = emptyScene();
  addMaterial(scene);
  addTriangles(scene, {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  const auto shares = trace(scene, {{{0.5f, 0.5f, 1}, {0.5f, 0.5f, -1}},
                                    {{0.5f, 0.5f, -1}, {0.5f, 0.5f, 1}},
                                    {{1.5f, 1.5f, 1}, {1.5f, 1.5f, -1}},
                                    {{0.5f, 0.5f, 1}, {0.5f, 0.5f, 0.01f}},
                                    {{0.5f, 0.5f, -0.01f}, {0.5f, 0.5f, -1}},
                                    {{9, 0.25f, 4}, {-8, 0.25f, -4}},
                                    {{-1, 1, 0.5f}, {3, 1, 0.5f}}});
  EXPECT_EQ(shares, (std::vector<vec3>{kNothing, kNothing, kAll, kAll, kAll, kNothing, kAll}));
}

// A lamp's own surface.
TEST_P(ShadowTracers, WhatIsAtTheLightIsNotInTheWay) {
  scene::Scene scene = emptyScene();
  addMaterial(scene);
  addSquare(scene, vec3(0), {1, 0, 0}, {0, 1, 0});
  const float near = 8.f * kClearOfLight;  // of a segment of 8 m
  const auto shares = trace(scene, {{{0.3f, 0.1f, 0}, {0.3f, 0.1f, 8}},
                                    {{0.3f, 0.1f, -0.9f * near}, {0.3f, 0.1f, 8 - 0.9f * near}},
                                    {{0.3f, 0.1f, -1.1f * near}, {0.3f, 0.1f, 8 - 1.1f * near}}});
  EXPECT_EQ(shares, (std::vector<vec3>{kAll, kAll, kNothing}));
}

// Small squares around the origin, but for a tube along each axis: they make an octree deep.
void addClutter(scene::Scene& scene) {
  Random random(7);
  for (int i = 0; i < 60;) {
    const vec3 at = someVec(random, 3.f);
    const vec3 square = at * at;
    if (std::min({square.x + square.y, square.y + square.z, square.z + square.x}) < 0.5f) continue;
    addSquare(scene, at, {0.1f, 0.05f, 0}, {0, 0.1f, 0.02f});
    ++i;
  }
}

// The product of what panes let through, each counted once, whatever their order.
TEST_P(ShadowTracers, PanesMultiply) {
  for (const int step : {1, 2, 3}) {
    scene::Scene scene = emptyScene();
    vec3 product(1.f);
    for (int i = 0; i < 5; ++i) {
      product *= trace::testing::addPane(scene, i);
      addSquare(scene, {0, 0, -1.f + 0.4f * static_cast<float>((i * step) % 5)}, {3, 0, 0},
                {0, 3, 0});
    }
    addMaterial(scene);
    addSquare(scene, {0, 0, 2}, {3, 0, 0}, {0, 3, 0});
    addClutter(scene);
    // Off the diagonal, where both triangles of a square would be met.
    const auto shares = trace(scene, {{{0.3f, 0.1f, -4}, {0.3f, 0.1f, 1.9f}},
                                      {{0.3f, 0.1f, 1.9f}, {0.3f, 0.1f, -4}},
                                      {{0.3f, 0.1f, -4}, {0.3f, 0.1f, 2.1f}},
                                      {{0.3f, 0.1f, -4}, {0.3f, 0.1f, -1.1f}}});
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(shares[0][c], product[c], 1e-6f);
      EXPECT_NEAR(shares[1][c], product[c], 1e-6f);
    }
    EXPECT_EQ(shares[2], kNothing);
    EXPECT_EQ(shares[3], kAll);
  }
}

TEST_P(ShadowTracers, OneSidedPanesCountFromTheirFront) {
  scene::Scene scene = emptyScene();
  scene::Material& pane = addMaterial(scene);
  pane.alphaMode = scene::AlphaMode::Blend;
  pane.doubleSided = false;
  pane.albedo.w = 0.25f;
  addSquare(scene, vec3(0), {1, 0, 0}, {0, 1, 0});  // its front faces +z
  const auto shares =
      trace(scene, {{{0.3f, 0.1f, 1}, {0.3f, 0.1f, -1}}, {{0.3f, 0.1f, -1}, {0.3f, 0.1f, 1}}});
  EXPECT_NE(shares[0], kAll);
  EXPECT_EQ(shares[1], kAll);
}

TEST_P(ShadowTracers, HolesOfAlphaTestLetThrough) {
  scene::Scene scene = emptyScene();
  auto image = std::make_shared<Image>(2, 1, 4, ComponentType::U8);
  std::ranges::fill(image->as<std::uint8_t>(), std::uint8_t{255});
  image->pixel<std::uint8_t>(1, 0)[3] = 0;  // the right half
  scene::Texture& texture = scene.textures.emplace_back();
  texture.image = image;
  texture.nearest = true;
  texture.wrapS = texture.wrapT = scene::Wrap::ClampToEdge;
  scene::Material& material = addMaterial(scene);
  material.alphaMode = scene::AlphaMode::Mask;
  material.albedoTexture.texture = 0;
  for (const float z : {0.f, 1.f}) addSquare(scene, {0, 0, z}, {1, 0, 0}, {0, 1, 0});
  for (const float slant : {0.f, 0.1f}) {
    const auto shares = trace(scene, {{{-0.5f, 0.2f, 2}, {-0.5f + slant, 0.2f, -1}},
                                      {{0.5f, 0.2f, 2}, {0.5f + slant, 0.2f, -1}},
                                      {{0.5f, -0.7f, 2}, {-0.9f + slant, -0.7f, -1}}});
    EXPECT_EQ(shares, (std::vector<vec3>{kNothing, kAll, kNothing}));
  }
}

TEST_P(ShadowTracers, TrianglesThatAreNotFiniteAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  scene::Scene scene = emptyScene();
  addMaterial(scene);
  addTriangles(scene, {{nan, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  addTriangles(scene, {{-infinity, 0, 1}, {infinity, 0, 1}, {0, infinity, 1}});
  const std::vector<Segment> through{{{0.5f, 0.5f, 2}, {0.5f, 0.5f, -2}}};
  EXPECT_EQ(trace(scene, through)[0], kAll);
  addTriangles(scene, {{0, 0, -1}, {2, 0, -1}, {0, 2, -1}});
  EXPECT_EQ(trace(scene, through)[0], kNothing);
  EXPECT_EQ(trace(scene, {{{0.5f, 0.5f, 2}, {0.5f, 0.5f, -0.5f}}})[0], kAll);
}

// A sphere of triangles: n strips of 2n. Corners that triangles share are the same to the last bit.
std::vector<vec3> sphere(vec3 middle, int n) {
  const auto at = [&](int i, int k) {
    if (i == 0 || i == n) return middle + vec3(0, i == 0 ? 1 : -1, 0);
    const float down = kPi * static_cast<float>(i) / static_cast<float>(n);
    const float around = kPi * static_cast<float>(k % (2 * n)) / static_cast<float>(n);
    return middle + vec3(std::sin(down) * std::cos(around), std::cos(down),
                         std::sin(down) * std::sin(around));
  };
  std::vector<vec3> corners;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2 * n; ++k) {
      if (i > 0) corners.insert(corners.end(), {at(i, k), at(i, k + 1), at(i + 1, k)});
      if (i < n - 1) corners.insert(corners.end(), {at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
  return corners;
}

// From places inside through corners, and places of edges, and nothing gets out.
TEST_P(ShadowTracers, NothingSlipsThroughWhereTrianglesMeet) {
  for (const vec3 middle : {vec3(0), vec3(137.3f, -41.7f, 960.1f)}) {
    scene::Scene scene = emptyScene();
    addMaterial(scene);
    const std::vector<vec3> corners = sphere(middle, 24);
    addTriangles(scene, corners);
    Random random(3);
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const vec3 next = corners[i - i % 3 + (i + 1) % 3];
      for (const float share : {0.f, 0.5f, random.uniform()}) {
        const vec3 on = glm::mix(corners[i], next, share);
        for (const vec3 from : {middle, middle + someVec(random, 0.4f)})
          segments.push_back({from, from + (on - from) * 3.f});
      }
    }
    const auto shares = trace(scene, segments);
    const std::size_t blocked = std::ranges::count(shares, kNothing);
    const std::size_t slips = GetParam().slips;
    EXPECT_LE(shares.size() - blocked, slips == 0 ? 0 : shares.size() / slips);
  }
}

// A symmetric scene, so that the planes x = 0, y = 0 and z = 0 and their halves cut an octree: rays
// in those planes, along the axes and through the corners of cells.
TEST_P(ShadowTracers, RaysAlongThePlanesOfCells) {
  scene::Scene scene = emptyScene();
  addMaterial(scene);
  std::vector<Segment> blocked, clear;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      vec3 out(0), a(0), b(0);
      out[axis] = side;
      a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1.f;
      // A wall of 8 x 8 squares, which meet in the planes.
      for (int i = 0; i < 64; ++i)
        addSquare(scene,
                  4.f * out + a * (static_cast<float>(i % 8) - 3.5f) +
                      b * (static_cast<float>(i / 8) - 3.5f),
                  0.5f * a, 0.5f * b);
      for (int x = -3; x <= 3; ++x)
        for (int y = -3; y <= 3; ++y) {
          const vec3 at = a * static_cast<float>(x) + b * static_cast<float>(y);
          blocked.push_back({at, at + 8.f * out});
          blocked.push_back({vec3(0), 2.f * (at + 4.f * out)});
          clear.push_back({vec3(0), 0.9f * (at + 4.f * out)});
          clear.push_back({at - 3.9f * out, at + 3.9f * out});
          clear.push_back({at + 5.f * out, at + 9.f * out});
          clear.push_back({at + 4.5f * out, at + 4.5f * out + 3.f * a - 2.f * b});
        }
    }
  const auto first = trace(scene, blocked), second = trace(scene, clear);
  EXPECT_EQ(std::ranges::count(first, kNothing), first.size());
  EXPECT_EQ(std::ranges::count(second, kAll), second.size());
}

scene::Scene manySquares() {
  scene::Scene scene = emptyScene();
  scene::Material& pane = addMaterial(scene);
  pane.alphaMode = scene::AlphaMode::Blend;
  pane.albedo.w = 0.3f;
  pane.transmission = {1.f, 0.8f, 0.5f};
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    if (i == 150) addMaterial(scene);
    const vec3 at = someVec(random, 5.f), a = someVec(random, 0.6f);
    addSquare(scene, at, a, glm::cross(a, someVec(random, 1.f)));
  }
  return scene;
}

std::vector<Segment> manySegments() {
  Random random(13);
  std::vector<Segment> segments;
  for (int i = 0; i < 5000; ++i) {
    const vec3 from = someVec(random, 6.f);
    segments.push_back({from, someVec(random, 6.f)});
  }
  return segments;
}

TEST_P(ShadowTracers, EachRayHasItsOwnAnswer) {
  const scene::Scene scene = manySquares();
  const World world = makeWorld(scene);
  const auto tracer = GetParam().make(world);
  std::vector<Segment> segments = manySegments();
  const auto shares = trace(*tracer, segments);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const vec3 alone = trace(*tracer, {segments[i]})[0];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shares[i][c], alone[c], 1e-6f) << i;
  }
  std::ranges::reverse(segments);
  auto backwards = trace(*tracer, segments);
  std::ranges::reverse(backwards);
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shares[i][c], backwards[i][c], 1e-6f) << i;
  const auto blocked = std::ranges::count(shares, kNothing),
             clear = std::ranges::count(shares, kAll);
  EXPECT_GT(blocked, 500);
  EXPECT_GT(clear, 500);
  EXPECT_GT(std::ssize(shares) - blocked - clear, 500);
}

TEST_P(ShadowTracers, SameBitsForAnyNumberOfThreads) {
  const scene::Scene scene = manySquares();
  const World world = makeWorld(scene);
  const auto tracer = GetParam().make(world);
  const std::vector<Segment> segments = manySegments();
  std::vector<std::vector<vec3>> found;
  const int threads = threadCount();
  for (const int count : {1, 4}) {
    setThreadCount(count);
    std::vector<vec3>& shares = found.emplace_back(segments.size());
    parallelFor(segments.size(), 64, [&](std::size_t begin, std::size_t end) {
      const std::vector<Segment> some(segments.begin() + static_cast<std::ptrdiff_t>(begin),
                                      segments.begin() + static_cast<std::ptrdiff_t>(end));
      std::ranges::copy(trace(*tracer, some), shares.begin() + static_cast<std::ptrdiff_t>(begin));
    });
  }
  setThreadCount(threads);
  EXPECT_EQ(found[0], found[1]);
}

}  // namespace
}  // namespace lucerna::bake
