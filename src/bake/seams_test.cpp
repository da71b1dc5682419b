// Seams of small scenes under made-up light, measured by lookups of the test's own.
#include "bake/seams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "bake/solve_seams.hpp"
#include "core/parallel.hpp"
#include "image/ktx2.hpp"

namespace lucerna::bake {
namespace {

using lightmap::HalfTiles;
using lightmap::kTileTexels;
using Light = std::function<vec3(vec3 positionW, vec3 normalW)>;  // brightness
using Key = std::array<float, 3>;

Key keyOf(vec3 p) {
  return {p.x + 0.f, p.y + 0.f, p.z + 0.f};
}

struct TestScene : scene::Scene {
  TestScene() { materials.emplace_back(); }
  void add(scene::Mesh mesh, const mat4& worldFromNode = mat4(1.f)) {
    const auto index = static_cast<std::uint32_t>(meshes.size());
    meshes.push_back(std::move(mesh));
    nodes.emplace_back().worldFromNode = worldFromNode;
    objects.push_back({.node = index, .mesh = index, .material = 0, .boundsW = {}});
  }
  // A rectangle with its front where u x v leads; without normals.
  void addQuad(vec3 corner, vec3 u, vec3 v, const mat4& worldFromNode = mat4(1.f)) {
    scene::Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    add(std::move(mesh), worldFromNode);
  }
};

// Of radius 1, with its own normals.
scene::Mesh sphere(int rings) {
  scene::Mesh mesh;
  const int across = 2 * rings;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i < across; ++i) {
      const float a = 2 * kPi * static_cast<float>(i) / static_cast<float>(across);
      const float b = kPi * static_cast<float>(j) / static_cast<float>(rings);
      const float ring = j == 0 || j == rings ? 0.f : std::sin(b);
      mesh.positions.emplace_back(ring * std::cos(a), -std::cos(b), -ring * std::sin(a));
    }
  mesh.normals = mesh.positions;
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < across; ++i) {
      const auto at = [&](int column, int row) {
        return static_cast<std::uint32_t>(row * across + column % across);
      };
      for (const std::uint32_t k :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        mesh.indices.push_back(k);
    }
  return mesh;
}

Plan planOf(const scene::Scene& scene, float density, Unwrap unwrap = Unwrap::Charts) {
  BakeSettings settings;
  settings.unwrap = unwrap;
  settings.density = density;
  settings.pack.side = 256;
  Result<Plan> plan = makePlan(scene, settings);
  CHECK(plan, "{}", plan.error().message);
  return std::move(*plan);
}

float white(const Plan& plan) {
  return kPi * std::exp2(-plan.world.scene->exposure);
}

std::array<std::uint16_t, 3> halves(vec3 e) {
  return {halfFromFloat(e.x), halfFromFloat(e.y), halfFromFloat(e.z)};
}

// Lights texels where the baker would, and those beside them as it does. lights: of each group.
BakedLight bakedOf(const Plan& plan, const std::vector<Light>& lights) {
  BakedLight baked = emptyLight(plan);
  Samples samples;
  for (const Block& block : plan.blocks) {
    ChartSampler(plan.world, plan.charts.charts[block.chart], 1).sample(block, samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const ivec2 texel(samples.texels[i] % block.size.x, samples.texels[i] / block.size.x);
      const ivec2 p = placed(plan, block.chart, block.corner + texel);
      const int map = plan.packed.packing.places[block.chart].map;
      baked.texels.touched[map][static_cast<std::size_t>(p.y) * baked.texels.side + p.x] = true;
      for (std::size_t g = 0; g < lights.size(); ++g) {
        const vec3 light = lights[g]({samples.x[i], samples.y[i], samples.z[i]},
                                     {samples.nx[i], samples.ny[i], samples.nz[i]});
        const auto rgb = halves(light * white(plan));
        if (g == 0)
          std::ranges::copy(rgb, baked.maps[map].pixel<std::uint16_t>(p.x, p.y));
        else if (light != vec3(0.f))
          for (std::size_t c = 0; c < 3; ++c)
            baked.groups[g].add(static_cast<std::uint16_t>(map), p.x, p.y)[c * kTileTexels] =
                rgb[c];
      }
    }
  }
  dilate(baked);
  return baked;
}

vec3 brightnessAt(const Plan& plan, const BakedLight& baked, int map, ivec2 p) {
  const std::uint16_t* e = baked.maps[map].pixel<std::uint16_t>(p.x, p.y);
  return vec3(floatFromHalf(e[0]), floatFromHalf(e[1]), floatFromHalf(e[2])) / white(plan);
}

vec3 bilinear(const Plan& plan, const BakedLight& baked, int map, vec2 p) {
  const auto texel = [&](float x, float y) {
    const ivec2 at(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    return brightnessAt(plan, baked, map, glm::clamp(at, ivec2(0), ivec2(baked.texels.side - 1)));
  };
  const float x = p.x - 0.5f, y = p.y - 0.5f;
  const float fx = x - std::floor(x), fy = y - std::floor(y);
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), fx),
                  glm::mix(texel(x, y + 1), texel(x + 1, y + 1), fx), fy);
}

