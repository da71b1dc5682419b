// Direct light of single texels by the plainest way there is, for the tests of bake/: random places
// on the texel, random points on every light, one ray for each pair. Shares no sampling, culling or
// tracing with the baker; light in trace/light_sampling.hpp and rays in trace/ray_scene.hpp.
#pragma once

#include "bake/plan.hpp"
#include "trace/ray_scene.hpp"

namespace lucerna::bake::testing {

class BruteForce {
 public:
  // The plan outlives it.
  explicit BruteForce(const Plan& plan);
  // Mean irradiance over what the chart covers of the texel, of all lights and, without a limit of
  // their reach, emitting triangles. samples: places, a power of two.
  vec3 irradiance(std::uint32_t chart, ivec2 texel, std::uint32_t samples) const;

 private:
  struct Place {
    vec3 positionW{0.f}, normalW{0.f};
  };
  struct Emitter {
    std::uint32_t object = 0, triangle = 0;
    std::array<vec3, 3> corners;
    vec3 normalW{0.f};
    float area = 0.f;
    bool doubleSided = false;
  };
  std::vector<Place> placesOn(std::uint32_t chart, ivec2 texel, std::uint32_t samples) const;
  vec3 sumOf(const std::vector<Place>& places, const scene::PlacedLight& light,
             std::uint32_t seed) const;
  vec3 sumOf(const std::vector<Place>& places, const Emitter& emitter, std::uint32_t seed) const;
  vec3 traced(const std::vector<trace::Ray>& rays, const std::vector<vec3>& values) const;

  const Plan& plan_;
  trace::RayScene rays_;
  std::vector<Emitter> emitters_;
};

}  // namespace lucerna::bake::testing
