#include "bake/own_unwrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "bake/chart_overlap.hpp"
#include "bake/coverage.hpp"
#include "bake/stretch.hpp"
#include "bake/triangle.hpp"

namespace lucerna::bake {
namespace {

constexpr double kMostStretch = 4.;  // of a length, either way, compared with the whole's scale

using Flat = std::array<glm::dvec2, 3>;

double areaOf(const Flat& t) {
  const glm::dvec2 ab = t[1] - t[0], ac = t[2] - t[0];
  return 0.5 * (ab.x * ac.y - ab.y * ac.x);
}

bool usesSecondSet(const scene::Material& m) {
  for (const scene::TextureSlot* slot :
       {&m.albedoTexture, &m.emissiveTexture, &m.normalTexture, &m.metallicRoughnessTexture,
        &m.occlusionTexture, &m.specularTexture})
    if (slot->used() && slot->texCoord == 1) return true;
  return false;
}

// The object's triangles that have an area, in space and in the plane.
struct Triangles {
  std::vector<std::uint32_t> numbers;
  std::vector<std::array<glm::dvec3, 3>> inSpace;
  std::vector<Flat> flat;
};

Triangles trianglesOf(const World& world, const WorldObject& object, const scene::Mesh& mesh) {
  Triangles result;
  const auto indices = world.indicesOf(object);
  for (std::uint32_t i = 0; i < object.triangleCount; ++i) {
    std::array<vec3, 3> corners;
    Flat flat;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = world.positions[indices[3 * i + k]];
      flat[k] = mesh.texCoords[1][mesh.indices[3 * i + k]];
    }
    if (shapeOf(corners).area == 0.f) continue;
    result.numbers.push_back(i);
    result.inSpace.push_back({corners[0], corners[1], corners[2]});
    result.flat.push_back(flat);
  }
  return result;
}

// Texels a unit of the texture coordinates, such that areas are as the density says in all.
double scaleOf(const Triangles& triangles, double density) {
  double flat = 0., inSpace = 0.;
  for (std::size_t i = 0; i < triangles.flat.size(); ++i) {
    const auto& t = triangles.inSpace[i];
    flat += std::abs(areaOf(triangles.flat[i]));
    inSpace += 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
  }
  return flat > 0. ? density * std::sqrt(inSpace / flat) : 0.;
}

std::string faultOf(const Triangles& triangles, double scale, double density) {
  if (scale == 0.) return "it has no area";
  bool turned = false, straight = false;
  for (std::size_t i = 0; i < triangles.flat.size(); ++i) {
    Flat scaled = triangles.flat[i];
    for (glm::dvec2& p : scaled) p *= scale / density;
    const Stretch stretch = stretchOf(triangles.inSpace[i], scaled);
    if (!(std::abs(stretch.least) * kMostStretch >= 1. && stretch.most <= kMostStretch))
      return fmt::format("triangle {} is stretched by more than {}", triangles.numbers[i],
                         kMostStretch);
    (stretch.least < 0. ? turned : straight) = true;
  }
  std::vector<Flat> flat = triangles.flat;
  if (turned)
    for (Flat& t : flat)
      if (areaOf(t) < 0.) std::swap(t[1], t[2]);
  if (const auto overlap = findOverlap(flat, 0.01 / scale))
    return fmt::format("triangles {} and {} lie on each other", triangles.numbers[(*overlap)[0]],
                       triangles.numbers[(*overlap)[1]]);
  return {};
}

// Of each triangle, a number that those share that are connected in the plane.
std::vector<std::uint32_t> islandsOf(const std::vector<Flat>& flat) {
  std::vector<std::uint32_t> parents(flat.size());
  std::iota(parents.begin(), parents.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  };
  std::map<std::tuple<double, double>, std::uint32_t> first;
  for (std::uint32_t i = 0; i < flat.size(); ++i)
    for (const glm::dvec2 p : flat[i]) {
      const auto [at, isNew] = first.try_emplace({p.x, p.y}, i);
      if (!isNew) parents[root(i)] = root(at->second);
    }
  for (std::uint32_t i = 0; i < flat.size(); ++i) parents[i] = root(i);
  return parents;
}

// Whether texels of two islands are closer than the gap.
bool areClose(const Chart& chart, const std::vector<std::uint32_t>& islands, int gap) {
  constexpr std::uint32_t kFree = 0xffffffffu;
  std::vector<std::uint32_t> owners(static_cast<std::size_t>(chart.size.x) * chart.size.y, kFree);
  std::map<std::uint32_t, std::vector<FlatTriangle>> parts;
  for (std::size_t i = 0; i < islands.size(); ++i) parts[islands[i]].push_back(chart.corners[i]);
  for (const auto& [island, triangles] : parts) {
    vec2 low(std::numeric_limits<float>::infinity());
    for (const FlatTriangle& triangle : triangles)
      for (const vec2 corner : triangle) low = glm::min(low, corner);
    const Coverage coverage = coverageFrom(triangles, glm::floor(low));
    const ivec2 least(coverage.least), size = coverage.mask.size();
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        if (!coverage.mask.at(x, y)) continue;
        const ivec2 p = least + ivec2(x, y);
        for (int ny = std::max(p.y - gap, 0); ny <= std::min(p.y + gap, chart.size.y - 1); ++ny)
          for (int nx = std::max(p.x - gap, 0); nx <= std::min(p.x + gap, chart.size.x - 1); ++nx) {
            const std::uint32_t owner = owners[static_cast<std::size_t>(ny) * chart.size.x + nx];
            if (owner != kFree && owner != island) return true;
          }
        if (p.x < chart.size.x && p.y < chart.size.y)
          owners[static_cast<std::size_t>(p.y) * chart.size.x + p.x] = island;
      }
  }
  return false;
}

}  // namespace

