// Baked light against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "bake/light_scenes.hpp"
#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;
using glm::dvec3;
using scene::LightKind;

constexpr float kRadiance = 2.f;

// Lambert's formula in double precision, for polygons wholly above the surface.
double lambert(std::span<const dvec3> corners, dvec3 p, dvec3 n) {
  double sum = 0.;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 a = glm::normalize(corners[i] - p);
    const dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - p);
    const dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0.) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(across, n) / sine;
  }
  return 0.5 * std::abs(sum);
}

struct Errors {
  double worst = 0., rms = 0., mean = 0.;
};

// Irradiance at a place whose surface has this normal.
using Truth = std::function<double(dvec3 positionW, dvec3 normalW)>;

// Of each texel as a share of its own truth, or of `scale` if it is not 0.
Errors errorsOf(const std::vector<LitTexel>& texels, const Truth& truth, double scale = 0.) {
  Errors e;
  EXPECT_FALSE(texels.empty());
  for (const LitTexel& texel : texels) {
    double wanted = 0.;
    for (const vec3 place : texel.placesW)
      wanted +=
          truth(dvec3(place), dvec3(texel.normalW)) / static_cast<double>(texel.placesW.size());
    const double found = texel.irradiance.x;
    if (wanted == 0. && scale == 0.) {
      EXPECT_EQ(found, 0.) << texel.positionW.x << ' ' << texel.positionW.z;
      continue;
    }
    const double off = (found - wanted) / (scale > 0. ? scale : wanted);
    e.worst = std::max(e.worst, std::abs(off));
    e.mean += off / static_cast<double>(texels.size());
    e.rms += off * off / static_cast<double>(texels.size());
  }
  e.rms = std::sqrt(e.rms);
  return e;
}

std::vector<LitTexel> lit(const scene::Scene& scene, float density, const Sampling& sampling) {
  return lightAll(planOf(scene, {.density = density, .sampling = sampling}));
}

// A square lamp of 1 m that shines down, onto a floor, and onto a wall that stands beside it.
struct LampRoom {
  scene::Scene scene;
  std::array<dvec3, 4> corners;
  std::uint32_t floor, wall;
  explicit LampRoom(float height)
      : corners{dvec3(-0.5, height, -0.5), dvec3(0.5, height, -0.5), dvec3(0.5, height, 0.5),
                dvec3(-0.5, height, 0.5)} {
    addSurface(scene, vec3(kRadiance));
    addRectangle(scene, {0, height, 0}, {0.5f, 0, 0}, {0, 0, 0.5f});
    addSurface(scene);
    floor = addRectangle(scene, {0.5f, 0, 0}, {1.5f, 0, 0}, {0, 0, -2});
    wall = addRectangle(scene, {-1, 0.5f * height, 0}, {0, 0, -2}, {0, 0.5f * height, 0});
  }
};

// emitterSize 0.25: within 1.6 %, 0.6 % root mean square; 0.1: within 0.35 %, 0.15 %.
TEST(LightTruth, ARectangleOverAFloorAndBesideAWall) {
  for (const float height : {0.05f, 0.25f, 1.f, 4.f})
    for (const Sampling& sampling : {kStandard, kFinal}) {
      const LampRoom room(height);
      const auto all = lit(room.scene, 10.f, sampling);
      const bool isFinal = sampling.positions > 1;
      for (const std::uint32_t object : {room.floor, room.wall}) {
        if (object == room.wall && height < 0.1f && !isFinal) continue;  // less than half a texel
        SCOPED_TRACE(fmt::format("{} at {} m, {}", object == room.floor ? "floor" : "wall", height,
                                 isFinal ? "final" : "standard"));
        const Errors e = errorsOf(texelsOf(all, object), [&](dvec3 p, dvec3 n) {
          return kRadiance * lambert(room.corners, p, n);
        });
        // Texels that are lit from more places than the truth knows of differ more where light
        // falls off within them.
        EXPECT_LT(e.worst, !isFinal ? 1.6e-2 : height < 0.1f ? 1e-2 : 3.5e-3);
        EXPECT_LT(e.rms, isFinal ? 1.5e-3 : 6e-3);
      }
    }
}

