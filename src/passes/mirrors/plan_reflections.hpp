// Which reflections a view shows: for each plane with mirrors in it one picture, and the pictures
// that the mirrors in that one show. Needs no GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/gpu_scene.hpp"
#include "render/view_data.hpp"

namespace lucerna::passes {

// What the mirrors of one plane show.
struct Reflection {
  std::vector<std::uint32_t> mirrors;  // objects that have faces in the plane
  vec4 planeW{0.f};                    // unit normal to the side that is seen, and the distance
  float clearance = 0.f;  // m: nearer to the plane lies what is in it, for all that rounding does
  float tolerance = 0.f;  // m: as near to the plane a point of a mirror is of these faces
  scene::View view;       // reflectedView() in the plane
  render::Window part;    // px of the picture where the mirrors may be seen
  std::vector<std::uint32_t> visible;  // objects that may be seen there
  std::vector<Reflection> within;      // of the mirrors among them
};

struct ReflectionSettings {
  int depth = 1;           // most reflections of a ray
  bool backFaces = false;  // single-sided mirrors reflect on both sides
  // Most pictures: where mirrors face each other, their number multiplies with each depth. A
  // picture comes before all that are smaller in the whole picture, and after the one that shows
  // it: all windows of a picture leave out the same.
  std::size_t budget = 256;
};

struct ReflectionPlan {
  std::vector<Reflection> reflections;
  std::size_t beyondBudget = 0;  // pictures left out; what these would have shown is not counted
  std::vector<std::uint32_t> curved;  // mirrors with more than kMostFaces: they reflect nothing
};

// mirrors: those that the view's window sees; they may reach beyond it.
ReflectionPlan planReflections(const render::GpuScene& gpuScene, const render::ViewData& view,
                               std::span<const std::uint32_t> mirrors,
                               const ReflectionSettings& settings);

}  // namespace lucerna::passes