std::variant<Chart, std::string> ownUnwrap(const World& world, std::uint32_t index,
                                           const ChartSettings& settings) {
  const WorldObject& object = world.objects[index];
  const scene::Object& drawn = world.scene->objects[object.object];
  const scene::Mesh& mesh = world.scene->meshes[drawn.mesh];
  if (mesh.texCoords[1].empty()) return std::string();
  if (usesSecondSet(world.scene->materials[drawn.material]))
    return "its material's textures lie by it";
  if (std::ranges::any_of(mesh.texCoords[1],
                          [](vec2 p) { return !std::isfinite(p.x) || !std::isfinite(p.y); }))
    return "it is not finite";
  const Triangles triangles = trianglesOf(world, object, mesh);
  if (triangles.numbers.empty()) return std::string();
  const double scale = scaleOf(triangles, settings.density);
  if (std::string fault = faultOf(triangles, scale, settings.density); !fault.empty()) return fault;

  Chart chart{.object = index, .triangles = triangles.numbers, .density = settings.density};
  glm::dvec2 least(std::numeric_limits<double>::infinity()), most(-least);
  for (const Flat& t : triangles.flat)
    for (const glm::dvec2 p : t) {
      least = glm::min(least, p);
      most = glm::max(most, p);
    }
  const glm::dvec2 size = glm::ceil((most - least) * scale - 1e-3);
  if (std::max(size.x, size.y) > settings.mostSide)
    return fmt::format("it needs {} x {} texels at this density", size.x, size.y);
  chart.size = glm::max(ivec2(size), ivec2(1));
  for (const Flat& t : triangles.flat) {
    std::array<vec2, 3>& corners = chart.corners.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = glm::clamp(vec2((t[k] - least) * scale), vec2(0.f), vec2(chart.size));
  }
  if (areClose(chart, islandsOf(triangles.flat), settings.gap))
    return fmt::format("parts of it are closer than {} texels at this density", settings.gap);
  return chart;
}

}  // namespace lucerna::bake
