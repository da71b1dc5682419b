#include "bake/surface_parts.hpp"

#include <algorithm>

#include "bake/surface.hpp"
#include "bake/weld.hpp"

namespace lucerna::bake {
namespace {

constexpr float kCosCrease = 0.766f;  // 40 degrees, as curved charts

// Of each of the object's triangles; parts count from 0 on.
std::vector<std::uint32_t> smoothParts(const World& world, const WorldObject& object) {
  const auto indices = world.indicesOf(object);
  const auto [least, most] = std::ranges::minmax(indices);
  std::vector<std::uint32_t> local;
  for (const std::uint32_t index : indices) local.push_back(index - least);
  const Surface surface =
      surfaceOf(std::span(world.positions).subspan(least, most - least + 1), local);
  std::vector<std::uint32_t> parts(surface.triangles(), Surface::kNone), stack;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < surface.triangles(); ++first) {
    if (parts[first] != Surface::kNone) continue;
    parts[first] = count;
    stack.assign(1, first);
    while (!stack.empty()) {
      const std::uint32_t at = stack.back();
      stack.pop_back();
      for (std::uint32_t side = 3 * at; side < 3 * at + 3; ++side) {
        if (surface.across[side] == Surface::kNone) continue;
        const std::uint32_t next = surface.across[side] / 3;
        const float cosine = glm::dot(surface.shapes[at].normal, surface.shapes[next].normal);
        if (parts[next] != Surface::kNone || cosine < kCosCrease) continue;
        parts[next] = count;
        stack.push_back(next);
      }
    }
    ++count;
  }
  return parts;
}

}  // namespace

SurfaceParts surfaceParts(const Plan& plan) {
  SurfaceParts result;
  result.of.assign(plan.world.triangleCount(), scene::kNone);
  auto count = static_cast<std::uint32_t>(plan.charts.charts.size());
  for (std::uint32_t i = 0; i < plan.charts.charts.size(); ++i) {
    const Chart& chart = plan.charts.charts[i];
    const WorldObject& object = plan.world.objects[chart.object];
    if (!chart.own) {
      for (const std::uint32_t t : chart.triangles) result.of[object.firstTriangle + t] = i;
      continue;
    }
    const std::vector<std::uint32_t> parts = smoothParts(plan.world, object);
    for (const std::uint32_t t : chart.triangles)
      result.of[object.firstTriangle + t] = count + parts[t];
    count += std::ranges::max(parts) + 1;
    if (result.places.empty()) result.places = weld(plan.world.positions);
  }
  return result;
}

}  // namespace lucerna::bake
