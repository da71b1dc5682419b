// Baked light against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bake/light_scenes.hpp"

namespace lucerna::bake {
namespace {

using namespace testing;
using glm::dvec3;

double brightnessOf(vec3 v) {
  return v.x;
}

// Lambert's formula in double precision, for polygons wholly above the surface.
double lambert(std::span<const dvec3> corners, dvec3 p, dvec3 n) {
  double sum = 0.;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 a = glm::normalize(corners[i] - p);
    const dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - p);
    const dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0.) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(across, n) / sine;
  }
  return 0.5 * std::abs(sum);
}

struct Errors {
  double worst = 0., mean = 0., rms = 0., average = 0.;
  std::size_t count = 0;
};

// Of each texel relative to its own truth.
template <typename Truth>
Errors errorsOf(const std::vector<LitTexel>& texels, const Truth& truth) {
  Errors e;
  for (const LitTexel& texel : texels) {
    const double wanted = truth(texel);
    if (wanted <= 0.) continue;
    const double off = brightnessOf(texel.irradiance) / wanted - 1.;
    e.worst = std::max(e.worst, std::abs(off));
    e.mean += off;
    e.rms += off * off;
    ++e.count;
  }
  e.mean /= static_cast<double>(e.count);
  e.rms = std::sqrt(e.rms / static_cast<double>(e.count));
  return e;
}

constexpr float kRadiance = 2.f;

struct Lamp {
  vec3 center, a, b;
  std::array<dvec3, 4> corners() const {
    return {dvec3(center - a - b), dvec3(center + a - b), dvec3(center + a + b),
            dvec3(center - a + b)};
  }
};

// A square lamp of 1 m that shines down from 1 m, onto a floor, and onto a wall that stands beside
// it.
struct LampRoom {
  scene::Scene scene;
  Lamp lamp;
  std::uint32_t floor, wall;
  explicit LampRoom(float height) : lamp{{0, height, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}} {
    addSurface(scene, vec3(kRadiance));
    addRectangle(scene, lamp.center, lamp.a, lamp.b);
    scene.materials.back().doubleSided = false;
    addSurface(scene);
    floor = addRectangle(scene, {0.5f, 0, 0}, {1.5f, 0, 0}, {0, 0, -2});
    wall = addRectangle(scene, {-1, 0.5f * height, 0}, {0, 0, -2}, {0, 0.5f * height, 0});
  }
};

void report(const char* what, const Errors& e) {
  std::printf("%-40s worst %.5f mean %+.5f rms %.5f (%zu)\n", what, e.worst, e.mean, e.rms,
              e.count);
}

TEST(LightTruth, RectangleOverPlanes) {
  for (const float height : {0.05f, 0.25f, 1.f, 4.f})
    for (const Sampling& sampling : {kStandard, kFinal}) {
      const LampRoom room(height);
      const Plan plan = planOf(room.scene, {.density = 10.f, .sampling = sampling});
      const auto all = lightAll(plan);
      const auto corners = room.lamp.corners();
      for (const std::uint32_t object : {room.floor, room.wall}) {
        const auto truth = [&](const LitTexel& texel) {
          return kRadiance * lambert(corners, dvec3(texel.positionW), dvec3(texel.normalW));
        };
        report(fmt::format("{} at {} {}", object == room.floor ? "floor" : "wall", height,
                           sampling.positions == 1 ? "standard" : "final")
                   .c_str(),
               errorsOf(texelsOf(all, object), truth));
      }
    }
}

scene::Scene furnace(vec3 size) {
  scene::Scene scene;
  addSurface(scene, vec3(kRadiance));
  const vec3 h = 0.5f * size;
  const vec3 x(h.x, 0, 0), y(0, h.y, 0), z(0, 0, h.z);
  addRectangle(scene, x, z, y), addRectangle(scene, -x, y, z);
  addRectangle(scene, y, x, z), addRectangle(scene, -y, z, x);
  addRectangle(scene, z, y, x), addRectangle(scene, -z, x, y);
  return scene;
}

TEST(LightTruth, Furnace) {
  for (const vec3 size : {vec3(2, 2, 2), vec3(2.07f, 1.33f, 1.61f)})
    for (const Sampling& sampling : {kStandard, kFinal}) {
      const scene::Scene scene = furnace(size);
      const Plan plan = planOf(scene, {.density = 5.f, .sampling = sampling});
      const auto all = lightAll(plan);
      std::map<int, std::vector<LitTexel>> byDistance;
      for (const LitTexel& t : all) {
        vec3 gap = 0.5f * size - glm::abs(t.positionW) + 10.f * glm::abs(t.normalW);
        byDistance[static_cast<int>(5.f * std::min({gap.x, gap.y, gap.z}))].push_back(t);
      }
      const auto truth = [](const LitTexel&) { return static_cast<double>(kPi * kRadiance); };
      report("furnace", errorsOf(all, truth));
      for (const auto& [d, list] : byDistance)
        report(fmt::format("  {} texels from an edge", d).c_str(), errorsOf(list, truth));
    }
}

}  // namespace
}  // namespace lucerna::bake