// Steps at some points of all edges between two triangles that lie apart in the maps, sorted;
// those where `counts` says so.
std::vector<float> stepsOf(const Plan& plan, const BakedLight& baked,
                           const std::function<bool(vec3)>& counts = {}) {
  struct Side {
    vec3 aW, bW;
    int map;
    vec2 a, b;
  };
  std::map<std::pair<Key, Key>, std::vector<Side>> edges;
  const lightmap::Layout layout = layoutOf(plan);
  for (const WorldObject& object : plan.world.objects)
    for (std::uint32_t t = 0; t < object.triangleCount; ++t) {
      const lightmap::TrianglePlace& place = layout.objects[object.object][t];
      if (place.map < 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const auto corners = plan.world.indicesOf(object).subspan(3 * std::size_t{t}, 3);
        Side side{.aW = plan.world.positions[corners[k]],
                  .bW = plan.world.positions[corners[next]],
                  .map = place.map,
                  .a = place.corners[k],
                  .b = place.corners[next]};
        if (keyOf(side.bW) < keyOf(side.aW)) std::swap(side.aW, side.bW), std::swap(side.a, side.b);
        edges[{keyOf(side.aW), keyOf(side.bW)}].push_back(side);
      }
    }
  std::vector<float> steps;
  for (const auto& [ends, sides] : edges) {
    if (sides.size() != 2) continue;
    const Side &p = sides[0], &q = sides[1];
    if (p.map == q.map && glm::distance(p.a, q.a) + glm::distance(p.b, q.b) < 0.01f) continue;
    const int count = 2 + static_cast<int>(7 * glm::distance(p.a, p.b));
    for (int i = 0; i <= count; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(count);
      if (counts && !counts(glm::mix(p.aW, p.bW, t))) continue;
      const vec3 step =
          glm::abs(glm::clamp(bilinear(plan, baked, p.map, glm::mix(p.a, p.b, t)), 0.f, 1.f) -
                   glm::clamp(bilinear(plan, baked, q.map, glm::mix(q.a, q.b, t)), 0.f, 1.f));
      steps.push_back(std::max({step.x, step.y, step.z}));
    }
  }
  std::ranges::sort(steps);
  return steps;
}

float percentile99(const std::vector<float>& sorted) {
  return sorted[sorted.size() * 99 / 100];
}

bool sameMaps(const BakedLight& a, const BakedLight& b) {
  for (std::size_t i = 0; i < a.maps.size(); ++i)
    for (int y = 0; y < a.texels.side; ++y)
      for (int x = 0; x < a.texels.side; ++x)
        if (!std::equal(a.maps[i].pixel<std::uint16_t>(x, y),
                        a.maps[i].pixel<std::uint16_t>(x, y) + 3,
                        b.maps[i].pixel<std::uint16_t>(x, y)))
          return false;
  return true;
}

