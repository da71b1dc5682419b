// The Embree tracer on the rays of whole scenes, and that the count would tell if it were wrong.
#include <gtest/gtest.h>

#include "bake/light_scenes.hpp"
#include "bake/visibility_check.hpp"
#include "scene/load.hpp"

namespace lucerna::bake {
namespace {

constexpr std::size_t kPairs = 1'000'000;

struct Made {
  std::unique_ptr<scene::Scene> scene;
  Plan plan;
  std::vector<scene::PlacedLight> lights;
};

Made make(const char* name, float density) {
  Made made{
      .scene = std::make_unique<scene::Scene>(*scene::loadScene(name)), .plan = {}, .lights = {}};
  for (scene::Material& material : made.scene->materials)
    material.alphaMode = scene::AlphaMode::Opaque;
  made.plan = testing::planOf(*made.scene, {.density = density});
  for (const LightGroup& group : made.plan.groups)
    made.lights.insert(made.lights.end(), group.lights.begin(), group.lights.end());
  return made;
}

// At most one in a million.
TEST(Visibility, NightCity) {
  const Made made = make("builtin:nightcity", 1.75f);
  const auto found =
      testing::checkVisibility(made.plan, *makeEmbreeTracer(made.plan.world), made.lights, kPairs);
  EXPECT_GT(found.blocked, found.pairs / 4);
  EXPECT_LT(found.blocked, found.pairs);
  EXPECT_LE(found.wrong, found.pairs / 1'000'000) << found.atEdges << " at edges";
}

TEST(Visibility, Atrium) {
  const Made made = make("builtin:atrium", 20.f);
  const auto found =
      testing::checkVisibility(made.plan, *makeEmbreeTracer(made.plan.world), made.lights, kPairs);
  EXPECT_GT(found.blocked, found.pairs / 4);
  EXPECT_LE(found.wrong, found.pairs / 1'000'000) << found.atEdges << " at edges";
}

// Wrong about one ray in a hundred thousand.
class Careless final : public ShadowTracer {
 public:
  explicit Careless(const World& world) : tracer_(makeEmbreeTracer(world)) {}
  void trace(const ShadowRays& rays, std::span<vec3> shares) const override {
    tracer_->trace(rays, shares);
    for (vec3& share : shares)
      if (++asked_ % 100'000 == 0) share = share == vec3(0.f) ? vec3(1.f) : vec3(0.f);
  }

 private:
  std::unique_ptr<ShadowTracer> tracer_;
  mutable std::size_t asked_ = 0;
};

// Sees from a hundredth of a texel away (0.5 mm of 5 cm).
class Displaced final : public ShadowTracer {
 public:
  explicit Displaced(const World& world) : tracer_(makeEmbreeTracer(world)) {}
  void trace(const ShadowRays& rays, std::span<vec3> shares) const override {
    ShadowRays moved = rays;
    for (float& x : moved.toX) x += 5e-4f;
    tracer_->trace(moved, shares);
  }

 private:
  std::unique_ptr<ShadowTracer> tracer_;
};

TEST(Visibility, TheCountTellsOfErrors) {
  const Made made = make("builtin:atrium", 20.f);
  const auto careless =
      testing::checkVisibility(made.plan, Careless(made.plan.world), made.lights, kPairs);
  EXPECT_GE(careless.wrong + careless.atEdges, 9u);
  EXPECT_GT(careless.wrong, careless.pairs / 1'000'000);
  const auto displaced =
      testing::checkVisibility(made.plan, Displaced(made.plan.world), made.lights, kPairs);
  EXPECT_GT(displaced.wrong, displaced.pairs / 1'000'000);
}

}  // namespace
}  // namespace lucerna::bake
