#include "bake/visibility_check.hpp"

#include <algorithm>

#include "bake/bare_rays.hpp"
#include "core/check.hpp"
#include "core/random.hpp"

namespace lucerna::bake::testing {
namespace {

using scene::LightKind;
using scene::PlacedLight;

// Of the samples of one block, in the same order.
struct Pairs {
  ShadowRays rays;
  std::vector<ChartSampler::Steps> steps;  // of a texel, where each sample is

  void add(vec3 from, vec3 to, const ChartSampler::Steps& step) {
    const std::size_t i = rays.size();
    rays.resize(i + 1);
    rays.fromX[i] = from.x, rays.fromY[i] = from.y, rays.fromZ[i] = from.z;
    rays.toX[i] = to.x, rays.toY[i] = to.y, rays.toZ[i] = to.z;
    steps.push_back(step);
  }
};

vec3 inBall(Random& random) {
  for (;;) {
    const float x = random.uniform(-1.f, 1.f), y = random.uniform(-1.f, 1.f);
    const vec3 p(x, y, random.uniform(-1.f, 1.f));
    if (glm::dot(p, p) <= 1.f) return p;
  }
}

// Where the rays to a place start.
vec3 startOf(const PlacedLight& light, vec3 chance, float diagonal, vec3 to) {
  if (light.kind != LightKind::Directional) return light.positionW + light.radius * chance;
  return to - diagonal * glm::normalize(light.directionW + 0.5f * light.angle * chance);
}

Aabb boundsOf(const World& world) {
  Aabb box;
  for (const vec3 p : world.positions) box.grow(p);
  return box;
}

// Pairs of every light with the samples of one block.
void addPairs(std::vector<Pairs>& lists, const ChartSampler& sampler, const Samples& samples,
              std::span<const PlacedLight> lights, float diagonal, Random& random) {
  for (const PlacedLight& light : lights) {
    Pairs list;
    const vec3 chance = inBall(random);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const vec3 to(samples.x[i], samples.y[i], samples.z[i]);
      const vec3 from = startOf(light, chance, diagonal, to);
      const bool faces = glm::dot(from - to, {samples.nx[i], samples.ny[i], samples.nz[i]}) > 0.f;
      const bool reaches =
          light.kind == LightKind::Directional || glm::distance(from, to) < light.reach;
      if (faces && reaches) list.add(from, to, sampler.stepsOn(samples.triangles[i]));
    }
    if (list.rays.size() > 0) lists.push_back(std::move(list));
  }
}

std::vector<bool> truthOf(const World& world, std::span<const ShadowRays> lists) {
  return BareRays(world, lists, {.robust = true}).blockedOneByOne();
}

// Those around the sample; all pairs one ray each.
std::vector<ShadowRays> moved(const Pairs& pairs) {
  constexpr float kMove = 1e-4f;  // texels
  std::vector<ShadowRays> lists;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y) {
      if (x == 0 && y == 0) continue;
      ShadowRays& rays = lists.emplace_back(pairs.rays);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const vec3 by = kMove * (static_cast<float>(x) * pairs.steps[i].x +
                                 static_cast<float>(y) * pairs.steps[i].y);
        rays.toX[i] += by.x, rays.toY[i] += by.y, rays.toZ[i] += by.z;
      }
    }
  return lists;
}

}  // namespace

VisibilityCount checkVisibility(const Plan& plan, const ShadowTracer& tracer,
                                std::span<const PlacedLight> lights, std::size_t pairs,
                                std::uint64_t seed) {
  const float diagonal = boundsOf(plan.world).diagonal();
  Random random(seed, 17);
  VisibilityCount count;
  std::vector<Pairs> lists;
  Samples samples;
  for (std::size_t tries = 0; count.pairs < pairs; ++tries) {
    CHECK(tries < 1000 + pairs, "no light faces anything");
    const Block& block = plan.blocks[random.below(static_cast<std::uint32_t>(plan.blocks.size()))];
    ChartSampler sampler(plan.world, plan.charts.charts[block.chart],
                         plan.settings.sampling.positions);
    sampler.sample(block, samples);
    const std::size_t before = lists.size();
    addPairs(lists, sampler, samples, lights, diagonal, random);
    for (std::size_t i = before; i < lists.size(); ++i) count.pairs += lists[i].rays.size();
  }
  std::vector<ShadowRays> rays;
  for (Pairs& list : lists) rays.push_back(list.rays);
  const std::vector<bool> truth = truthOf(plan.world, rays);
  count.blocked = static_cast<std::size_t>(std::ranges::count(truth, true));
  Pairs doubtful;
  std::vector<bool> said;  // of these, by the truth
  std::vector<vec3> shares;
  std::size_t at = 0;
  for (const Pairs& list : lists) {
    shares.resize(list.rays.size());
    tracer.trace(list.rays, shares);
    for (std::size_t i = 0; i < list.rays.size(); ++i, ++at) {
      if ((shares[i] == vec3(0.f)) == truth[at]) continue;
      const ShadowRays& r = list.rays;
      doubtful.add({r.fromX[i], r.fromY[i], r.fromZ[i]}, {r.toX[i], r.toY[i], r.toZ[i]},
                   list.steps[i]);
      said.push_back(truth[at]);
    }
  }
  if (said.empty()) return count;
  std::vector<bool> changes(said.size(), false);
  for (const ShadowRays& around : moved(doubtful)) {
    const std::vector<bool> there = truthOf(plan.world, std::span(&around, 1));
    for (std::size_t i = 0; i < said.size(); ++i) changes[i] = changes[i] || there[i] != said[i];
  }
  count.atEdges = static_cast<std::size_t>(std::ranges::count(changes, true));
  count.wrong = said.size() - count.atEdges;
  return count;
}

}  // namespace lucerna::bake::testing
