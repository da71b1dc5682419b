// The ray-traced reference: the same scene, camera, lights and materials as the passes draw, by
// rays and lights of the size that they state. Shares no shading, sampling or light code with the
// passes.
//
// What it knows: direct light from areas, ambient light, emission, alpha test, translucent surfaces
// over what is behind them and in the way of light, planar mirrors, a thin lens, ambient occlusion,
// and on request diffuse bounces. What it does not: shaders that materials bring (drawn as their
// material without), light that mirrors throw. Textures are read in their finest level.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "image/image.hpp"
#include "scene/scene.hpp"
#include "scene/view.hpp"

namespace lucerna::trace {

enum class Shading {
  Area,   // light from everywhere on the light
  Point,  // light from its centre, times the mean visibility of the whole: what soft shadows do
};
enum class Primary {
  Filtered,  // all over the pixel: a box filter of its size
  Centre,    // through its centre, as a rasteriser without anti-aliasing
};

struct ReferenceSettings {
  uvec2 size{1280, 720};
  scene::View view;
  std::uint64_t seed = 0;
  int samples = 256;  // a pixel at most
  float error = 0.f;  // standard error that ends a pixel's samples; 0: none does. See errorOf
  Shading shading = Shading::Area;
  Primary primary = Primary::Filtered;
  bool shadows = true;   // false: light goes through everything, as where no pass casts shadows
  int bounces = 0;       // of diffuse light between surfaces
  int mirrors = 8;       // most reflections of a ray
  float aoRadius = 0.f;  // m, farthest occluder that counts; 0: ambient light is not occluded
  float lensRadius = 0.f, focusDistance = 1.f;  // m; radius 0: everything is sharp
  bool visibility = false;                      // also a picture of each light's visibility
};

enum class RayKind { Closest, Occlusion };

struct RayStatistics {
  std::uint64_t closest = 0, occlusion = 0;  // rays
  double seconds = 0;                        // of all threads, spent in following them

  void add(const RayStatistics& other) {
    closest += other.closest;
    occlusion += other.occlusion;
    seconds += other.seconds;
  }
};

struct ReferencePicture {
  Image color;       // F32 RGB, linear radiance
  Image direct;      // of it, what comes from lights without mirrors or bounces
  Image reflection;  // of it, what mirrors show
  Image ao;  // F32, mean visibility around the first surface within aoRadius; 1 where nothing is
  std::vector<Image>
      visibility;          // one a light, as placeLights() lists them: share of the light that
                           // the first surface sees; 0 where it faces away or out of reach
  Image error;             // F32, standard error of colour: errorOf()
  double meanSamples = 0;  // a pixel
  RayStatistics rays;
  double seconds = 0;      // of all threads, spent in samples
  bool cancelled = false;  // by Progress::cancelled(); what is there is right, but noisy
};

// Standard error of a pixel's colour: of the channel where it is largest as a share of the
// channel's value, values below a tenth of white (at the scene's exposure) counting as that.
float errorOf(vec3 mean, vec3 variance, double samples, float white);

// Bit for bit the same for the same settings, whatever the number of threads. Shows progress.
ReferencePicture renderReference(const scene::Scene& scene, const ReferenceSettings& settings);

}  // namespace lucerna::trace
