// What is in the way between lights and samples: the one question that the baker asks of rays, and
// two engines that answer it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bake/samples.hpp"
#include "bake/world.hpp"

namespace lucerna::bake {

// What lies within this share of the way from the light is not in the way: a lamp's own surface.
inline constexpr float kClearOfLight = 0x1p-12f;  // as the reference

// What lies within this share of the way from the sample is not, either, as that much rounding may
// move what is as large as the way is long: more than samples near the origin are clear of their
// surface. In metres no more than what nobody sees, or half of what samples are clear of it.
inline constexpr float kClearOfSample = 0x1p-19f, kMostClearOfSample = 0x1p-11f;

// What of the way to the light is clear of a sample.
inline float clearOfSample(vec3 sampleW, vec3 toLightW) {
  const float most = std::max(kMostClearOfSample, 0.5f * liftAt(sampleW));
  const vec3 size = glm::abs(toLightW);  // no square root: Embree is as fast as this
  return std::min(kClearOfSample, most / std::max(std::max(size.x, size.y), size.z));
}

// Rays from a light to samples, in world space (m). Neighbours in the list should be neighbours in
// the scene.
struct ShadowRays {
  std::vector<float> fromX, fromY, fromZ;  // on the light
  std::vector<float> toX, toY, toZ;        // just off the surface that is lit

  std::size_t size() const { return fromX.size(); }
  void resize(std::size_t count) {
    for (auto* list : {&fromX, &fromY, &fromZ, &toX, &toY, &toZ}) list->resize(count);
  }
};

// Immutable once made: any number of threads may ask it.
class ShadowTracer {
 public:
  virtual ~ShadowTracer() = default;
  // What each ray lets through, per colour: 1 where nothing is in the way, 0 behind an opaque
  // surface, else the product of the transmittances (scene/material.hpp) of what it crosses. Holes
  // of alpha-tested surfaces are none; one-sided translucent surfaces count where their front faces
  // the light. As many shares as rays.
  virtual void trace(const ShadowRays& rays, std::span<vec3> shares) const = 0;
};

// What Embree follows rays with: "avx512", "avx2" or "sse4.2", the best that this processor has.
// Another one may decide otherwise where rays graze edges, so manifests name it, and shards of a
// bake have to agree.
const char* rayInstructionSet();

// By Embree, in packets of sixteen. The world outlives it, and so below.
std::unique_ptr<ShadowTracer> makeEmbreeTracer(const World& world);

// One ray at a time through an octree, the thesis' way (spec B, section 5.1.3): the baseline.
struct OctreeSettings {
  std::size_t leafSize = 20;  // a cell of more triangles is cut, where that helps (octree.hpp)
  bool mailboxes = true;      // whether a ray tests a triangle in several leaves only once
};
std::unique_ptr<ShadowTracer> makeOctreeTracer(const World& world,
                                               const OctreeSettings& settings = {});

}  // namespace lucerna::bake
