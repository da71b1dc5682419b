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
  // Points on each light that has a size, where the first few do not agree on what they see; 1: its
  // middle alone. Each place of a texel's pattern has points of its own.
  int lightSamples = 16;
  int skyPoints = 16;  // the same on each of the sky's lights (skyLights())
  // From each place of a texel that is lit again, one of so many of these points: all places'
  // points are one even set.
  int shared = 1;
  // Largest size of emitting surface that one ray stands for, as a share of its distance.
  float emitterSize = 0.25f;
  // Of a texel's light that one ray to an emitting surface stands for, of texels of one place.
  float emitterShare = 1.f;
  // A texel is uneven where its samples deviate by more than this share of its light.
  float uneven = 0.05f;
  float sceneDiagonal = 1.f;  // m
  Aabb sceneBoxW;             // of all that may be in the way
};

// What a texel has got of one light, whose shadow's edge crosses it.
struct UnevenTexel {
  static constexpr std::uint32_t kEmitters = 0xffffffffu;
  std::uint32_t light = 0;  // place in the list; kEmitters: all emitting surfaces
  std::uint16_t texel = 0;
  vec3 irradiance{0.f};
  float deviation = 0.f;  // of its samples' brightness from their mean, root mean square; of one
                          // sample, an estimate
};
struct Uneven {
  // Of the texels beside the block, where a texel has one place: what each is compared with are its
  // neighbours. Of texels of several places, null.
  const Samples* around = nullptr;
  std::vector<UnevenTexel> texels;  // light by light
};

// One thread's.
class Lighter {
 public:
  virtual ~Lighter() = default;

  // The mean irradiance (scene/light.hpp) of each texel of the block, row by row; of emitting
  // surfaces only if `emitters` is set. False, and nothing is written: nothing reaches the block.
  // uneven: if it is not null, finds the texels that shadows' edges cross.
  virtual bool light(const Samples& samples, std::span<const scene::PlacedLight> lights,
                     bool emitters, std::vector<vec3>& texels, Uneven* uneven) = 0;

  // Puts what these samples get in the place of what those texels have got, each of its light.
  void relight(const Samples& samples, std::span<const scene::PlacedLight> lights,
               std::span<const UnevenTexel> uneven, std::vector<vec3>& texels);

  LightCounters counters;

 protected:
  explicit Lighter(const LighterSettings& settings) : settings_(settings) {}

  // Adds to sums_ what one light of the list, or UnevenTexel::kEmitters, gives other samples than
  // light() got.
  virtual void lightAgain(const Samples& samples, std::span<const scene::PlacedLight> lights,
                          std::uint32_t light) = 0;
  // How many points stand for the light, from each place.
  int pointsOf(const scene::PlacedLight& light) const;
  bool sharesPoints() const { return again_ && settings_.shared > 1; }
  void addMeans(const Samples& samples, std::vector<vec3>& texels) const;
  // Of one light, which sums_ has: adds the texels' means, and starts sums_ again.
  void findUneven(const Samples& samples, std::span<const scene::PlacedLight> lights,
                  std::uint32_t light, Uneven& uneven, std::vector<vec3>& texels);
  // Drops those that deviate little, compared with all light of the texel.
  void dropEven(std::span<const vec3> texels, std::vector<UnevenTexel>& uneven) const;

  LighterSettings settings_;
  std::vector<vec3> sums_;  // of all lights, or of the one under way, one a sample

 private:
  void findUnevenPlaces(const Samples& samples, std::uint32_t light,
                        std::vector<UnevenTexel>& uneven);
  void findEdges(const Samples& samples, std::span<const scene::PlacedLight> lights,
                 std::uint32_t light, Uneven& uneven);

  bool again_ = false;       // texels are lit again
  std::vector<vec3> own_;    // sums_ of the block, while others are lit
  std::vector<float> grid_;  // brightness of the texels of the block and around it; < 0: no sample
  Samples part_;             // of those that are lit again
  std::vector<bool> relit_;  // texels
};

}  // namespace lucerna::bake
