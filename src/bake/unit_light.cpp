#include "bake/unit_light.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bake/block_lighter.hpp"
#include "bake/seconds.hpp"
#include "bake/thesis_lighter.hpp"
#include "bake/triangle.hpp"
#include "core/byte_stream.hpp"
#include "core/check.hpp"
#include "image/image.hpp"

namespace lucerna::bake {
namespace {

Aabb boundsOf(const World& world) {
  Aabb box;
  for (const std::uint32_t index : world.indices)
    if (isFinite(world.positions[index])) box.grow(world.positions[index]);
  return box;
}

std::unique_ptr<ShadowTracer> makeTracer(const Plan& plan, Engine engine) {
  switch (engine) {
    case Engine::Embree:
      return makeEmbreeTracer(plan.world);
    case Engine::Octree:
      return makeOctreeTracer(plan.world);
  }
  CHECK(false);
}

std::unique_ptr<Lighter> makeLighter(const Plan& plan, const LightScene& scene) {
  const Sampling& sampling = plan.settings.sampling;
  const LighterSettings settings{.lightSamples = sampling.lightSamples,
                                 .skyPoints = sampling.skyPoints,
                                 .shared = sampling.positions == 1 ? 2 : 1,
                                 .emitterSize = sampling.emitterSize,
                                 .emitterShare = sampling.emitterShare,
                                 .sceneDiagonal = scene.diagonal,
                                 .sceneBoxW = scene.boxW};
  switch (scene.engine) {
    case Engine::Embree:
      return std::make_unique<BlockLighter>(*scene.tracer, scene.occluders, scene.emitters,
                                            settings, *plan.world.scene);
    case Engine::Octree:
      return std::make_unique<ThesisLighter>(*scene.tracer, scene.cells, settings);
  }
  CHECK(false);
}

Emitters emittersOf(const Plan& plan, Engine engine) {
  if (!plan.emittersShine()) return {};
  const float white = irradianceOfWhite(*plan.world.scene);
  return findEmitters(plan.world, plan.charts.charts, plan.settings.faintest * white,
                      plan.settings.reach, {.merged = engine != Engine::Octree});
}

// The same members in the same order, written or read.
template <typename Stream, typename L>
void fields(Stream& stream, L& light) {
  stream.list(light.blocks, [](auto& s, auto& block) {
    s(block.touched);
    s(block.hidden);
    s.list(block.groups, [](auto& inner, auto& group) {
      inner(group.group);
      inner(group.rgb);
    });
  });
}

bool isSound(const BlockLight& light, const Block& block, std::size_t groups) {
  const auto texels = static_cast<std::size_t>(block.size.x) * block.size.y;
  const auto isOfBlock = [&](const std::vector<std::uint8_t>& bits) {
    return bits.size() == (texels + 7) / 8 && (texels % 8 == 0 || bits.back() >> texels % 8 == 0);
  };
  if (!isOfBlock(light.touched)) return false;
  if (!light.hidden.empty() && !isOfBlock(light.hidden)) return false;
  std::size_t touched = 0;
  for (std::size_t i = 0; i < light.touched.size(); ++i) {
    touched += std::popcount(light.touched[i]);
    if (!light.hidden.empty() && (light.touched[i] & light.hidden[i]) != 0) return false;
  }
  return std::ranges::all_of(light.groups, [&](const GroupLight& group) {
    return group.group < groups && group.rgb.size() == 3 * touched;
  });
}

// Those that have samples.
std::vector<std::uint8_t> bitsOf(const Samples& samples) {
  std::vector<std::uint8_t> bits((samples.texelCount + 7) / 8, 0);
  for (const std::uint16_t texel : samples.texels)
    bits[texel / 8] |= static_cast<std::uint8_t>(1u << (texel % 8));
  return bits;
}

}  // namespace

float storable(float irradiance) {
  return irradiance > 0.f ? std::min(irradiance, kLargestHalf) : 0.f;
}

Bytes toBytes(const UnitLight& light) {
  ByteWriter writer;
  fields(writer, light);
  return std::move(writer.bytes);
}

std::optional<UnitLight> unitLightFrom(std::span<const std::byte> bytes, const Plan& plan,
                                       const Unit& unit) {
  ByteReader reader(bytes);
  UnitLight light;
  fields(reader, light);
  if (!reader.good() || !reader.atEnd() || light.blocks.size() != unit.blocks) return {};
  for (std::size_t i = 0; i < light.blocks.size(); ++i)
    if (!isSound(light.blocks[i], plan.blocks[unit.firstBlock + i], plan.groups.size())) return {};
  return light;
}

LightScene::LightScene(const Plan& plan, Engine engineOf)
    : engine(engineOf),
      tracer(makeTracer(plan, engineOf)),
      occluders(plan.world),
      emitters(emittersOf(plan, engine)),
      rays(*plan.world.scene, mat4(1.f), rayInstructionSet()),
      parts(surfaceParts(plan)),
      boxW(boundsOf(plan.world)),
      diagonal(std::max(boxW.diagonal(), 1e-3f)) {
  if (engine == Engine::Octree)
    cells = cellLights(emitters, *plan.world.scene);
  else
    for (const LightGroup& group : plan.groups) reaches.push_back(reachTree(group.lights));
}

UnitLighter::UnitLighter(const Plan& plan, const LightScene& scene)
    : plan_(plan),
      scene_(scene),
      lighter_(makeLighter(plan, scene)),
      hidden_(plan, scene.rays, scene.occluders, scene.parts) {}

const Samples& UnitLighter::sample(const Block& block) {
  const auto start = Clock::now();
  if (block_.chart != block.chart) {
    const Chart& chart = plan_.charts.charts[block.chart];
    const Sampling& sampling = plan_.settings.sampling;
    sampler_.emplace(plan_.world, chart, sampling.positions);
    // The thesis asks no texel again for what its neighbours see.
    const bool refines = scene_.engine != Engine::Octree || sampling.positions > 1;
    fineSampler_.reset();
    if (sampling.finePositions > 0 && refines)
      fineSampler_.emplace(plan_.world, chart, sampling.finePositions);
  }
  block_ = block;
  sampler_->sample(block, samples_);
  reached_ = bitsOf(samples_);
  hidden_.remove(samples_, block.chart);
  uneven_.around = nullptr;
  if (fineSampler_ && plan_.settings.sampling.positions == 1) {
    sampler_->sampleAround(block, samplesAround_);
    hidden_.remove(samplesAround_, block.chart);
    uneven_.around = &samplesAround_;
  }
  samplingSeconds += secondsSince(start);
  return samples_;
}

// Those of the group's lights that may reach the samples, in the group's order.
std::span<const scene::PlacedLight> UnitLighter::lightsNear(std::uint32_t group) {
  const std::vector<scene::PlacedLight>& all = plan_.groups[group].lights;
  if (scene_.reaches.empty()) return all;
  found_.clear();
  near_.clear();
  scene_.reaches[group].query(samples_.boundsW, found_);
  std::ranges::sort(found_);
  for (const std::uint32_t i : found_) near_.push_back(all[i]);
  return near_;
}

bool UnitLighter::lightGroup(std::uint32_t group, std::span<vec3> texels) {
  std::ranges::fill(texels, vec3(0.f));
  const auto lights = lightsNear(group);
  const bool shines = group == 0;  // emitting surfaces are always on
  if (!lights.empty()) addLight(lights, false, texels);
  if (shines) addLight({}, true, texels);
  return shines || !lights.empty();
}

// Texels that shadows' edges cross are lit once more, from more places, by the lights that throw
// them.
void UnitLighter::addLight(std::span<const scene::PlacedLight> lights, bool emitters,
                           std::span<vec3> texels) {
  if (!lighter_->light(samples_, lights, emitters, part_, fineSampler_ ? &uneven_ : nullptr))
    return;
  if (fineSampler_ && !uneven_.texels.empty()) refine(lights);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] += part_[i];
}

