// The closed forms of penumbra.hpp against rays from every part of the light through the scene
// itself.
#include "scene/builtin/penumbra.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/math.hpp"

namespace lucerna::scene::builtin {
namespace {

using Case = PenumbraOptions::Case;
using glm::dvec3;

struct Triangle {
  dvec3 a, b, c;
  vec3 transmittance{0.f};
};

// Occluders: everything but the receivers.
std::vector<Triangle> occludersOf(Scene& scene) {
  updateTransforms(scene);
  std::vector<Triangle> triangles;
  for (const Object& object : scene.objects) {
    const Material& material = scene.materials[object.material];
    if (material.name == "sheet") continue;
    const Mesh& mesh = scene.meshes[object.mesh];
    const auto at = [&](std::size_t i) {
      const vec4 position(mesh.positions[mesh.indices[i]], 1);
      return dvec3(scene.nodes[object.node].worldFromNode * position);
    };
    const bool pane = material.alphaMode == AlphaMode::Blend;
    const vec3 through = pane ? transmittance(material.albedo.w, material.transmission) : vec3(0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      triangles.push_back({at(i), at(i + 1), at(i + 2), through});
  }
  return triangles;
}

// Whether the segment crosses the triangle (Moeller and Trumbore, 1997).
bool crosses(dvec3 from, dvec3 to, const Triangle& t) {
  const dvec3 d = to - from, e1 = t.b - t.a, e2 = t.c - t.a, p = glm::cross(d, e2);
  const double det = glm::dot(e1, p);
  if (std::abs(det) < 1e-14) return false;
  const dvec3 s = from - t.a, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, w = glm::dot(e2, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && w > 1e-9 && w < 1;
}

// The least and the most, over the light's rim and centre, of what reaches a point of the receiver.
struct Range {
  vec3 least{1.f}, most{0.f};
};
Range reaching(dvec3 point, const PlacedLight& light, const std::vector<Triangle>& occluders) {
  const dvec3 axis(light.directionW);
  const dvec3 u =
      glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
  const dvec3 v = glm::cross(axis, u);
  Range range;
  constexpr int kSteps = 720;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 2 * glm::pi<double>() * i / kSteps;
    const double radius = i == kSteps ? 0. : static_cast<double>(light.radius);
    const dvec3 from =
        dvec3(light.positionW) + radius * (std::cos(angle) * u + std::sin(angle) * v);
    vec3 passes(1.f);
    for (const Triangle& t : occluders)
      if (crosses(from, point, t)) passes *= t.transmittance;
    range.least = glm::min(range.least, passes);
    range.most = glm::max(range.most, passes);
  }
  return range;
}

class Penumbra : public ::testing::TestWithParam<PenumbraOptions> {};
std::string nameOf(const ::testing::TestParamInfo<PenumbraOptions>& info) {
  constexpr const char* kNames[] = {"HalfPlane", "Cards", "Fence",  "Pole",
                                    "Grazing",   "Panes", "Overlap"};
  std::string name = kNames[static_cast<int>(info.param.which)];
  if (info.param.which == Case::Overlap) name += std::to_string(info.param.lights);
  return name;
}
INSTANTIATE_TEST_SUITE_P(
    Cases, Penumbra,
    ::testing::Values(PenumbraOptions{Case::HalfPlane}, PenumbraOptions{Case::Cards},
                      PenumbraOptions{Case::Fence}, PenumbraOptions{Case::Pole},
                      PenumbraOptions{Case::Grazing}, PenumbraOptions{Case::Panes},
                      PenumbraOptions{Case::Overlap, 1}, PenumbraOptions{Case::Overlap, 4},
                      PenumbraOptions{Case::Overlap, 32}),
    nameOf);

// Just outside both ends the whole disc gives one value, just inside them it does not: the ends are
// where the formulas say, to two thousandths of the width.
TEST_P(Penumbra, BeginsAndEndsWhereTheFormulaSays) {
  Scene scene = makePenumbra(GetParam());
  const std::vector<Triangle> occluders = occludersOf(scene);
  const std::vector<PlacedLight> lights = placeLights(scene);
  const std::vector<PenumbraEdge> edges = expectedPenumbrae(GetParam());
  ASSERT_FALSE(edges.empty());
  for (const PenumbraEdge& edge : edges) {
    SCOPED_TRACE(edge.name);
    ASSERT_LT(edge.light, lights.size());
    ASSERT_GT(edge.width(), 0.005f);
    const auto at = [&](double share) {  // 0: the lit end
      const dvec3 lit(edge.litW), dark(edge.darkW);
      return reaching(lit + share * (dark - lit), lights[edge.light], occluders);
    };
    const auto expectAll = [](const Range& range, vec3 value) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(range.least[c], value[c], 1e-5f);
        EXPECT_NEAR(range.most[c], value[c], 1e-5f);
      }
    };
    constexpr double kSlack = 2e-3;  // of the width: the rim is sampled, the pole has 256 sides
    expectAll(at(-kSlack), edge.litTransmittance);
    expectAll(at(1 + kSlack), edge.darkTransmittance);
    for (const double share : {kSlack, 0.5, 1 - kSlack}) {
      const Range range = at(share);
      EXPECT_LT(glm::distance(range.most, edge.litTransmittance), 1e-5f) << share;
      EXPECT_LT(glm::distance(range.least, edge.darkTransmittance), 1e-5f) << share;
    }
  }
}

// System C's formula: the light's diameter times (d_receiver - d_blocker) / d_blocker.
TEST(PenumbraWidth, IsTheLightsDiameterTimesTheRatioOfDistances) {
  for (const PenumbraEdge& edge : expectedPenumbrae({Case::HalfPlane}))
    EXPECT_NEAR(edge.width(), 2 * 0.3f * (4.f - 3.f) / 3.f, 1e-5f);
  const std::vector<PenumbraEdge> cards = expectedPenumbrae({Case::Cards});
  ASSERT_EQ(cards.size(), 6u);
  const float heights[] = {0.3f, 0.3f, 1.f, 1.f, 2.f, 2.f};
  for (std::size_t i = 0; i < cards.size(); ++i)
    EXPECT_NEAR(cards[i].width(), 2 * 0.25f * heights[i] / (4.5f - heights[i]), 1e-5f);
}

TEST(PenumbraScenes, HaveAsManyLightsAsAskedFor) {
  EXPECT_EQ(makePenumbra({Case::Overlap, 32}).lights.size(), 32u);
  EXPECT_EQ(expectedPenumbrae({Case::Overlap, 32}).size(), 64u);
  EXPECT_EQ(makePenumbra({Case::Fence}).lights.size(), 1u);
}

}  // namespace
}  // namespace lucerna::scene::builtin