// A closed box all of whose inside emits: irradiance is pi times radiance everywhere, next to the
// edges too, and where texels are cut by them.
TEST(LightTruth, AFurnaceIsEvenlyLit) {
  for (const vec3 size : {vec3(2, 2, 2), vec3(2.07f, 1.33f, 1.61f)})
    for (const Sampling& sampling : {kStandard, kFinal}) {
      scene::Scene scene;
      addSurface(scene, vec3(kRadiance));
      const vec3 x(0.5f * size.x, 0, 0), y(0, 0.5f * size.y, 0), z(0, 0, 0.5f * size.z);
      addRectangle(scene, x, z, y), addRectangle(scene, -x, y, z);
      addRectangle(scene, y, x, z), addRectangle(scene, -y, z, x);
      addRectangle(scene, z, y, x), addRectangle(scene, -z, x, y);
      const Errors e =
          errorsOf(lit(scene, 5.f, sampling), [](dvec3, dvec3) { return kPi * kRadiance; });
      EXPECT_LT(e.worst, sampling.positions > 1 ? 2.5e-4 : 2e-3);
    }
}

// The shadow of a board along a border between blocks, a little askew, so that it cuts all parts of
// texels on either side: standard sees how much of each, whichever block has the neighbours.
TEST(LightTruth, AHardEdgeAlongABlocksBorder) {
  scene::Scene scene;
  addSurface(scene);
  const auto floor = addRectangle(scene, {0, 0, 0}, {3.2f, 0, 0}, {0, 0, -3.2f});
  const vec3 along = glm::normalize(vec3(0.03f, 0, -1)), across(-along.z, 0, along.x);
  addRectangle(scene, vec3(0, 1, 0) + 5.f * across, 5.f * across, 9.f * along);
  addLight(scene, LightKind::Directional, {}, {0, -1, 0}).intensity = 1.f;
  const auto texels = texelsOf(lit(scene, 10.f, kStandard), floor);
  ASSERT_EQ(texels.size(), 64u * 64u);
  std::size_t cut = 0;
  for (const LitTexel& t : texels) {
    constexpr int kSide = 32;
    double open = 0.;
    for (int i = 0; i < kSide * kSide; ++i) {
      const vec2 off = (vec2(i % kSide, i / kSide) + 0.5f) / float{kSide} - 0.5f;
      const vec3 place = t.positionW + 0.1f * vec3(off.x, 0, off.y);
      open += glm::dot(place, across) < 0.f ? 1. / (kSide * kSide) : 0.;
    }
    if (open > 0. && open < 1.) ++cut;
    EXPECT_NEAR(t.irradiance.x, open, 0.12) << t.positionW.x << ' ' << t.positionW.z;
  }
  EXPECT_GT(cut, 60u);
}

// A lamp over the edge of a half-plane: of its disc is seen what lies beyond a chord.
double shareBeyond(double chord) {
  const double c = std::clamp(chord, -1., 1.);
  return (std::acos(c) - c * std::sqrt(1. - c * c)) / glm::pi<double>();
}

TEST(LightTruth, ThePenumbraOfAHalfPlane) {
  constexpr float kHeight = 4.f, kEdge = 1.f, kRadius = 0.2f, kIntensity = 10.f;
  for (const LightKind kind : {LightKind::Spot, LightKind::Point})
    for (const Sampling& sampling : {kStandard, kFinal}) {
      scene::Scene scene;
      addSurface(scene);
      const auto floor = addRectangle(scene, {0, 0, 0}, {0.25f, 0, 0}, {0, 0, -0.25f});
      addRectangle(scene, {-2, kEdge, 0}, {2, 0, 0}, {0, 0, -2});
      scene::Light& light = addLight(scene, kind, {0, kHeight, 0}, {0, -1, 0});
      light.intensity = kIntensity;
      light.radius = kRadius;
      const auto truth = [&](dvec3 p, dvec3) {
        const dvec3 to = dvec3(0, kHeight, 0) - p;
        const double d = glm::length(to);
        // Of a sphere, the rim that is seen is tilted a little, which is left out.
        const double chord = p.x * (1. - kHeight / kEdge) / kRadius;
        return kIntensity * to.y / (d * d * d) * shareBeyond(chord);
      };
      const double full = kIntensity / (kHeight * kHeight);
      const Errors e = errorsOf(texelsOf(lit(scene, 100.f, sampling), floor), truth, full);
      EXPECT_LT(e.worst, sampling.positions > 1 ? 0.01 : 0.09);
      EXPECT_LT(e.rms, sampling.positions > 1 ? 0.003 : 0.03);
    }
}

