// Rays against a scene, by Embree: whole streams of them, in packets of sixteen neighbours. Every
// mesh is built once, however many objects show it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "scene/scene.hpp"
#include "trace/material_lookup.hpp"

namespace lucerna::trace {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Points origin + t * direction with near <= t <= far; the direction may have any length.
struct Ray {
  vec3 originW{0.f};
  float near = 0.f;
  vec3 directionW{0.f, 0.f, -1.f};
  float far = kInfinity;
};

struct Hit {
  float t = kInfinity;  // infinity: nothing was hit, and the spot is nowhere
  Spot spot;
  bool any() const { return t < kInfinity; }
};

// Surfaces that a ray has met and goes on through, so that others in the same place are met too.
class Passed {
 public:
  // The ray's new near, from which the hit is not met again.
  float pass(const Hit& hit);
  bool has(std::uint32_t object, std::uint32_t triangle) const;
  bool any() const { return count_ > 0; }

 private:
  struct Triangle {
    std::uint32_t object = scene::kNone, index = 0;
  };
  std::array<Triangle, 4> triangles_;
  std::size_t count_ = 0;
  float t_ = -1.f;  // of all of them
};

class RayScene {
 public:
  // The scene outlives it and stays as it is. viewFromWorld: of the eye that generated texture
  // coordinates follow. instructionSet: "avx2", "sse4.2", ...; "": the best there is.
  RayScene(const scene::Scene& scene, const mat4& viewFromWorld,
           const std::string& instructionSet = "");
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // The nearest surfaces, both sides of them, holes of alpha-tested materials left out. Rays that
  // are neighbours in the list should be neighbours in the scene.
  // passed: empty, or for each ray what it is not to meet.
  void closest(std::span<const Ray> rays, std::span<Hit> hits,
               std::span<const Passed> passed = {}) const;

  // What each ray lets through, per colour: 1 where nothing is in the way, 0 behind an opaque
  // surface, else the product of the transmittances (scene/material.hpp) of what it crosses. The
  // rays lead to a light; one-sided translucent surfaces count where their front faces it.
  void transmittance(std::span<const Ray> rays, std::span<vec3> shares) const;

  // How many more backs than fronts of opaque one-sided surfaces each ray meets, all of them: in a
  // scene of closed solids, the number of solids that its origin is inside of.
  void solidsAround(std::span<const Ray> rays, std::span<int> counts) const;

  const MaterialLookup& lookup() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lucerna::trace