vec3 wavy(vec3 p, vec3) {
  return {0.5f + 0.4f * std::sin(3.f * p.x + p.y), 0.3f + 0.2f * std::cos(4.f * p.z),
          0.2f + 0.1f * p.y};
}
vec3 lampAbove(vec3, vec3 n) {
  return 0.6f * std::max(n.y, 0.f) * vec3(1.f, 0.8f, 0.5f);
}

constexpr float kSeen = 1.f / 255.f;

TEST(Seams, ASphereShowsNone) {
  TestScene scene;
  scene.add(sphere(24));
  const Plan plan = planOf(scene, 20.f);
  for (const Light& light : {Light(wavy), Light(lampAbove)}) {
    BakedLight baked = bakedOf(plan, {light});
    const float before = percentile99(stepsOf(plan, baked));
    const SeamReport report = closeSeams(plan, baked);
    EXPECT_GT(before, 2 * kSeen);
    EXPECT_LE(percentile99(stepsOf(plan, baked)), kSeen);
    EXPECT_GT(report.seams, 20u);
    EXPECT_GT(report.before.percentile99, 2 * kSeen);
    EXPECT_LE(report.after.percentile99, kSeen);
  }
}

// Rectangles of some texels with seams all around have too few values to agree everywhere.
TEST(Seams, ASphereOfPairsShowsLess) {
  TestScene scene;
  scene.add(sphere(12));
  const Plan plan = planOf(scene, 20.f, Unwrap::Pairs);
  BakedLight baked = bakedOf(plan, {wavy});
  const float before = percentile99(stepsOf(plan, baked));
  closeSeams(plan, baked);
  EXPECT_LT(percentile99(stepsOf(plan, baked)), 0.2f * before);
}

// Exposure is what brightness depends on, so a darker scene of more exposure is solved alike.
TEST(Seams, BrightnessCountsNotIrradiance) {
  TestScene scene;
  scene.add(sphere(16));
  scene.exposure = -9.f;
  const Plan plan = planOf(scene, 20.f);
  BakedLight baked = bakedOf(plan, {wavy});
  const SeamReport report = closeSeams(plan, baked);
  EXPECT_GT(report.before.percentile99, 2 * kSeen);
  EXPECT_LE(report.after.percentile99, kSeen);
}

TEST(Seams, LightThatAgreesStays) {
  TestScene scene;
  scene.add(sphere(16));
  const Plan plan = planOf(scene, 20.f);
  const BakedLight before = bakedOf(plan, {[](vec3, vec3) { return vec3(0.7f, 0.1f, 3.f); }});
  BakedLight after = before;
  EXPECT_GT(closeSeams(plan, after).texels, 100u);
  EXPECT_TRUE(sameMaps(before, after));
}

// Fills all texels around each chart of a flat floor with a linear course, which lookups follow.
void fillLinear(const Plan& plan, BakedLight& baked, const std::function<vec3(vec3)>& course) {
  const lightmap::Layout layout = layoutOf(plan);
  for (const WorldObject& object : plan.world.objects) {
    const lightmap::TrianglePlace& place = layout.objects[object.object][0];
    const auto corners = plan.world.indicesOf(object).first(3);
    const vec3 a = plan.world.positions[corners[0]];
    const glm::mat2 flat(place.corners[1] - place.corners[0], place.corners[2] - place.corners[0]);
    // The first triangle has half of a rectangle's sides.
    const vec2 low = glm::min(glm::min(place.corners[0], place.corners[1]), place.corners[2]);
    const vec2 high = glm::max(glm::max(place.corners[0], place.corners[1]), place.corners[2]);
    for (int y = 0; y < layout.side; ++y)
      for (int x = 0; x < layout.side; ++x) {
        const vec2 middle = vec2(x, y) + 0.5f;
        const vec2 beside = glm::abs(glm::clamp(middle, low, high) - middle);
        if (std::max(beside.x, beside.y) > 1.f) continue;
        const vec2 st = glm::inverse(flat) * (middle - place.corners[0]);
        const vec3 p = a + st.x * (plan.world.positions[corners[1]] - a) +
                       st.y * (plan.world.positions[corners[2]] - a);
        std::ranges::copy(halves(course(p) * white(plan)),
                          baked.maps[place.map].pixel<std::uint16_t>(x, y));
      }
  }
}

