// Texels of charts against clipped areas, and pictures by a few of their pixels.
#include "lightmap/chart_texels.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/random.hpp"
#include "lightmap/pictures.hpp"

namespace lucerna::lightmap {
namespace {

using Polygon = std::vector<glm::dvec2>;

// The part of the polygon where dot(normal, p) <= limit.
Polygon clipped(const Polygon& polygon, glm::dvec2 normal, double limit) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = limit - glm::dot(normal, a), db = limit - glm::dot(normal, b);
    if (da >= 0.) result.push_back(a);
    if ((da < 0.) != (db < 0.)) result.push_back(a + (b - a) * (da / (da - db)));
  }
  return result;
}

// What is left of the triangle in the texel, `margin` away from its sides.
Polygon inTexel(const std::array<vec2, 3>& corners, int x, int y, double margin) {
  Polygon polygon(corners.begin(), corners.end());
  polygon = clipped(polygon, {1., 0.}, x + 1. - margin);
  polygon = clipped(polygon, {-1., 0.}, -(x + margin));
  polygon = clipped(polygon, {0., 1.}, y + 1. - margin);
  return clipped(polygon, {0., -1.}, -(y + margin));
}

TEST(ChartTexels, AreThoseThatClippingLeavesSomethingOf) {
  Random random(5);
  constexpr int kSide = 16;
  int touched = 0;
  for (int i = 0; i < 500; ++i) {
    std::array<vec2, 3> corners;
    for (vec2& corner : corners) corner = vec2(random.uniform(0, kSide), random.uniform(0, kSide));
    if (i % 3 == 0)  // thin
      corners[2] = 0.5f * (corners[0] + corners[1]) + vec2(random.uniform(-0.2f, 0.2f));
    std::set<std::pair<int, int>> found;
    forEachTexel(corners, kSide, [&](int x, int y) { found.emplace(x, y); });
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        // Twice the margin in is touched for certain, half of it out is not.
        const bool sure = !inTexel(corners, x, y, 2. * kClearOfBorder).empty();
        const bool possible = !inTexel(corners, x, y, 0.5 * kClearOfBorder).empty();
        EXPECT_TRUE(found.contains({x, y}) ? possible : !sure) << i << ": " << x << ", " << y;
      }
    touched += static_cast<int>(found.size());
  }
  EXPECT_GT(touched, 5000);
}

// A square of 4 texels in two triangles, and a triangle that overlaps it in one texel.
Layout layoutWithOverlap() {
  Layout layout{.side = 8, .maps = 2, .charts = 2, .objects = {{}}};
  layout.objects[0] = {{.map = 1, .chart = 0, .corners = {vec2(1, 1), vec2(3, 1), vec2(3, 3)}},
                       {.map = 1, .chart = 0, .corners = {vec2(1, 1), vec2(3, 3), vec2(1, 3)}},
                       {.map = 1, .chart = 1, .corners = {vec2(2, 2), vec2(4, 2), vec2(2, 4)}},
                       {.map = TrianglePlace::kNowhere, .chart = 0, .corners = {}}};
  return layout;
}

TEST(ChartTexels, OverlapsAndBordersAreFound) {
  const Layout layout = layoutWithOverlap();
  const ChartTexels none = chartTexels(layout, 0), texels = chartTexels(layout, 1);
  EXPECT_EQ(std::ranges::count(none.charts, ChartTexels::kNothing), 64);
  EXPECT_EQ(texels.overlaps, std::vector<std::uint32_t>{2 * 8 + 2});
  EXPECT_EQ(texels.at(2, 2), 0u);
  EXPECT_EQ(texels.at(3, 2), 1u);
  EXPECT_EQ(texels.at(3, 3), ChartTexels::kNothing);
  EXPECT_TRUE(texels.isBorder(1, 1));
  EXPECT_TRUE(texels.isBeside(0, 0));
  EXPECT_FALSE(texels.isBeside(1, 1));
  EXPECT_FALSE(texels.isBeside(6, 6));
  EXPECT_FALSE(texels.isBorder(6, 6));
}

