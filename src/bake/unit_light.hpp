// The light of one unit: what a shard makes, stores, and merging puts into the maps.
#pragma once

#include <memory>
#include <optional>

#include "bake/emitters.hpp"
#include "bake/hidden.hpp"
#include "bake/lighter.hpp"
#include "bake/occluders.hpp"
#include "bake/plan.hpp"
#include "bake/shadow_tracer.hpp"
#include "core/file.hpp"

namespace lucerna::bake {

// Irradiance as half floats, red, green, blue of each texel that touches the chart, row by row.
struct GroupLight {
  std::uint32_t group = 0;  // of Plan::groups
  std::vector<std::uint16_t> rgb;
};
// Bits: one for each texel of the block, row by row, the lowest first.
struct BlockLight {
  std::vector<std::uint8_t> touched;  // bits: has samples
  std::vector<std::uint8_t> hidden;   // bits: had some, which are inside of solids; empty: none
  std::vector<GroupLight> groups;     // those that give some light, in rising order
};
inline bool hasBit(const std::vector<std::uint8_t>& bits, std::size_t texel) {
  return !bits.empty() && (bits[texel / 8] >> (texel % 8) & 1) != 0;
}
struct UnitLight {
  std::vector<BlockLight> blocks;  // as the unit's
};

// What a half holds of it: the largest one at most. NaN is 0.
float storable(float irradiance);

Bytes toBytes(const UnitLight& light);
// Nothing if the bytes are no light of that unit.
std::optional<UnitLight> unitLightFrom(std::span<const std::byte> bytes, const Plan& plan,
                                       const Unit& unit);

// What the tracing of a plan needs, made once; any number of threads may use it.
struct LightScene {
  explicit LightScene(const Plan& plan) : LightScene(plan, plan.settings.engine) {}
  LightScene(const Plan& plan, Engine engine);  // instead of the plan's
  Engine engine;
  std::unique_ptr<ShadowTracer> tracer;
  Occluders occluders;
  Emitters emitters;
  std::vector<scene::PlacedLight> cells;  // of the emitters, as lights; of the octree only
  std::vector<scene::Bvh> reaches;  // of each group's lights; none for the octree, which asks all
  trace::RayScene rays;
  SurfaceParts parts;
  Aabb boxW;             // of all triangles
  float diagonal = 0.f;  // m, of the box
};

// One thread's way through the units.
class UnitLighter {
 public:
  UnitLighter(const Plan& plan, const LightScene& scene);
  UnitLight light(const Unit& unit);
  // A block's samples, and then a group's light on its texels, row by row; false: nothing of it
  // reaches them.
  const Samples& sample(const Block& block);
  bool lightGroup(std::uint32_t group, std::span<vec3> texels);
  const LightCounters& counters() const { return lighter_->counters; }
  double samplingSeconds = 0.;

 private:
  BlockLight lightBlock(const Block& block);
  std::span<const scene::PlacedLight> lightsNear(std::uint32_t group);
  void addLight(std::span<const scene::PlacedLight> lights, bool emitters, std::span<vec3> texels);
  void refine(std::span<const scene::PlacedLight> lights);

  const Plan& plan_;
  const LightScene& scene_;
  std::vector<std::uint32_t> found_;
  std::vector<scene::PlacedLight> near_;  // of the group that is lit
  std::unique_ptr<Lighter> lighter_;
  HiddenSamples hidden_;
  std::optional<ChartSampler> sampler_, fineSampler_;
  Block block_{.chart = 0xffffffffu};  // whose samples are there
  Samples samples_, samplesAround_, fineSamples_;
  std::vector<std::uint8_t> reached_;  // bits of the block: has samples, hidden ones or not
  std::vector<vec3> texels_, part_;
  Uneven uneven_;
};

}  // namespace lucerna::bake
