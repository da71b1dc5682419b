// One sample for each pixel of a tile, with all rays of a kind in one stream.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "trace/ray_scene.hpp"
#include "trace/reference.hpp"

namespace lucerna::trace {

// What one sample found for a pixel.
struct PixelSample {
  vec3 color{0.f}, direct{0.f}, reflection{0.f};
  float ao = 1.f;
};

// What all tiles share. Scene and settings outlive it.
struct TracedScene {
  TracedScene(const scene::Scene& scene, const ReferenceSettings& settings);

  const scene::Scene& scene;
  const ReferenceSettings& settings;
  RayScene rays;
  std::vector<scene::PlacedLight> lights;
  vec3 ambient;  // radiance that a white surface shows
  mat4 viewFromClip;
  // Sees each stream before it is followed; for benchmarks.
  std::function<void(std::span<const Ray>, RayKind)> observe;
};

// Rows of 4x4 pixels of a rectangle: sixteen neighbours are one packet of rays.
std::vector<ivec2> packedPixels(ivec2 first, ivec2 end);

class TileTracer {
 public:
  explicit TileTracer(const TracedScene& traced);

  // Adds one sample to each of `samples`, which belong to these pixels (x, y from the top left).
  // visibility: one value a light and pixel, light by light, added to; empty if nobody asks.
  // Pixels that are neighbours in the list should be so in the picture.
  void trace(std::span<const ivec2> pixels, std::uint32_t index, std::span<PixelSample> samples,
             std::span<float> visibility);

  const RayStatistics& statistics() const { return statistics_; }  // of all samples so far

 private:
  // A ray on its way from the eye.
  struct Path {
    std::uint32_t pixel = 0;  // in the list
    vec3 throughput{1.f};
    std::uint16_t depth = 0;  // surfaces passed or reflected by: numbers the random sequences
    std::uint8_t bounces = 0, mirrors = 0;
    bool first = true;  // has met no surface that it did not pass through
  };
  // A surface that takes light.
  struct Lit {
    SurfacePoint point;
    Path path;
  };
  // A ray towards a light, or around a surface, and what it brings.
  struct Probe {
    std::uint32_t lit = 0;
    vec3 value{0.f};
  };

  void generate();
  void meet(const Path& path, const Ray& ray, const Passed& passed, const Hit& hit);
  void missed(const Path& path, vec3 directionW);
  void light();
  void lightBy(std::uint32_t light);
  void occlude();
  void follow();                     // rays_ to hits_
  void followProbes(bool occluded);  // probes_ to shares_
  void add(const Path& path, vec3 radiance, bool direct);
  void continueFrom(const SurfacePoint& point, Path path, vec3 directionW);
  vec2 random(const Path& path, std::uint32_t purpose) const;

  const TracedScene& traced_;
  std::span<const ivec2> pixels_;
  std::uint32_t index_ = 0;
  RayStatistics statistics_;
  std::span<PixelSample> samples_;
  std::span<float> visibility_;

  std::vector<Path> paths_, nextPaths_;
  std::vector<Ray> rays_, nextRays_, probes_;
  std::vector<Passed> passed_, nextPassed_;
  std::vector<Hit> hits_;
  std::vector<Lit> lit_;
  std::vector<Probe> values_;
  std::vector<vec3> shares_;
};

}  // namespace lucerna::trace