// Two half-planes with a gap that shows a strip of the lamp, for most places one without any of the
// rim's points.
TEST(LightTruth, ALampThroughAGap) {
  constexpr float kHeight = 4.f, kEdge = 1.f, kRadius = 0.2f, kGap = 0.01f, kIntensity = 10.f;
  scene::Scene scene;
  addSurface(scene);
  const auto floor = addRectangle(scene, {0, 0, 0}, {0.25f, 0, 0}, {0, 0, -0.25f});
  addRectangle(scene, {-2 - 0.5f * kGap, kEdge, 0}, {2, 0, 0}, {0, 0, 2});
  addRectangle(scene, {2 + 0.5f * kGap, kEdge, 0}, {2, 0, 0}, {0, 0, 2});
  scene::Light& light = addLight(scene, LightKind::Spot, {0, kHeight, 0}, {0, -1, 0});
  light.intensity = kIntensity;
  light.radius = kRadius;
  const auto truth = [&](dvec3 p, dvec3) {
    const dvec3 to = dvec3(0, kHeight, 0) - p;
    const double d = glm::length(to);
    const auto chord = [&](double edge) {
      return (p.x + (edge - p.x) * kHeight / kEdge) / kRadius;
    };
    const double share = shareBeyond(chord(-0.5 * kGap)) - shareBeyond(chord(0.5 * kGap));
    return kIntensity * to.y / (d * d * d) * share;
  };
  const double full = kIntensity / (kHeight * kHeight);
  const Errors e = errorsOf(texelsOf(lit(scene, 100.f, kStandard), floor), truth, full);
  EXPECT_LT(e.worst, 0.1);  // the strip is up to an eighth of the light: two of the points
  EXPECT_LT(e.rms, 0.03);
  EXPECT_LT(std::abs(e.mean), 0.006);
}

// Lights without a size over a floor of 8 m.
struct Floor {
  scene::Scene scene;
  std::uint32_t floor;
  Floor() {
    addSurface(scene);
    floor = addRectangle(scene, {0, 0, 0}, {4, 0, 0}, {0, 0, -4});
  }
  Errors errors(const Truth& truth) const {
    Sampling sampling = kStandard;
    sampling.finePositions = 0;  // the truth is that of the middle
    return errorsOf(texelsOf(lit(scene, 4.f, sampling), floor), truth);
  }
};

TEST(LightTruth, APointLightByItsAttenuationAndWindow) {
  Floor floor;
  scene::Light& light = addLight(floor.scene, LightKind::Point, {1, 2, 0.5f}, {0, -1, 0});
  light.intensity = 3.f;
  light.attenuation = {0.5f, 0.25f, 0.125f};
  light.range = 4.f;
  const Errors e = floor.errors([](dvec3 p, dvec3) {
    const double d = glm::distance(p, dvec3(1, 2, 0.5));
    const double window = std::max(1. - std::pow(d / 4., 4), 0.);
    return d >= 4. ? 0. : 3. * 2. / d * window * window / (0.5 + 0.25 * d + 0.125 * d * d);
  });
  EXPECT_LT(e.worst, 1e-3);
}

