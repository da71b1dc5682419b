// Samples where nobody sees the surface: inside of solids that stand on it or cut through it. They
// would be dark, and their texels would darken what is seen beside them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bake/occluders.hpp"
#include "bake/plan.hpp"
#include "bake/samples.hpp"
#include "bake/surface_parts.hpp"
#include "trace/ray_scene.hpp"

namespace lucerna::bake {

// One thread's. What it finds does not depend on the order of blocks.
class HiddenSamples {
 public:
  // All outlive it. parts: of the plan's.
  HiddenSamples(const Plan& plan, const trace::RayScene& rays, const Occluders& occluders,
                const SurfaceParts& parts);

  // Takes out the samples that are inside of a solid: from them, rays meet more backs than fronts
  // of opaque one-sided surfaces. Of a texel that something cuts in two those are left that see the
  // one next to its middle.
  void remove(Samples& samples, std::uint32_t chart);
  // The same of texels of which another place is known not to be hidden, with fewer rays:
  // those that are not cut in two are not hidden. Of the others, the place next to the middle
  // speaks for all of them that it sees.
  void removeBesideOpen(Samples& samples, std::uint32_t chart);

 private:
  // A sample that is not known to be hidden or not.
  struct Open {
    std::uint32_t sample = 0;
    std::size_t directions = 0;           // place in directions_
    std::size_t inside = 0, outside = 0;  // rays that say so
  };
  void ask(const Samples& samples, std::span<const std::uint32_t> which);
  std::uint32_t nextToMiddle(const Samples& samples, std::uint32_t first, std::uint32_t end) const;
  void separate(const Samples& samples, const Samples::Tile& tile);
  void findSurface(const Samples& samples, const Chart& chart, const Samples::Tile& tile);
  bool isCrossed(const Samples& samples, const Chart& chart, const Samples::Tile& tile);

  const Plan& plan_;
  const trace::RayScene& rays_;
  const Occluders& occluders_;
  const SurfaceParts& parts_;
  std::vector<bool> hidden_;  // of the samples under way
  std::vector<std::uint32_t> which_;
  std::vector<Samples::Tile> crossed_, alike_;
  // Of the tile that was asked about last, if it is not planar: of its triangles, in order.
  std::vector<std::uint32_t> partsBelow_, placesBelow_;
  std::vector<Open> open_;
  std::vector<std::array<vec3, 5>> directions_;  // of rays, one by one
  std::vector<trace::Ray> asked_;
  std::vector<int> counts_;
  std::vector<vec3> shares_;
};
// Of places that are on no surface, whether they are inside of a solid, by the same count: of rays
// around each axis of the scene all have to say so, as what is open to one side is none.
std::vector<bool> insideSolids(const trace::RayScene& rays, std::span<const vec3> placesW);

}  // namespace lucerna::bake
