// Direct light of a group of lights on the samples of a block.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/light_set.hpp"
#include "bake/occluders.hpp"
#include "bake/samples.hpp"
#include "bake/shadow_tracer.hpp"

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

// One thread's.
class BlockLighter {
 public:
  // lightSamples: points on each light that has a size, where the first four do not agree on what
  // they see; an even number squared, or 1: its middle. Tracer and occluders outlive it.
  BlockLighter(const ShadowTracer& tracer, const Occluders& occluders, int lightSamples,
               float sceneDiagonal);

  // Adds the mean irradiance (scene/light.hpp) to each texel of the block: row by row.
  void light(const Samples& samples, std::span<const scene::PlacedLight> lights,
             std::span<vec3> texels);

  LightCounters counters;

 private:
  bool mayLight(const Samples& samples, const scene::PlacedLight& light) const;
  bool isClear(const Samples& samples, const scene::PlacedLight& light) const;
  void lightBy(const Samples& samples, const scene::PlacedLight& light);
  void addPoint(const Samples& samples, const scene::PlacedLight& point, bool clear,
                std::span<const std::uint32_t> among);
  void shade(const Samples& samples, const scene::PlacedLight& point);
  void collect(const Samples& samples, const scene::PlacedLight& point,
               std::span<const std::uint32_t> among);

  const ShadowTracer& tracer_;
  const Occluders& occluders_;
  int lightSamples_;
  float sceneDiagonal_;  // m
  // Of one point of a light:
  std::vector<float> weights_;      // of its intensity that each sample gets, before shadows
  std::vector<std::uint32_t> lit_;  // samples that it may light
  ShadowRays rays_;                 // to those
  std::vector<vec3> shares_;        // of the light that they let through
  // Of a light, one a sample:
  std::vector<vec3> light_;
  std::vector<float> seen_;          // of the points asked
  std::vector<std::uint8_t> asked_;  // points
  std::vector<std::uint32_t> unsure_;
  // Of all lights, one a sample:
  std::vector<vec3> sums_;
};

}  // namespace lucerna::bake
