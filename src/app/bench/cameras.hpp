// Places to look at any scene from: seeded, the same everywhere, and found by rays, so that a
// picture from there shows something.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/camera.hpp"
#include "scene/scene.hpp"

namespace lucerna::app::bench {

struct SeededCamera {
  CameraPose pose;
  float sight = 1.f;  // m: half of what its rays meet is nearer
};

struct CameraWish {
  int count = 1;
  std::uint64_t seed = 0;
  float eyeHeight = 0.f;  // m above the lowest ground under the open sky; 0: anywhere
};

// Eyes lie inside the scene's box and look at some corner of some object, level or a little down or
// up. From most of them a picture is mostly covered, from outside of solid things, by surfaces at
// several distances that are not close to the eye; where the scene has few such places, by what it
// has. Transforms must be up to
// date. The first cameras are the same whatever the count.
std::vector<SeededCamera> seededCameras(const scene::Scene& scene, const CameraWish& wish);

// Where the first of the scene's own cameras stand. All see in perspective. Sights are 1 m.
std::vector<SeededCamera> ownCameras(const scene::Scene& scene, int most);

// A path that visits them all, the next one always the nearest of the rest, a second apart.
CameraPath pathThrough(std::span<const SeededCamera> cameras);

}  // namespace lucerna::app::bench
