// Direct light of a group of lights on the samples of a block: what both engines have in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/samples.hpp"
#include "scene/light.hpp"

namespace lucerna::bake {

struct LightCounters {
  std::uint64_t pairs = 0;  // of a light point and a sample that it may light: none was traced if
                            // nothing could be in the way
  std::uint64_t rays = 0;
  double shadingSeconds = 0., tracingSeconds = 0.;  // of all threads

  void add(const LightCounters& other) {
    pairs += other.pairs;
    rays += other.rays;
    shadingSeconds += other.shadingSeconds;
    tracingSeconds += other.tracingSeconds;
  }
};

struct LighterSettings {
  // Points on each light that has a size, where eight on its rim do not agree on what they see; 1:
  // its middle alone.
  int lightSamples = 16;
  // Largest size of emitting surface that one ray stands for, as a share of its distance.
  float emitterSize = 0.25f;
  float sceneDiagonal = 1.f;  // m
  Aabb sceneBoxW;             // of all that may be in the way
};

// One thread's.
class Lighter {
 public:
  virtual ~Lighter() = default;

  // The mean irradiance (scene/light.hpp) of each texel of the block, row by row; of emitting
  // surfaces only if `emitters` is set. False, and nothing is written: nothing reaches the block.
  virtual bool light(const Samples& samples, std::span<const scene::PlacedLight> lights,
                     bool emitters, std::vector<vec3>& texels) = 0;

  // Of the block that was lit last, texels whose samples differ by more than this share of their
  // mean: shadows' edges. As `texels` above.
  std::vector<bool> unevenTexels(const Samples& samples, float share, std::size_t texels) const;

  LightCounters counters;

 protected:
  // sums_ as texels.
  void meansOf(const Samples& samples, std::vector<vec3>& texels) const;

  std::vector<vec3> sums_;  // of all lights, one a sample
};

}  // namespace lucerna::bake
