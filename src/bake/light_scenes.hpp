// Scenes lit by the baker's own stages, texel by texel, for the tests of bake/.
#pragma once

#include <vector>

#include "bake/plan.hpp"
#include "scene/scene.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::bake::testing {

struct LitTexel {
  std::uint32_t object = 0;                     // of the scene's
  std::uint32_t chart = 0;                      // of the plan's
  ivec2 texel{0};                               // of the chart
  vec3 positionW{0.f}, normalW{0.f, 1.f, 0.f};  // means of its samples, the normal unit
  std::vector<vec3> placesW{};                  // of its samples
  bool border = false;                          // the chart does not cover all of it
  vec3 irradiance{0.f};
};

struct LightOptions {
  float density = 10.f;  // texels a metre
  Sampling sampling = kStandard;
  float faintest = 0.f;  // as BakeSettings
  Unwrap unwrap = Unwrap::Charts;
};

// A plan that must succeed. The scene outlives it.
Plan planOf(const scene::Scene& scene, const LightOptions& options);

// All lights of all groups, in single precision: what files round is left out.
std::vector<LitTexel> lightAll(const Plan& plan);
// Of every `step`-th block.
std::vector<LitTexel> lightSome(const Plan& plan, std::size_t step);

// Those of one object.
std::vector<LitTexel> texelsOf(const std::vector<LitTexel>& all, std::uint32_t object);

// A rectangle of one object: corners center +- a +- b, its front where cross(a, b) points.
// Material: the last. Gives the object's place.
std::uint32_t addRectangle(scene::Scene& scene, vec3 center, vec3 a, vec3 b);
// White, Lambertian, one-sided; emits the radiance.
scene::Material& addSurface(scene::Scene& scene, vec3 radiance = vec3(0.f));
using trace::testing::addLight;

}  // namespace lucerna::bake::testing
