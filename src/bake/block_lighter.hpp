// Direct light of a group of lights on the samples of a block.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/emitters.hpp"
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

struct LighterSettings {
  // Points on each light that has a size, where the first few do not agree on what they see; 1: its
  // middle alone. Each place of a texel's pattern has points of its own.
  int lightSamples = 16;
  // Largest size of emitting surface that one ray stands for, as a share of its distance.
  float emitterSize = 0.25f;
  // A texel is uneven where its samples deviate by more than this share of its light.
  float uneven = 0.05f;
  float sceneDiagonal = 1.f;  // m
};

// A point of a light.
struct LightPoint {
  scene::PlacedLight light;  // as if it had no size and stood there
  vec3 centreW{0.f};         // of the light: distances count from there
  float ahead = 0.f;         // m from the point to the light's surface, towards what is lit
};

// What a texel has got of one light, whose shadow's edge crosses it.
struct UnevenTexel {
  static constexpr std::uint32_t kEmitters = 0xffffffffu;
  std::uint32_t light = 0;  // place in the list; kEmitters: all emitting surfaces
  std::uint16_t texel = 0;
  vec3 irradiance{0.f};
  float deviation = 0.f;  // of its samples' brightness from their mean, root mean square
};

// One thread's.
class BlockLighter {
 public:
  // Tracer, occluders and emitters outlive it.
  BlockLighter(const ShadowTracer& tracer, const Occluders& occluders, const Emitters& emitters,
               const LighterSettings& settings, const scene::Scene& scene);

  // The mean irradiance (scene/light.hpp) of each texel of the block, row by row; of emitting
  // surfaces only if `emitters` is set. False, and nothing is written: nothing reaches the block.
  // uneven: if it is not null, the texels that shadows' edges cross, light by light.
  bool light(const Samples& samples, std::span<const scene::PlacedLight> lights, bool emitters,
             std::vector<vec3>& texels, std::vector<UnevenTexel>* uneven);

  // Puts what these samples get in the place of what those texels have got, each of its light.
  void relight(const Samples& samples, std::span<const scene::PlacedLight> lights,
               std::span<const UnevenTexel> uneven, std::vector<vec3>& texels);

  LightCounters counters;

 private:
  using Tile = Samples::Tile;  // a range of samples
  class Disc;

  bool mayLight(const Samples& samples, const scene::PlacedLight& light) const;
  bool isClear(const Samples& samples, const scene::PlacedLight& light) const;
  void lightBy(const Samples& samples, const scene::PlacedLight& light);
  void lightByAllEmitters(const Samples& samples);
  void addMeans(const Samples& samples, std::vector<vec3>& texels) const;
  void findUneven(const Samples& samples, std::uint32_t light, std::vector<UnevenTexel>& uneven,
                  std::vector<vec3>& texels);
  void dropEven(std::span<const vec3> texels, std::vector<UnevenTexel>& uneven) const;
  void lightBySized(const Samples& samples, const Tile& tile, const scene::PlacedLight& light,
                    bool clear);
  void gather(const Samples& samples);
  template <typename PointOf>
  void ask(const Disc& disc, const PointOf& pointOf);
  void dropSure(const Samples& samples, bool byTexel);
  void traceSized(const Samples& samples, const Tile& tile, const scene::PlacedLight& light);
  void shade(const Samples& samples, const LightPoint& point, Tile range);
  void collect(const Samples& samples, const LightPoint& point, Tile range);
  void collectOfSphere(const Samples& samples, const scene::PlacedLight& sphere, vec2 p,
                       Tile range);
  void setRay(std::size_t i, vec3 from, vec3 to);
  void traceCollected();

  // Emitting surfaces, tile by tile.
  bool mayLight(const Samples& samples, const Tile& tile, const EmitterNode& node) const;
  void findNodes(const Samples& samples);
  void lightByEmitters(const Samples& samples, const Tile& tile);
  void lightByNode(const Samples& samples, const Tile& tile, const EmitterNode& node,
                   float distance);
  void lightByCell(const Samples& samples, const Tile& tile, const EmitterNode& cell, int split);
  void shadeEmission(const Samples& samples, const Emission& emission, float reach, Tile range);
  template <typename FindOrigins>
  void addEmission(const Samples& samples, const Tile& tile, const Emission& emission, float reach,
                   bool corrected, const FindOrigins& findOrigins);
  void findPoints(const Samples& samples, std::uint32_t emitter);
  vec3 pointOf(std::uint32_t node, vec2 u) const;
  void moveOrigins(const Samples& samples, std::size_t first);
  void flush();

  const ShadowTracer& tracer_;
  const Occluders& occluders_;
  const Emitters& emitters_;
  LighterSettings settings_;
  const scene::Scene& scene_;
  // Of one point of a light:
  std::vector<float> weights_;      // of its intensity that each sample gets, before shadows
  std::vector<float> corrections_;  // of a cell's points: factors of weights_
  // Of the rays that are to be traced together:
  std::vector<std::uint32_t> lit_;  // samples that they lead to
  std::vector<vec3> values_;        // what these get if nothing is in the way; of emitters
  ShadowRays rays_;
  std::vector<vec3> shares_;                  // of the light that they let through
  std::vector<std::uint32_t> stack_, found_;  // nodes of emitters
  std::vector<vec2> pattern_, points_;        // findPoints()
  std::vector<vec3> origins_;  // of the emitter under way: a point of it for each place
  // Of a light with a size, one a sample:
  std::vector<float> full_;   // weights where nothing is in the way
  std::vector<vec3> seen_;    // weights times shares, of the points that are asked
  std::vector<float> asked_;  // their weights
  // Samples whose share is not known, place by place of the pattern.
  std::vector<std::uint32_t> unsure_;
  struct Asked {
    std::uint16_t place = 0;
    Tile range;
  };
  std::vector<Asked> places_;
  Samples gathered_;                   // where they are
  std::vector<std::uint8_t> answers_;  // of each texel
  // Of all lights, or of the one under way, one a sample:
  std::vector<vec3> sums_;
  Samples part_;             // of those that are lit again
  std::vector<bool> relit_;  // texels
};

}  // namespace lucerna::bake
