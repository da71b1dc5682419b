// Where a chart is lit: points on the surface below the texels of a block.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bake/charts.hpp"
#include "core/math/bounds.hpp"

namespace lucerna::bake {

inline constexpr int kBlockSide = 32;  // texels

// A square of a chart's texels, those at its far sides cut off.
struct Block {
  std::uint32_t chart = 0;
  ivec2 corner{0};  // texels of the chart
  ivec2 size{0};
};
// Row by row. In the chart's own texels: wherever the chart is placed, its blocks stay.
void addBlocks(std::vector<Block>& blocks, const Chart& chart, std::uint32_t index);

// Up to as many as there are texels times the samples of each. A texel has fewer where the chart
// covers it in part, and none where it touches no triangle; all of its samples count the same.
struct Samples {
  std::vector<float> x, y, z;     // m in the world, just off the surface
  std::vector<float> nx, ny, nz;  // unit, the normal that shades
  std::vector<std::uint16_t>
      texels;  // row * Block::size.x + column; samples of one follow each other
  std::vector<std::uint16_t> places;     // in the texel's pattern, below perTexel
  std::vector<std::uint32_t> triangles;  // of the chart's list
  std::vector<vec2> barycentrics;        // on those: weights of the second and third corner
  std::vector<float> areas;              // texels^2 that each stands for
  // Neighbours: the samples of 8 x 8 texels of the block.
  struct Tile {
    std::uint32_t first = 0, count = 0;
    Aabb boundsW;
  };
  std::vector<Tile> tiles;     // those that have any
  std::size_t texelCount = 0;  // of the block
  int across = 0;              // of them, those of a row
  std::uint32_t perTexel = 1;  // places of the pattern
  float texelSize = 0.f;       // m, of a texel's side in the world
  Aabb boundsW;
  // Bounds of the normals: all lie within the angle of this cosine around the axis. -1: any.
  vec3 axis{0.f};
  float cosine = -1.f;
  // Whether all lie in one plane through them all, with `axis` its normal and no other normals.
  bool planar = false;
  std::array<vec3, 4> corners{};  // of a rectangle around a planar block, in turn

  std::size_t size() const { return x.size(); }
};

// Those of the texels that are marked, row by row; of all else, bounds too, what `all` has.
void choose(const Samples& all, const std::vector<bool>& texels, Samples& chosen);

// m that samples are clear of the surface: some rounding errors of such a place; as much as the
// reference's rays.
inline float liftAt(vec3 positionW) {
  const vec3 size = glm::abs(positionW);
  return std::max(std::max(size.x, size.y), std::max(size.z, 0.1f)) * 0x1p-16f;
}

// Finds the samples of the blocks of one chart.
class ChartSampler {
 public:
  // side: samples along each side of a texel. The chart outlives it.
  ChartSampler(const World& world, const Chart& chart, int side);

  // A texel's samples are those of an even pattern that lie in one of the chart's triangles. Where
  // none does and yet the chart touches it: the middle of what it covers of the texel.
  // The block may be a part of one that addBlocks() gives. only: of its texels, row by row, those
  // that are asked for; empty: all.
  void sample(const Block& block, Samples& samples, const std::vector<bool>& only = {});
  // Those of the chart's texels that lie around the block, as of a block that is one texel larger
  // to each side.
  void sampleAround(const Block& block, Samples& samples);

  // Where steps of a texel along the chart's x and y lead on a triangle of its list, m in the
  // world.
  struct Steps {
    vec3 x, y;
  };
  Steps stepsOn(std::uint32_t triangle) const;

 private:
  // A place on a triangle of the chart's list.
  struct Found {
    static constexpr std::uint32_t kNothing = 0xffffffffu;
    std::uint32_t triangle = kNothing;
    vec2 barycentric{0.f};  // weights of the second and third corner
    float area = 0.f;       // texels^2 that the triangle covers, of a border texel's only sample
  };
  // A triangle of the list in the world.
  struct Surface {
    std::array<vec3, 3> positionsW, normalsW;  // normalsW: 0 where the mesh has none
    vec3 flatW{0.f};                           // its own normal, unit
  };
  std::size_t perTexel() const { return static_cast<std::size_t>(side_) * side_; }
  std::vector<std::uint32_t> touching(const Block& block) const;
  void findInside(const Block& block, std::uint32_t triangle);
  void findBorder(const Block& block, std::uint32_t triangle);
  void emitTile(const Block& block, ivec2 corner, Samples& samples) const;
  void emitTexel(const Block& block, ivec2 texel, Samples& samples) const;
  void emit(std::size_t place, std::uint16_t texel, Samples& samples) const;
  void lift(Samples& samples) const;

  const Chart& chart_;
  int side_;
  std::vector<glm::dvec2> places_;  // of samples in a texel
  std::vector<Surface> surfaces_;
  int blocksAcross_;
  std::vector<std::vector<std::uint32_t>> touching_;  // of each block: places in the chart's list
  std::vector<Found> found_;  // of the block under way, perTexel() for each texel
  std::vector<bool> inside_;  // of its texels: one of its samples lies in a triangle
  std::vector<bool> left_;    // of its texels: not asked for
};

}  // namespace lucerna::bake
