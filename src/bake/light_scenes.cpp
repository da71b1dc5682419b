#include "bake/light_scenes.hpp"

#include "bake/unit_light.hpp"
#include "core/check.hpp"
#include "core/parallel.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::bake::testing {
namespace {

// The means of a texel's samples.
void addTexels(std::vector<LitTexel>& list, const Plan& plan, const Block& block, const Samples& s,
               std::span<const vec3> light) {
  const auto all = static_cast<std::size_t>(plan.settings.sampling.positions) *
                   static_cast<std::size_t>(plan.settings.sampling.positions);
  for (std::size_t i = 0; i < s.size();) {
    const std::size_t first = i;
    const std::uint16_t at = s.texels[i];
    LitTexel texel{.object = plan.world.objects[plan.charts.charts[block.chart].object].object,
                   .chart = block.chart,
                   .texel = block.corner + ivec2(at % block.size.x, at / block.size.x),
                   .irradiance = light[at]};
    vec3 normal(0.f);
    for (; i < s.size() && s.texels[i] == at; ++i) {
      texel.placesW.emplace_back(s.x[i], s.y[i], s.z[i]);
      texel.positionW += texel.placesW.back();
      normal += vec3(s.nx[i], s.ny[i], s.nz[i]);
    }
    texel.positionW /= static_cast<float>(i - first);
    texel.normalW = glm::normalize(normal);
    texel.border = i - first < all || s.areas[first] < 1.f / static_cast<float>(all);
    list.push_back(texel);
  }
}

std::vector<LitTexel> lightBlock(const Plan& plan, UnitLighter& lighter, const Block& block) {
  const Samples& samples = lighter.sample(block);
  std::vector<vec3> sum(static_cast<std::size_t>(block.size.x) * block.size.y, vec3(0.f));
  std::vector<vec3> light(sum.size());
  for (std::uint32_t g = 0; g < plan.groups.size(); ++g) {
    lighter.lightGroup(g, light);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += light[i];
  }
  std::vector<LitTexel> texels;
  addTexels(texels, plan, block, samples, sum);
  return texels;
}

}  // namespace

Plan planOf(const scene::Scene& scene, const LightOptions& options) {
  BakeSettings settings;
  settings.unwrap = options.unwrap;
  settings.density = options.density;
  settings.sampling = options.sampling;
  settings.faintest = options.faintest;
  auto plan = makePlan(scene, settings);
  CHECK(plan, "no plan");
  return std::move(*plan);
}

std::vector<LitTexel> lightSome(const Plan& plan, std::size_t step) {
  const LightScene scene(plan);
  std::vector<std::vector<LitTexel>> parts((plan.blocks.size() + step - 1) / step);
  parallelFor(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
    UnitLighter lighter(plan, scene);
    for (std::size_t i = begin; i < end; ++i)
      parts[i] = lightBlock(plan, lighter, plan.blocks[i * step]);
  });
  std::vector<LitTexel> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<LitTexel> lightAll(const Plan& plan) {
  return lightSome(plan, 1);
}

std::vector<LitTexel> texelsOf(const std::vector<LitTexel>& all, std::uint32_t object) {
  std::vector<LitTexel> own;
  for (const LitTexel& texel : all)
    if (texel.object == object) own.push_back(texel);
  return own;
}

std::uint32_t addRectangle(scene::Scene& scene, vec3 center, vec3 a, vec3 b) {
  trace::testing::addSquare(scene, center, a, b);
  return static_cast<std::uint32_t>(scene.objects.size()) - 1;
}

scene::Material& addSurface(scene::Scene& scene, vec3 radiance) {
  scene::Material material;
  material.model = scene::MaterialModel::Phong;
  material.emissive = radiance;
  scene.materials.push_back(material);
  return scene.materials.back();
}

}  // namespace lucerna::bake::testing
