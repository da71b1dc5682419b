#include "bake/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/check.hpp"

namespace lucerna::bake {
namespace {

constexpr std::int64_t kSteps = 1024;  // to a texel

struct Point {
  std::int64_t x, y;  // steps; from 0 to 2^26, so that products of two have no more than 2^52
};

struct Box {
  vec2 low{std::numeric_limits<float>::infinity()};
  vec2 high{-std::numeric_limits<float>::infinity()};
};

Box boxOf(std::span<const FlatTriangle> triangles) {
  Box box;
  for (const FlatTriangle& triangle : triangles)
    for (const vec2 corner : triangle) {
      CHECK(std::isfinite(corner.x) && std::isfinite(corner.y));
      box.low = glm::min(box.low, corner), box.high = glm::max(box.high, corner);
    }
  return box;
}

double stepsFrom(float least, float value) {
  return std::floor((double{value} - double{least}) * kSteps + 0.5);
}

int texelsOf(float least, float most) {
  return static_cast<int>(std::clamp(std::ceil(stepsFrom(least, most) / kSteps), 1.,
                                     std::numeric_limits<int>::max() / 2.));
}

// Texels from the first to past the last that the span from low to high has length in, one at
// least.
struct Run {
  std::int64_t begin = std::numeric_limits<std::int64_t>::max();
  std::int64_t end = std::numeric_limits<std::int64_t>::min();

  // A place in texels, as a fraction; not negative.
  void include(std::int64_t numerator, std::int64_t denominator) {
    begin = std::min(begin, numerator / denominator);
    end = std::max(end, (numerator + denominator - 1) / denominator);
  }
  Run within(int size) const {
    const std::int64_t first = std::min<std::int64_t>(begin, size - 1);
    return {first, std::max(end, first + 1)};
  }
};

// Where the side from a to b crosses the line at height y, between them.
void includeCrossing(Run& run, Point a, Point b, std::int64_t y) {
  if (a.y > b.y) std::swap(a, b);
  const std::int64_t height = b.y - a.y;
  run.include(a.x * height + (b.x - a.x) * (y - a.y), height * kSteps);
}

// What lies in the closed row of a triangle: its corners there, and its sides where they enter and
// leave.
Run runOf(const std::array<Point, 3>& corners, std::int64_t row) {
  const std::int64_t bottom = row * kSteps, top = bottom + kSteps;
  Run run;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point a = corners[i], b = corners[(i + 1) % 3];
    if (a.y >= bottom && a.y <= top) run.include(a.x, kSteps);
    for (const std::int64_t y : {bottom, top})
      if (std::min(a.y, b.y) < y && y < std::max(a.y, b.y)) includeCrossing(run, a, b, y);
  }
  return run;
}

void cover(TexelMask& mask, const std::array<Point, 3>& corners) {
  Run rows;
  for (const Point corner : corners) rows.include(corner.y, kSteps);
  rows = rows.within(mask.size().y);
  for (std::int64_t row = rows.begin; row < rows.end; ++row) {
    const Run run = runOf(corners, row).within(mask.size().x);
    setRun(mask.row(static_cast<int>(row)), static_cast<int>(run.begin), static_cast<int>(run.end));
  }
}

}  // namespace

ivec2 coverageSize(std::span<const FlatTriangle> triangles) {
  CHECK(!triangles.empty());
  const Box box = boxOf(triangles);
  return {texelsOf(box.low.x, box.high.x), texelsOf(box.low.y, box.high.y)};
}

Coverage coverageOf(std::span<const FlatTriangle> triangles) {
  CHECK(!triangles.empty());
  return coverageFrom(triangles, boxOf(triangles).low);
}

Coverage coverageFrom(std::span<const FlatTriangle> triangles, vec2 least) {
  CHECK(!triangles.empty());
  const Box box = boxOf(triangles);
  CHECK(least.x <= box.low.x && least.y <= box.low.y);
  const ivec2 size(texelsOf(least.x, box.high.x), texelsOf(least.y, box.high.y));
  CHECK(std::max(size.x, size.y) <= kMostTexels, "a chart of {} x {} texels", size.x, size.y);
  Coverage coverage{.least = least, .mask = TexelMask(size)};
  for (const FlatTriangle& triangle : triangles) {
    std::array<Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = {static_cast<std::int64_t>(stepsFrom(coverage.least.x, triangle[i].x)),
                    static_cast<std::int64_t>(stepsFrom(coverage.least.y, triangle[i].y))};
    cover(coverage.mask, corners);
  }
  return coverage;
}

}  // namespace lucerna::bake