TEST(Seams, ALinearCourseAcrossTwoObjectsStays) {
  TestScene scene;
  scene.addQuad({0, 0, 3}, {2, 0, 0}, {0, 0, -3});
  scene.addQuad({2, 0, 3}, {4, 0, 0}, {0, 0, -3});
  Plan plan = planOf(scene, 7.3f);
  for (Place& place : plan.packed.packing.places) place.corner += 3;  // off the map's edge
  BakedLight baked = bakedOf(plan, {wavy});
  fillLinear(plan, baked, [](vec3 p) { return vec3(0.1f + 0.1f * p.x, 0.2f, 0.3f + 0.1f * p.z); });
  const BakedLight before = baked;
  const SeamReport report = closeSeams(plan, baked);
  EXPECT_EQ(report.seams, 1u);
  EXPECT_LT(report.before.largest, 1e-3);
  for (int y = 0; y < baked.texels.side; ++y)
    for (int x = 0; x < baked.texels.side; ++x) {
      const vec3 change =
          glm::abs(brightnessAt(plan, baked, 0, {x, y}) - brightnessAt(plan, before, 0, {x, y}));
      EXPECT_LT(std::max({change.x, change.y, change.z}), 1e-3f) << x << ", " << y;
    }
}

TEST(Seams, ABoxHasNone) {
  TestScene scene;
  const vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), one = x + y + z;
  scene.addQuad({0, 0, 0}, y, x), scene.addQuad({0, 0, 0}, z, y), scene.addQuad({0, 0, 0}, x, z);
  scene.addQuad(one, -x, -y), scene.addQuad(one, -y, -z), scene.addQuad(one, -z, -x);
  const Plan plan = planOf(scene, 5.f);
  EXPECT_TRUE(findSeams(plan).empty());
  const BakedLight before = bakedOf(plan, {wavy});
  BakedLight after = before;
  closeSeams(plan, after);
  EXPECT_TRUE(sameMaps(before, after));
}

