// The sky beside a long wall, where how much of it a floor sees has a closed form, and beside
// posts.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>

#include "bake/light_scenes.hpp"
#include "bake/light_set.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;

constexpr float kHeight = 2.f;     // m, of the wall
constexpr float kFloor = 3.f;      // m, half of the floor's sides
constexpr float kHalfWall = 2e3f;  // m, of its length

// A floor and, 0.2 m beyond one side of it, a wall that takes no light; both turned.
scene::Scene floorAtWall(float turn) {
  const vec3 x(std::cos(turn), 0.f, std::sin(turn)), z(-x.z, 0.f, x.x), y(0, 1, 0);
  scene::Scene scene = trace::testing::emptyScene();
  addSurface(scene);
  addRectangle(scene, vec3(0), kFloor * z, kFloor * x);
  addSurface(scene).model = scene::MaterialModel::Unlit;
  addRectangle(scene, -(kFloor + 0.2f) * x + 0.5f * kHeight * y, kHalfWall * z, 0.5f * kHeight * y);
  return scene;
}

// Of an even sky of radiance 1 / pi: pi / 2 (1 + cos of the elevation of the wall's top).
float truthAt(vec3 placeW, float turn) {
  const float off = placeW.x * std::cos(turn) + placeW.z * std::sin(turn) + kFloor + 0.2f;
  return 0.5f * (1.f + off / std::sqrt(off * off + kHeight * kHeight));
}

// As lights without a size.
Plan hardened(Plan plan) {
  for (scene::PlacedLight& light : plan.groups[0].lights) light.angle = 0.f;
  return plan;
}

struct SkyErrors {
  double rms = 0., worst = 0., step = 0.;  // step: between neighbours along the wall's normal
};

SkyErrors errorsOf(const Sampling& sampling, bool hard, float density) {
  SkyErrors errors;
  std::size_t count = 0;
  for (const float turn : {0.f, 0.4f, 1.1f, 2.7f}) {
    const scene::Scene scene = floorAtWall(turn);
    BakeSettings settings;
    settings.density = density;
    settings.sampling = sampling;
    settings.sky = vec3(1.f / kPi);
    Result<Plan> plan = makePlan(scene, settings);
    EXPECT_TRUE(plan) << plan.error().message;
    std::map<std::pair<int, int>, double> off;
    for (const LitTexel& texel : texelsOf(lightAll(hard ? hardened(*plan) : *plan), 0)) {
      double truth = 0.;
      for (const vec3 place : texel.placesW) truth += truthAt(place, turn);
      const double e = texel.irradiance.x - truth / static_cast<double>(texel.placesW.size());
      off[{texel.texel.x, texel.texel.y}] = e;
      errors.rms += e * e;
      errors.worst = std::max(errors.worst, std::abs(e));
      ++count;
    }
    for (const auto& [at, e] : off)
      for (const auto& next :
           {std::pair(at.first + 1, at.second), std::pair(at.first, at.second + 1)})
        if (const auto found = off.find(next); found != off.end())
          errors.step = std::max(errors.step, std::abs(found->second - e));
  }
  errors.rms = std::sqrt(errors.rms / static_cast<double>(count));
  return errors;
}

TEST(Sky, IsEvenBesideAWall) {
  Sampling before = kStandard;
  before.skyDirections = 256;
  const SkyErrors hard = errorsOf(before, true, 5.f);
  EXPECT_GT(hard.step, 0.03);  // stripes: 1 / 255 is 0.004
  EXPECT_GT(hard.rms, 0.007);
  const SkyErrors preview = errorsOf(kPreview, false, 5.f);
  EXPECT_LT(preview.step, 0.017);
  EXPECT_LT(preview.rms, 0.005);
  const SkyErrors standard = errorsOf(kStandard, false, 5.f);
  EXPECT_LT(standard.step, 0.0065);
  EXPECT_LT(standard.rms, 0.002);
  const SkyErrors final = errorsOf(kFinal, false, 5.f);
  EXPECT_LT(final.step, 0.0035);
  EXPECT_LT(final.rms, 0.001);
}

// What the first points of a direction may all miss; against very many directions without a size.
TEST(Sky, SeesPosts) {
  scene::Scene scene = trace::testing::emptyScene();
  addSurface(scene);
  addRectangle(scene, vec3(0), vec3(0, 0, 2), vec3(2, 0, 0));
  addSurface(scene).model = scene::MaterialModel::Unlit;
  scene.materials.back().doubleSided = true;
  const vec3 up(0, 1, 0), x(0.08f, 0, 0.03f), z(-0.03f, 0, 0.08f);
  for (const vec3 foot : {vec3(-1, 0, -1), vec3(0.7f, 0, -0.2f), vec3(-0.3f, 0, 1.2f)}) {
    addRectangle(scene, foot + 1.5f * up, 1.5f * up, x);
    addRectangle(scene, foot + 1.5f * up, 1.5f * up, z);
  }
  BakeSettings settings;
  settings.density = 8.f;
  settings.sky = vec3(1.f / kPi);
  settings.sampling.skyDirections = 16384;
  const Result<Plan> many = makePlan(scene, settings);
  ASSERT_TRUE(many);
  const auto truth = texelsOf(lightAll(hardened(*many)), 0);
  const auto rms = [&](int directions, int points, bool hard) {
    settings.sampling.skyDirections = directions;
    settings.sampling.skyPoints = points;
    const Result<Plan> plan = makePlan(scene, settings);
    EXPECT_TRUE(plan);
    const auto found = texelsOf(lightAll(hard ? hardened(*plan) : *plan), 0);
    double sum = 0.;
    for (std::size_t i = 0; i < truth.size(); ++i)
      sum += std::pow(found[i].irradiance.x - truth[i].irradiance.x, 2.);
    return std::sqrt(sum / static_cast<double>(truth.size()));
  };
  const double before = rms(256, 2, true);
  const double preview = rms(kPreview.skyDirections, kPreview.skyPoints, false);
  const double standard = rms(kStandard.skyDirections, kStandard.skyPoints, false);
  fmt::print("rms beside posts: {:.4f} before, {:.4f} preview, {:.4f} standard\n", before, preview,
             standard);
  EXPECT_LT(standard, 0.5 * before);
  EXPECT_LT(preview, before);
}

// Of docs/dev/baking.md.
TEST(Sky, DISABLED_Figures) {
  const auto show = [](const char* name, Sampling s, bool hard, int n, int k) {
    s.skyDirections = n;
    s.skyPoints = k;
    const auto start = std::chrono::steady_clock::now();
    const SkyErrors e = errorsOf(s, hard, 5.f);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    fmt::print("{:10} {:5} x {:3}: rms {:.4f} worst {:.4f} step {:.4f}  {:.2f} s\n", name, n, k,
               e.rms, e.worst, e.step, took.count());
  };
  for (const int n : {64, 256, 1024}) show("hard", kStandard, true, n, 2);
  for (const int n : {64, 128, 256})
    for (const int k : {8, 16, 32}) show("soft", kStandard, false, n, k);
  show("hard final", kFinal, true, 256, 2);
  for (const int n : {128, 256, 1024})
    for (const int k : {2, 4}) show("soft final", kFinal, false, n, k);
}

}  // namespace
}  // namespace lucerna::bake