TEST(LightTruth, ASpotLightByItsConeAndExponent) {
  for (const float exponent : {0.f, 1.f, 7.f}) {
    Floor floor;
    const vec3 along = glm::normalize(vec3(0.3f, -1, 0.1f));
    scene::Light& light = addLight(floor.scene, LightKind::Spot, {0, 2, 0}, along);
    light.intensity = 5.f;
    light.innerCone = 0.5f;
    light.outerCone = 0.9f;
    light.exponent = exponent;
    const Errors e = floor.errors([&](dvec3 p, dvec3) {
      const dvec3 way = p - dvec3(0, 2, 0);
      const double d = glm::length(way), c = glm::dot(way / d, dvec3(along));
      if (c <= std::cos(0.9f)) return 0.;
      const double ramp = std::min((c - std::cos(0.9)) / (std::cos(0.5) - std::cos(0.9)), 1.);
      return 5. * ramp * ramp * std::pow(c, static_cast<double>(exponent)) * 2. / (d * d * d);
    });
    EXPECT_LT(e.worst, 2e-2);  // at the cone's edge, where next to nothing is left
    EXPECT_LT(e.rms, 1e-3);
  }
}

// However wide its cone, as long as all of it is above the horizon.
TEST(LightTruth, ADirectionalLightByItsCosine) {
  for (const float angle : {0.f, 0.01f, 0.5f, 1.5f}) {
    Floor floor;
    const vec3 along = glm::normalize(vec3(0.5f, -1, 0));
    scene::Light& light = addLight(floor.scene, LightKind::Directional, {0, 2, 0}, along);
    light.intensity = 5.f;
    light.angle = angle;
    // Something in the way, so that it is sampled, but not of the rays.
    addRectangle(floor.scene, {0, 50, 0}, {0.01f, 0, 0}, {0, 0, -0.01f});
    const Errors e = floor.errors([&](dvec3, dvec3) { return 5. * -double{along.y}; });
    EXPECT_LT(e.worst, 1e-5) << angle << ' ' << e.mean;
  }
}

// A lamp's own mesh within its radius throws no shadow.
TEST(LightTruth, ASphereShinesFromItsSurface) {
  Floor floor;
  scene::Light& light = addLight(floor.scene, LightKind::Point, {0, 2, 0}, {0, -1, 0});
  light.intensity = 5.f;
  light.radius = 0.2f;
  for (const float y : {1.9f, 2.1f})
    addRectangle(floor.scene, {0, y, 0}, {0.1f, 0, 0}, {0, 0, 0.1f});
  const auto all = lit(floor.scene, 4.f, kStandard);
  const Errors e = errorsOf(texelsOf(all, floor.floor), [](dvec3 p, dvec3) {
    const double d = glm::distance(p, dvec3(0, 2, 0));
    return 5. * 2. / (d * d * d);
  });
  EXPECT_LT(e.worst, 1e-3);
}

// Their lamps are spheres in bulbs of the same size: what faces the middle of a tile nearby is
// behind the bulb for its ends.
TEST(LightTruth, LampsInBulbsAreAsBrightAtAllPresets) {
  auto scene = scene::loadScene("builtin:mirrors");
  ASSERT_TRUE(scene) << scene.error().message;
  scene::animate(*scene, 0.f);
  const auto mean = [&](const Sampling& sampling, Engine engine) {
    Plan plan = planOf(*scene, {.density = 4.f, .sampling = sampling});
    plan.settings.engine = engine;
    double sum = 0.;
    const auto texels = lightSome(plan, 1);
    for (const LitTexel& t : texels) sum += t.irradiance.x + t.irradiance.y + t.irradiance.z;
    return sum / (3. * static_cast<double>(texels.size()));
  };
  const double wanted = mean(kFinal, Engine::Embree);
  EXPECT_GT(wanted, 0.1);
  EXPECT_NEAR(mean(kStandard, Engine::Embree) / wanted, 1., 0.05);
  EXPECT_NEAR(mean(kStandard, Engine::Octree) / wanted, 1., 0.05);
}

}  // namespace
}  // namespace lucerna::bake
