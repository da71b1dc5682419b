// Where alpha-tested triangles have holes, prepared: shadow rays ask at every one that they meet.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "trace/material_lookup.hpp"

namespace lucerna::bake {

// Immutable once made.
class Holes {
 public:
  // Of these triangles. Lookup and scene outlive it.
  Holes(const trace::MaterialLookup& lookup, const scene::Scene& scene,
        std::vector<trace::Spot> triangles);
  // As trace::isHole(), but for rounding. triangle: place in the list.
  bool at(std::size_t triangle, vec2 barycentric) const;

 private:
  // What lies between the middles of four texels.
  enum class Cell : std::uint8_t { Solid, Hole, Mixed };
  // A triangle on a picture of 8 bits that repeats.
  struct Picture {
    std::array<vec2, 3> places;            // of its corners: texels, from the middle of the first
    const std::uint8_t* alphas = nullptr;  // null: the triangle is none of these
    const Cell* cells = nullptr;           // one a texel, whose middle is their upper left corner
    ivec2 size{0};
    int channels = 0;
    float least = 0.f;  // alpha that is no hole, of 255
    int alpha(int x, int y) const {
      return alphas[(static_cast<std::ptrdiff_t>(y) * size.x + x) * channels];
    }
  };
  Picture pictureOf(const scene::Scene& scene, const trace::Spot& triangle) const;
  static std::vector<Cell> cellsOf(const Picture& picture);
  static bool isHole(const Picture& picture, ivec2 cell, vec2 share);

  const trace::MaterialLookup& lookup_;
  std::vector<trace::Spot> triangles_;
  std::vector<Picture> pictures_;
  std::map<std::pair<const std::uint8_t*, float>, std::vector<Cell>> cells_;  // by alphas and least
};

}  // namespace lucerna::bake
