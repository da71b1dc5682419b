// Direct light on the samples of a block, by engine `embree`: whole tiles at once, and nothing
// asked of what cannot light them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/emitters.hpp"
#include "bake/light_points.hpp"
#include "bake/lighter.hpp"
#include "bake/occluders.hpp"
#include "bake/shadow_tracer.hpp"

namespace lucerna::bake {

// One thread's.
class BlockLighter final : public Lighter {
 public:
  // Tracer, occluders and emitters outlive it.
  BlockLighter(const ShadowTracer& tracer, const Occluders& occluders, const Emitters& emitters,
               const LighterSettings& settings, const scene::Scene& scene);

  bool light(const Samples& samples, std::span<const scene::PlacedLight> lights, bool emitters,
             std::vector<vec3>& texels, Uneven* uneven) override;

 private:
  using Tile = Samples::Tile;                     // a range of samples
  static constexpr std::size_t kMostRays = 4096;  // that gather before they are traced

  void lightAgain(const Samples& samples, std::span<const scene::PlacedLight> lights,
                  std::uint32_t light) override;
  bool mayLight(const Samples& samples, const scene::PlacedLight& light) const;
  bool isClear(const Samples& samples, const scene::PlacedLight& light) const;
  void lightBy(const Samples& samples, const scene::PlacedLight& light);
  void lightBySized(const Samples& samples, const Tile& tile, const scene::PlacedLight& light,
                    bool clear);
  void gather(const Samples& samples);
  template <typename PointOf>
  void ask(const scene::PlacedLight& light, const Disc& disc, const PointOf& pointOf);
  void countAnswers();
  void dropSure(const Samples& samples, bool byTexel);
  void findBeside(const Samples& samples, const Tile& tile);
  void traceSized(const Samples& samples, const Tile& tile, const scene::PlacedLight& light);
  void shade(const Samples& samples, const LightPoint& point, Tile range);
  void collect(const Samples& samples, const LightPoint& point, Tile range);
  void collectOfSphere(const Samples& samples, const scene::PlacedLight& sphere, vec2 p,
                       Tile range);
  void setRay(std::size_t i, vec3 from, vec3 to);
  void trace();
  void forgetRays();

  // Emitting surfaces, tile by tile.
  bool mayLight(const Samples& samples, const Tile& tile, const EmitterNode& node) const;
  void findNodes(const Samples& samples);
  void lightByEmitters(const Samples& samples, const Tile& tile);
  void lightByAllEmitters(const Samples& samples);
  void lightByNode(const Samples& samples, const Tile& tile, const EmitterNode& node,
                   std::uint32_t seed, float mostOfAll, float distance);
  void lightByHalves(const Samples& samples, const Tile& tile, const EmitterNode& cell,
                     std::uint32_t seed, float most, float distance);
  // Whether nodes that give much are cut: places of texels with several see other points anyway.
  bool splits(const Samples& samples) const {
    return samples.perTexel == 1 && settings_.emitterShare < 1.f;
  }
  float mostOf(float most, float distance) const;
  float givesTo(const Samples& samples, const Tile& tile, const EmitterNode& node) const;
  template <typename What>
  void cut(const Samples& samples, const Tile& tile, std::span<const std::uint32_t> roots,
           float most, const What& what);
  void lightByCell(const Samples& samples, const Tile& tile, const EmitterNode& cell,
                   std::uint32_t seed, ivec2 split);
  void shadeEmission(const Samples& samples, const Emission& emission, float reach, Tile range);
  template <typename FindOrigins>
  void addEmission(const Samples& samples, const Tile& tile, const Emission& emission, float reach,
                   bool corrected, const FindOrigins& findOrigins);
  void findPoints(const Samples& samples, std::uint32_t seed);
  vec3 pointOf(const EmitterNode& node, vec2 u) const;
  void moveOrigins(const Samples& samples, std::size_t first);
  void flush();

  const ShadowTracer& tracer_;
  const Occluders& occluders_;
  const Emitters& emitters_;
  const scene::Scene& scene_;
  // Of one point of a light:
  std::vector<float> weights_;      // of its intensity that each sample gets, before shadows
  std::vector<float> corrections_;  // of a cell's points: factors of weights_
  // Of the rays that are to be traced together:
  std::vector<std::uint32_t> lit_;  // samples that they lead to
  std::vector<vec3> values_;        // what these get if nothing is in the way; of emitters
  std::vector<float> given_;        // the same as weights; of a light with a size
  ShadowRays rays_;
  std::vector<vec3> shares_;                  // of the light that they let through
  std::vector<std::uint32_t> stack_, found_;  // nodes of emitters
  struct Near {
    std::uint32_t node = 0;
    float gives = 0.f, distance = 0.f;
  };
  std::vector<Near> near_;              // those that may light the tile
  std::vector<vec2> pattern_, points_;  // findPoints()
  std::vector<vec3> origins_;           // of the emitter under way: a point of it for each place
  // Of a light with a size, one a sample:
  std::vector<float> full_;   // weights where nothing is in the way
  std::vector<vec3> seen_;    // weights times shares, of the points that are asked
  std::vector<float> asked_;  // their weights
  std::vector<bool> fine_;    // more than rim points were asked
  // Samples whose share is not known, place by place of the pattern.
  std::vector<std::uint32_t> unsure_;
  struct Asked {
    std::uint16_t place = 0;
    Tile range;
  };
  std::vector<Asked> places_;
  bool bySphere_ = false;              // a sphere by the cone that each place sees of it
  Samples gathered_;                   // where they are
  std::vector<std::uint8_t> answers_;  // of each texel
};

}  // namespace lucerna::bake