TEST(Seams, AMirroredObjectGoesOnOnItsOtherSide) {
  TestScene scene;
  scene.addQuad({0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  scene.addQuad({0, 0, 1}, {1, 0, 0}, {0, 0, -1}, glm::scale(mat4(1.f), vec3(-1, 1, 1)));
  EXPECT_EQ(findSeams(planOf(scene, 10.f)).size(), 1u);
  TestScene turned;  // the other's front is below
  turned.addQuad({0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  turned.addQuad({0, 0, 1}, {-1, 0, 0}, {0, 0, -1});
  EXPECT_TRUE(findSeams(planOf(turned, 10.f)).empty());
}

// A floor of two objects, in the light on one side of a wall that stands on half of the seam.
TEST(Seams, AWallDividesLight) {
  TestScene scene;
  scene.addQuad({0, 0, 8}, {4, 0, 0}, {0, 0, -8});
  scene.addQuad({4, 0, 8}, {4, 0, 0}, {0, 0, -8});
  scene.addQuad({4, 0, 4}, {0, 2, 0}, {0, 0, -4});
  const Plan plan = planOf(scene, 5.f);
  const BakedLight before = bakedOf(plan, {[](vec3 p, vec3) {
                                      const float open = glm::smoothstep(4.5f, 6.f, p.z);
                                      return vec3(p.x < 4.f ? 0.8f : 0.8f * open);
                                    }});
  BakedLight after = before;
  closeSeams(plan, after);
  const auto walled = [](vec3 p) { return p.z < 3.5f; };
  const auto open = [](vec3 p) { return p.z > 4.5f; };
  EXPECT_GT(stepsOf(plan, after, walled).front(), 0.79f);
  EXPECT_GT(percentile99(stepsOf(plan, before, open)), 0.5f);
  EXPECT_LT(percentile99(stepsOf(plan, after, open)), kSeen);
}

// What the report says of encoded maps is what whole maps show that are encoded and read again.
TEST(Seams, StepsOfEncodedMapsAreThoseOfWholeMaps) {
  TestScene scene;
  scene.add(sphere(24));
  Plan plan = planOf(scene, 20.f);
  plan.settings.encodings = {Encoding::Rgb9e5, Encoding::Bc6h, Encoding::Png};
  BakedLight baked = bakedOf(plan, {wavy});
  const SeamReport report = closeSeams(plan, baked);
  ASSERT_EQ(report.encoded.size(), 2u);
  EXPECT_LE(report.encoded[0].after.percentile99, kSeen);  // RGB9E5
  EXPECT_GT(report.encoded[1].after.percentile99, report.encoded[0].after.percentile99);
  for (const EncodedSteps& steps : report.encoded) {
    BakedLight read = baked;
    for (std::size_t i = 0; i < read.maps.size(); ++i) {
      const auto format = steps.encoding == Encoding::Bc6h ? HdrFormat::Bc6h : HdrFormat::Rgb9e5;
      const auto layers = decodeKtx2(encodeKtx2({&baked.maps[i], 1}, format), "map");
      ASSERT_TRUE(layers);
      read.maps[i] = converted(layers->front(), ComponentType::Half, 3);
    }
    // The test's own points are others than those of the report.
    const float found = percentile99(stepsOf(plan, read));
    EXPECT_NEAR(found, steps.after.percentile99, 0.3f * found + 0.1f * kSeen);
  }
}

std::vector<std::array<int, 6>> bitsOf(const HalfTiles& group) {
  std::vector<std::array<int, 6>> list;
  for (const std::uint32_t slot : group.sorted())
    group.forTexelsOf(slot, [&](std::uint16_t map, int x, int y, const std::uint16_t* red) {
      list.push_back({map, x, y, red[0], red[kTileTexels], red[2 * kTileTexels]});
    });
  return list;
}

TEST(Seams, AnyNumberOfThreadsGivesTheSameBits) {
  TestScene scene;
  scene.add(sphere(16));
  scene.add(sphere(12), glm::translate(mat4(1.f), vec3(3, 0, 0)));
  Plan plan = planOf(scene, 20.f);
  plan.groups.resize(3);
  const int threads = threadCount();
  std::vector<BakedLight> results;
  for (const int count : {1, 2, 2}) {
    setThreadCount(count);
    results.push_back(bakedOf(plan, {wavy, lampAbove, wavy}));
    closeSeams(plan, results.back());
  }
  setThreadCount(threads);
  for (const std::size_t other : {1u, 2u}) {
    EXPECT_TRUE(sameMaps(results[0], results[other]));
    for (const std::size_t g : {1u, 2u})
      EXPECT_EQ(bitsOf(results[0].groups[g]), bitsOf(results[other].groups[g]));
  }
}

// As finish() does with more groups than memory should hold.
TEST(Seams, GroupByGroupIsTheSameAsAllAtOnce) {
  TestScene scene;
  scene.add(sphere(16));
  Plan plan = planOf(scene, 20.f);
  plan.groups.resize(3);
  BakedLight together = bakedOf(plan, {wavy, lampAbove, wavy});
  const BakedLight before = together;
  const SeamReport wanted = closeSeams(plan, together);
  Seams seams(plan, before.texels);
  BakedLight part{.texels = before.texels, .maps = before.maps, .groups = {}};
  seams.close(part);
  EXPECT_TRUE(sameMaps(part, together));
  part.maps.clear();
  for (const std::size_t g : {1u, 2u}) {
    part.groups.assign(3, HalfTiles(3));
    part.groups[g] = before.groups[g];
    seams.close(part);
    EXPECT_EQ(bitsOf(part.groups[g]), bitsOf(together.groups[g]));
  }
  EXPECT_NEAR(seams.report().before.percentile99, wanted.before.percentile99, 1e-6);
  EXPECT_NEAR(seams.report().after.percentile99, wanted.after.percentile99, 1e-6);
}

// Of a map that is solved alone and one that a group is added to, the largest difference; steps of
// the latter.
struct Sum {
  float worst = 0.f, percentile99 = 0.f;
};
Sum addUp(const Light& always, const Light& group) {
  TestScene scene;
  scene.add(sphere(20));
  Plan plan = planOf(scene, 20.f);
  BakedLight sum = bakedOf(plan, {[&](vec3 p, vec3 n) { return always(p, n) + group(p, n); }});
  closeSeams(plan, sum);
  plan.groups.resize(2);
  BakedLight parts = bakedOf(plan, {always, group});
  closeSeams(plan, parts);
  for (const std::uint32_t slot : parts.groups[1].sorted())
    parts.groups[1].forTexelsOf(
        slot, [&](std::uint16_t map, int x, int y, const std::uint16_t* red) {
          std::uint16_t* e = parts.maps[map].pixel<std::uint16_t>(x, y);
          for (std::size_t c = 0; c < 3; ++c)
            e[c] = halfFromFloat(floatFromHalf(e[c]) + floatFromHalf(red[c * kTileTexels]));
        });
  Sum result;
  result.percentile99 = percentile99(stepsOf(plan, parts));
  for (int y = 0; y < sum.texels.side; ++y)
    for (int x = 0; x < sum.texels.side; ++x) {
      const vec3 off =
          glm::abs(brightnessAt(plan, sum, 0, {x, y}) - brightnessAt(plan, parts, 0, {x, y}));
      result.worst = std::max({result.worst, off.x, off.y, off.z});
    }
  return result;
}

TEST(Seams, AGroupAndTheRestAddUp) {
  const vec3 color(0.5f, 0.4f, 0.3f);
  const auto lamp = [](vec3 p) { return glm::smoothstep(0.2f, 1.f, p.x + 0.3f * p.y); };
  const Sum everywhere = addUp(wavy, [&](vec3 p, vec3) { return (0.1f + lamp(p)) * color; });
  EXPECT_LT(everywhere.worst, 0.5f * kSeen);
  EXPECT_LE(everywhere.percentile99, kSeen);
  // Where its light ends, the group alone may not become negative, which the sum might have become.
  const Sum local = addUp(wavy, [&](vec3 p, vec3) { return lamp(p) * color; });
  EXPECT_LT(local.worst, 4 * kSeen);
  EXPECT_LE(local.percentile99, kSeen);
}

// At the least sum of squares the gradient is 0, or points below 0 where a value is 0.
TEST(Seams, TheSolutionIsTheLeastThatIsNotNegative) {
  TestScene scene;
  scene.add(sphere(16));
  const Plan plan = planOf(scene, 20.f);
  const BakedLight baked = bakedOf(plan, {wavy});
  const std::vector<Seam> seams = findSeams(plan);
  const auto tracer = makeEmbreeTracer(plan.world);
  const SeamSystem system(seams, seamPoints(seams, 0, *tracer), {}, baked.texels);
  int zeros = 0;
  for (const SeamPart& part : system.parts()) {
    // Stripes of light and none.
    std::vector<double> start(part.texels);
    for (std::uint32_t i = 0; i < part.texels; ++i) start[i] = i % 97 == 0 ? 50 : i / 5 % 2;
    std::vector<double> values = start;
    solve(system, part, values);
    std::vector<double> gradient(part.texels);
    for (std::uint32_t i = 0; i < part.texels; ++i)
      gradient[i] = double{system.stiffness()[part.firstTexel + i]} * (values[i] - start[i]);
    for (const SeamSample& sample : system.samplesOf(part)) {
      double off = 0.;
      for (std::size_t k = 0; k < 8; ++k)
        off += double{sample.weights[k]} * values[sample.texels[k] - part.firstTexel];
      for (std::size_t k = 0; k < 8; ++k)
        gradient[sample.texels[k] - part.firstTexel] +=
            double{sample.share} * sample.weights[k] * off;
    }
    for (std::uint32_t i = 0; i < part.texels; ++i) {
      EXPECT_GE(values[i], 0.);
      EXPECT_GT(gradient[i], -5e-5);
      EXPECT_TRUE(values[i] == 0. || gradient[i] < 5e-5);
      zeros += values[i] == 0.;
    }
  }
  EXPECT_GT(zeros, 10);
}

}  // namespace
}  // namespace lucerna::bake