void UnitLighter::refine(std::span<const scene::PlacedLight> lights) {
  const auto start = Clock::now();
  std::vector<bool> which(samples_.texelCount, false);
  for (const UnevenTexel& u : uneven_.texels) which[u.texel] = true;
  fineSampler_->sample(block_, fineSamples_, which);
  if (uneven_.around)
    hidden_.removeBesideOpen(fineSamples_, block_.chart);
  else
    hidden_.remove(fineSamples_, block_.chart);
  samplingSeconds += secondsSince(start);
  lighter_->relight(fineSamples_, lights, uneven_.texels, part_);
}

BlockLight UnitLighter::lightBlock(const Block& block) {
  sample(block);
  const auto count = static_cast<std::size_t>(block.size.x) * block.size.y;
  BlockLight result;
  result.touched = bitsOf(samples_);
  if (result.touched != reached_) {
    result.hidden = reached_;
    for (std::size_t i = 0; i < result.hidden.size(); ++i) result.hidden[i] ^= result.touched[i];
  }
  for (std::uint32_t g = 0; g < plan_.groups.size(); ++g) {
    texels_.resize(count);
    if (!lightGroup(g, texels_) ||
        std::ranges::all_of(texels_, [](vec3 v) { return v == vec3(0.f); }))
      continue;
    GroupLight& group = result.groups.emplace_back(GroupLight{.group = g, .rgb = {}});
    for (std::size_t i = 0; i < count; ++i)
      if (hasBit(result.touched, i))
        for (int c = 0; c < 3; ++c) group.rgb.push_back(halfFromFloat(storable(texels_[i][c])));
  }
  return result;
}

UnitLight UnitLighter::light(const Unit& unit) {
  UnitLight result;
  for (std::uint32_t i = 0; i < unit.blocks; ++i)
    result.blocks.push_back(lightBlock(plan_.blocks[unit.firstBlock + i]));
  return result;
}

}  // namespace lucerna::bake