TEST(Pictures, ValidityTellsTexelsApart) {
  Image map(8, 8, 3, ComponentType::F32);
  map.pixel<float>(7, 7)[1] = -1.f;
  const Image picture = validityPicture(chartTexels(layoutWithOverlap(), 1), map);
  std::set<std::array<std::uint8_t, 3>> colors;
  for (const ivec2 p : {ivec2(1, 1), ivec2(0, 0), ivec2(6, 6), ivec2(2, 2), ivec2(7, 7)}) {
    const std::uint8_t* rgb = picture.pixel<std::uint8_t>(p.x, p.y);
    colors.insert({rgb[0], rgb[1], rgb[2]});
  }
  EXPECT_EQ(colors.size(), 5u);
}

TEST(Pictures, WhiteInPiLuxIsHalfOfTheCurve) {
  Image map(1, 1, 3, ComponentType::F32);
  std::ranges::fill(map.as<float>(), kPi);
  const float shown = std::round(255.f * srgbFromLinear(0.5f));
  EXPECT_EQ(*tonePicture(map, 1.f).pixel<std::uint8_t>(0, 0), shown);
  EXPECT_GT(*tonePicture(map, 4.f).pixel<std::uint8_t>(0, 0), shown);
}

TEST(Pictures, PatchesShowTrianglesAndTiles) {
  Patch patch{.side = 16, .maps = 2};
  patch.triangles.roots = {{.map = 1, .borders = 0, .scale = 1.f, .corners = {}}};
  patch.triangles.roots[0].corners = {ivec2(0), ivec2(8 * kPatchUnit, 0), ivec2(0, 8 * kPatchUnit)};
  patch.triangles.nodes = {PatchNode::Split, PatchNode::Leaf, PatchNode::Leaf, PatchNode::Nothing,
                           PatchNode::Leaf};
  patch.tiles.tiles = {{.place = {.map = 0, .x = 1, .y = 0}, .scale = 2.f, .mask = 1}};
  patch.tiles.values.assign(kTileTexels, 65535);
  const Image tiles = patchPicture(patch, 0), triangles = patchPicture(patch, 1);
  EXPECT_EQ(*tiles.pixel<std::uint8_t>(8, 0), 255);
  EXPECT_EQ(*tiles.pixel<std::uint8_t>(9, 0), 0);
  EXPECT_EQ(*tiles.pixel<std::uint8_t>(0, 0), 0);
  const auto at = [&](int x, int y) {
    const std::uint8_t* rgb = triangles.pixel<std::uint8_t>(x, y);
    return std::array{rgb[0], rgb[1], rgb[2]};
  };
  const std::array<std::uint8_t, 3> black{};
  EXPECT_NE(at(0, 0), black);
  EXPECT_NE(at(5, 0), black);
  EXPECT_NE(at(0, 0), at(5, 0));  // two leaves
  EXPECT_EQ(at(0, 5), black);     // nothing
  EXPECT_EQ(at(12, 12), black);
  EXPECT_TRUE(lights(patch, 0) && lights(patch, 1) && !lights(patch, 2));
}

TEST(Densities, AreTexelsAMetreInTheWorld) {
  scene::Scene scene;
  scene.meshes.emplace_back().positions = {vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)};
  scene.meshes[0].indices = {0, 1, 2};
  scene::addNode(scene, "large", glm::scale(mat4(1.f), vec3(4.f)));
  scene::Object& object = scene.objects.emplace_back();
  object.node = object.mesh = object.material = 0;
  scene::updateTransforms(scene);
  Layout layout{.side = 64, .maps = 1, .charts = 1, .objects = {{}}};
  layout.objects[0] = {{.map = 0, .chart = 0, .corners = {vec2(0), vec2(40, 0), vec2(0, 40)}}};
  EXPECT_NEAR(densities(layout, scene)[0][0], 10.f, 1e-4f);
}

}  // namespace
}  // namespace lucerna::lightmap
