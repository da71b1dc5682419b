// Direct light of single texels by the plainest way there is, for the tests of bake/: random places
// on the texel, for each of them random points on every light, one ray for each point. Shares no
// sampling, culling or tracing with the baker; light in trace/light_sampling.hpp and rays in
// trace/ray_scene.hpp.
#pragma once

#include "bake/plan.hpp"
#include "trace/ray_scene.hpp"

namespace lucerna::bake::testing {

// How hard the truth is looked for.
struct Effort {
  std::uint32_t places = 256;  // on a texel, a power of two
  std::uint32_t points = 64;   // on a light with a size, for each place, a power of two
  // Emitting triangles are cut in four until a piece is this share of its distance in size, and get
  // one point a piece; those that are smaller by themselves, from fewer places.
  float pieceSize = 0.25f;
  std::uint32_t seed = 0;  // another one: other places and points
};

class BruteForce {
 public:
  // The plan outlives it.
  explicit BruteForce(const Plan& plan);
  // Mean irradiance over what the chart covers of the texel, of all lights and, without a limit of
  // their reach, emitting triangles.
  vec3 irradiance(std::uint32_t chart, ivec2 texel, const Effort& effort) const;

 private:
  using Corners = std::array<vec3, 3>;
  struct Place {
    vec3 positionW{0.f}, normalW{0.f};
  };
  struct Emitter {
    std::uint32_t object = 0, triangle = 0;
    Corners corners;
    vec3 normalW{0.f};
    bool doubleSided = false;
  };
  // Rays under way and what each brings if nothing is in the way.
  struct Rays {
    std::vector<trace::Ray> rays;
    std::vector<vec3> values;
    glm::dvec3 sum{0.};  // of those that were traced
    void add(const Place& place, vec3 direction, float far, vec3 value);
  };
  std::vector<Place> placesOn(std::uint32_t chart, ivec2 texel, const Effort& effort) const;
  void add(Rays& rays, const Place& place, const scene::PlacedLight& light, std::uint32_t first,
           std::uint32_t points, std::uint32_t seed) const;
  void add(Rays& rays, const std::vector<Place>& places, const Emitter& emitter,
           const Effort& effort, std::uint32_t seed) const;
  void trace(Rays& rays) const;

  const Plan& plan_;
  trace::RayScene rays_;
  std::vector<Emitter> emitters_;
};

}  // namespace lucerna::bake::testing
