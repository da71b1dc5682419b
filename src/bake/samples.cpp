#include "bake/samples.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bake/clip_polygon.hpp"
#include "bake/triangle.hpp"
#include "core/check.hpp"

namespace lucerna::bake {
namespace {

// In rows of `width`.
std::size_t indexOf(ivec2 p, int width) {
  return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(p.x);
}

using glm::dvec2;

// Texels; neighbours in a tile are neighbours in the list.
constexpr int kTile = 8, kPacketTile = 4;

// Twice the signed area.
double cross(dvec2 a, dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

// Weights of the second and third corner at a point.
struct Barycentric {
  explicit Barycentric(const std::array<vec2, 3>& corners)
      : a(corners[0]), ab(dvec2(corners[1]) - a), ac(dvec2(corners[2]) - a), area2(cross(ab, ac)) {}
  dvec2 at(dvec2 p) const { return {cross(p - a, ac) / area2, cross(ab, p - a) / area2}; }

  dvec2 a, ab, ac;
  double area2;  // 0: no triangle
};

bool isInside(dvec2 weights) {
  constexpr double kRounding = 1e-9;  // so that edges belong to both sides rather than to none
  return weights.x >= -kRounding && weights.y >= -kRounding &&
         weights.x + weights.y <= 1. + kRounding;
}

// Places in a texel, `along` along each side: one in each square of a grid, no two in a row or a
// column of one as fine as there are places, so that edges of shadows along the chart's axes fall
// between them one by one (Chiu, Shirley and Wang, "Multi-Jittered Sampling", Graphics Gems IV,
// 1994, without jitter).
dvec2 placeInTexel(std::size_t index, int along) {
  const double side = along;
  const std::size_t column = index % static_cast<std::size_t>(along);
  const std::size_t row = index / static_cast<std::size_t>(along);
  const dvec2 square(static_cast<double>(column), static_cast<double>(row));
  return (square + dvec2(square.y + 0.5, side - square.x - 0.5) / side) / side;
}

// Texels of the block that a triangle's box meets: from first to before end.
struct Range {
  ivec2 first, end;
};
Range texelsBelow(const std::array<vec2, 3>& corners, const Block& block) {
  const vec2 min = glm::min(glm::min(corners[0], corners[1]), corners[2]);
  const vec2 max = glm::max(glm::max(corners[0], corners[1]), corners[2]);
  return {glm::clamp(ivec2(glm::floor(min)) - block.corner, ivec2(0), block.size),
          glm::clamp(ivec2(glm::floor(max)) + 1 - block.corner, ivec2(0), block.size)};
}

// Of a row of the block: texels of a range that the triangle may touch, from first to before end.
struct Span {
  int first = 0, end = 0;
};
Span touchedIn(int row, const std::array<vec2, 3>& corners, const Block& block,
               const Range& range) {
  constexpr double kRounding = 0x1p-6;  // texels
  const double low = block.corner.y + row - kRounding, high = low + 1. + 2. * kRounding;
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (std::size_t k = 0; k < 3; ++k) {
    dvec2 p(corners[k]), q(corners[(k + 1) % 3]);
    if (p.y > q.y) std::swap(p, q);
    if (q.y < low || p.y > high) continue;
    const auto at = [&](double y) { return p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y)); };
    const double a = p.y < low ? at(low) : p.x, b = q.y > high ? at(high) : q.x;
    left = std::min({left, a, b});
    right = std::max({right, a, b});
  }
  if (left > right) return {};
  const auto texel = [&](double x) { return static_cast<int>(std::floor(x)) - block.corner.x; };
  return {std::max(range.first.x, texel(left - kRounding)),
          std::min(range.end.x, texel(right + kRounding) + 1)};
}

// visit(texel of the block) of all that the triangle may touch, row by row.
template <typename Visit>
void eachTexelBelow(const std::array<vec2, 3>& corners, const Block& block, const Visit& visit) {
  const Range range = texelsBelow(corners, block);
  for (int y = range.first.y; y < range.end.y; ++y) {
    const Span span = touchedIn(y, corners, block, range);
    for (int x = span.first; x < span.end; ++x) visit(ivec2(x, y));
  }
}

void clear(Samples& samples) {
  for (auto* list : {&samples.x, &samples.y, &samples.z, &samples.nx, &samples.ny, &samples.nz})
    list->clear();
  samples.texels.clear();
  samples.places.clear();
  samples.triangles.clear();
  samples.barycentrics.clear();
  samples.areas.clear();
  samples.tiles.clear();
  samples.boundsW = {};
  samples.axis = vec3(0.f);
  samples.cosine = -1.f;
  samples.planar = false;
}

// A rectangle around samples of one plane whose sides follow `along`.
std::array<vec3, 4> rectangleAround(const Samples& s, vec3 along) {
  const vec3 squared = along - s.axis * glm::dot(s.axis, along);
  const vec3 u = glm::normalize(squared), v = glm::cross(s.axis, u);
  const vec3 origin(s.x[0], s.y[0], s.z[0]);
  vec2 low(0.f), high(0.f);
  for (std::size_t i = 1; i < s.size(); ++i) {
    const vec3 d = vec3(s.x[i], s.y[i], s.z[i]) - origin;
    const vec2 p(glm::dot(u, d), glm::dot(v, d));
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const auto at = [&](float x, float y) { return origin + u * x + v * y; };
  return {at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
}

// along: where the chart's x leads in the world, if it is planar.
void findBounds(Samples& s, vec3 along) {
  glm::dvec3 sum(0.);  // in double precision: many normals of one plane must give that normal
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.boundsW.grow({s.x[i], s.y[i], s.z[i]});
    sum += glm::dvec3(s.nx[i], s.ny[i], s.nz[i]);
  }
  const double length = glm::length(sum);
  if (!(length > 0.)) return;
  const glm::dvec3 axis = sum / length;
  s.axis = vec3(axis);
  s.cosine = 1.f;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.cosine = std::min(s.cosine, glm::dot(s.axis, vec3(s.nx[i], s.ny[i], s.nz[i])));
    const double height = glm::dot(axis, glm::dvec3(s.x[i], s.y[i], s.z[i]));
    low = std::min(low, height);
    high = std::max(high, height);
  }
  const vec3 size = glm::max(glm::abs(s.boundsW.min), glm::abs(s.boundsW.max));
  const float rounding = std::max({size.x, size.y, size.z, 0.1f}) * 0x1p-20f;
  const vec3 square = along - s.axis * glm::dot(s.axis, along);
  s.planar = s.cosine > 1.f - 0x1p-20f && high - low <= double{rounding} &&
             glm::dot(square, square) > 0.5f * glm::dot(along, along);
  if (s.planar) s.corners = rectangleAround(s, along);
}

}  // namespace

void choose(const Samples& all, const std::vector<bool>& texels, Samples& chosen) {
  clear(chosen);
  for (const Samples::Tile& tile : all.tiles) {
    Samples::Tile part{
        .first = static_cast<std::uint32_t>(chosen.size()), .count = 0, .boundsW = tile.boundsW};
    for (std::uint32_t i = tile.first; i < tile.first + tile.count; ++i) {
      if (!texels[all.texels[i]]) continue;
      const auto copy = [i](auto& to, const auto& from) { to.push_back(from[i]); };
      copy(chosen.x, all.x), copy(chosen.y, all.y), copy(chosen.z, all.z);
      copy(chosen.nx, all.nx), copy(chosen.ny, all.ny), copy(chosen.nz, all.nz);
      copy(chosen.texels, all.texels), copy(chosen.places, all.places);
      copy(chosen.triangles, all.triangles), copy(chosen.barycentrics, all.barycentrics);
      copy(chosen.areas, all.areas);
    }
    part.count = static_cast<std::uint32_t>(chosen.size()) - part.first;
    if (part.count > 0) chosen.tiles.push_back(part);
  }
  chosen.texelCount = all.texelCount;
  chosen.across = all.across;
  chosen.perTexel = all.perTexel;
  chosen.texelSize = all.texelSize;
  chosen.boundsW = all.boundsW;
  chosen.axis = all.axis;
  chosen.cosine = all.cosine;
  chosen.planar = all.planar;
  chosen.corners = all.corners;
}

void addBlocks(std::vector<Block>& blocks, const Chart& chart, std::uint32_t index) {
  for (int y = 0; y < chart.size.y; y += kBlockSide)
    for (int x = 0; x < chart.size.x; x += kBlockSide)
      blocks.push_back({.chart = index,
                        .corner = {x, y},
                        .size = glm::min(chart.size - ivec2(x, y), ivec2(kBlockSide))});
}

ChartSampler::ChartSampler(const World& world, const Chart& chart, int side)
    : chart_(chart),
      side_(side),
      blocksAcross_((chart.size.x + kBlockSide - 1) / kBlockSide),
      touching_(static_cast<std::size_t>(blocksAcross_) *
                static_cast<std::size_t>((chart.size.y + kBlockSide - 1) / kBlockSide)) {
  for (std::size_t i = 0; i < perTexel(); ++i) places_.push_back(placeInTexel(i, side));
  const WorldObject& object = world.objects[chart.object];
  const auto indices = world.indicesOf(object);
  for (const std::uint32_t triangle : chart.triangles) {
    Surface& surface = surfaces_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      surface.positionsW[k] = world.positions[indices[3 * triangle + k]];
      surface.normalsW[k] = world.normals[indices[3 * triangle + k]];
    }
    surface.flatW = (object.mirrored ? -1.f : 1.f) * shapeOf(surface.positionsW).normal;
  }
  const Block whole{.size = chart.size};
  for (std::uint32_t i = 0; i < chart.corners.size(); ++i) {
    const Range range = texelsBelow(chart.corners[i], whole);
    for (int y = range.first.y / kBlockSide; y * kBlockSide < range.end.y; ++y)
      for (int x = range.first.x / kBlockSide; x * kBlockSide < range.end.x; ++x)
        touching_[indexOf({x, y}, blocksAcross_)].push_back(i);
  }
}

// Of several triangles at a point the first counts.
void ChartSampler::findInside(const Block& block, std::uint32_t triangle) {
  const auto& corners = chart_.corners[triangle];
  const Barycentric barycentric(corners);
  if (barycentric.area2 == 0.) return;
  eachTexelBelow(corners, block, [&](ivec2 p) {
    const auto texel = indexOf(p, block.size.x);
    if (left_[texel]) return;
    for (std::size_t i = 0; i < perTexel(); ++i) {
      Found& found = found_[texel * perTexel() + i];
      if (found.triangle != Found::kNothing) continue;
      const dvec2 weights = barycentric.at(dvec2(block.corner + p) + places_[i]);
      if (!isInside(weights)) continue;
      found = {.triangle = triangle, .barycentric = vec2(weights)};
      inside_[texel] = true;
    }
  });
}

void ChartSampler::findBorder(const Block& block, std::uint32_t triangle) {
  // texels^2. A texel that is touched by less may be none of the chart's: coverage.hpp rounds.
  constexpr double kLeastArea = 4e-3;
  const auto& corners = chart_.corners[triangle];
  const Barycentric barycentric(corners);
  if (barycentric.area2 == 0.) return;
  eachTexelBelow(corners, block, [&](ivec2 p) {
    const auto texel = indexOf(p, block.size.x);
    if (inside_[texel] || left_[texel]) return;
    const dvec2 corner(block.corner + p);
    ClipPolygon polygon(corners);
    polygon.cutTo(corner, corner + 1.);
    const PolygonMoments inside = polygon.moments();
    Found& found = found_[texel * perTexel()];
    if (inside.area > kLeastArea && inside.area > found.area)
      found = {.triangle = triangle,
               .barycentric = vec2(barycentric.at(inside.centroid)),
               .area = static_cast<float>(inside.area)};
  });
}

// Of the block's texel, its place if that was found.
void ChartSampler::emit(std::size_t place, std::uint16_t texel, Samples& samples) const {
  const Found& found = found_[texel * perTexel() + place];
  if (found.triangle == Found::kNothing) return;
  const Surface& surface = surfaces_[found.triangle];
  const float second = found.barycentric.x, third = found.barycentric.y;
  const float first = 1.f - second - third;
  const auto at = [&](const std::array<vec3, 3>& v) {
    return v[0] * first + v[1] * second + v[2] * third;
  };
  const vec3 p = at(surface.positionsW);
  vec3 normal = at(surface.normalsW);
  const float length = glm::length(normal);
  normal = length > 1e-3f ? normal / length : surface.flatW;
  samples.x.push_back(p.x);
  samples.y.push_back(p.y);
  samples.z.push_back(p.z);
  samples.nx.push_back(normal.x);
  samples.ny.push_back(normal.y);
  samples.nz.push_back(normal.z);
  samples.texels.push_back(texel);
  samples.places.push_back(static_cast<std::uint16_t>(place));
  samples.triangles.push_back(found.triangle);
  samples.barycentrics.push_back(found.barycentric);
  samples.areas.push_back(found.area > 0.f ? found.area : 1.f / static_cast<float>(perTexel()));
}

void ChartSampler::emitTexel(const Block& block, ivec2 texel, Samples& samples) const {
  const auto index = indexOf(texel, block.size.x);
  for (std::size_t i = 0; i < perTexel(); ++i) emit(i, static_cast<std::uint16_t>(index), samples);
}

ChartSampler::Steps ChartSampler::stepsOn(std::uint32_t triangle) const {
  const Barycentric barycentric(chart_.corners[triangle]);
  const auto& p = surfaces_[triangle].positionsW;
  const auto step = [&](dvec2 by) {
    const vec2 weights(barycentric.at(barycentric.a + by));
    return (p[1] - p[0]) * weights.x + (p[2] - p[0]) * weights.y;
  };
  return {step({1., 0.}), step({0., 1.})};
}

void ChartSampler::emitTile(const Block& block, ivec2 corner, Samples& samples) const {
  const ivec2 end = glm::min(corner + kTile, block.size);
  Samples::Tile tile{
      .first = static_cast<std::uint32_t>(samples.size()), .count = 0, .boundsW = {}};
  for (int y = corner.y; y < end.y; y += kPacketTile)
    for (int x = corner.x; x < end.x; x += kPacketTile)
      for (int ty = y; ty < std::min(y + kPacketTile, end.y); ++ty)
        for (int tx = x; tx < std::min(x + kPacketTile, end.x); ++tx)
          emitTexel(block, {tx, ty}, samples);
  tile.count = static_cast<std::uint32_t>(samples.size()) - tile.first;
  if (tile.count > 0) samples.tiles.push_back(tile);
}

// As much for the whole block, so that what is flat stays so.
void ChartSampler::lift(Samples& samples) const {
  Aabb box;
  for (std::size_t i = 0; i < samples.size(); ++i)
    box.grow({samples.x[i], samples.y[i], samples.z[i]});
  const float by = samples.size() > 0 ? std::max(liftAt(box.min), liftAt(box.max)) : 0.f;
  for (Samples::Tile& tile : samples.tiles)
    for (std::uint32_t i = tile.first; i < tile.first + tile.count; ++i) {
      const vec3 p = vec3(samples.x[i], samples.y[i], samples.z[i]) +
                     by * surfaces_[samples.triangles[i]].flatW;
      samples.x[i] = p.x;
      samples.y[i] = p.y;
      samples.z[i] = p.z;
      tile.boundsW.grow(p);
    }
}

// Places in the chart's list, in rising order.
std::vector<std::uint32_t> ChartSampler::touching(const Block& block) const {
  const ivec2 first = glm::max(block.corner, 0) / kBlockSide;
  const ivec2 last = (glm::min(block.corner + block.size, chart_.size) - 1) / kBlockSide;
  if (first == last) return touching_[indexOf(first, blocksAcross_)];
  std::vector<std::uint32_t> all;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      std::ranges::copy(touching_[indexOf({x, y}, blocksAcross_)], std::back_inserter(all));
  std::ranges::sort(all);
  const auto again = std::ranges::unique(all);
  all.erase(again.begin(), again.end());
  return all;
}

void ChartSampler::sampleAround(const Block& block, Samples& samples) {
  clear(samples);
  if (block.size == chart_.size) return;
  const Block grown{.chart = block.chart, .corner = block.corner - 1, .size = block.size + 2};
  std::vector<bool> around(static_cast<std::size_t>(grown.size.x) * grown.size.y, true);
  for (int y = 1; y <= block.size.y; ++y)
    std::fill_n(around.begin() + indexOf({1, y}, grown.size.x), block.size.x, false);
  sample(grown, samples, around);
}

void ChartSampler::sample(const Block& block, Samples& samples, const std::vector<bool>& only) {
  clear(samples);
  const auto texels = static_cast<std::size_t>(block.size.x) * block.size.y;
  found_.assign(texels * perTexel(), {});
  inside_.assign(texels, false);
  left_ = only;
  left_.resize(texels, true);
  left_.flip();
  const std::vector<std::uint32_t> triangles = touching(block);
  for (const std::uint32_t triangle : triangles) findInside(block, triangle);
  for (const std::uint32_t triangle : triangles) findBorder(block, triangle);
  for (int y = 0; y < block.size.y; y += kTile)
    for (int x = 0; x < block.size.x; x += kTile) emitTile(block, {x, y}, samples);
  samples.texelCount = texels;
  samples.across = block.size.x;
  samples.perTexel = static_cast<std::uint32_t>(perTexel());
  samples.texelSize = 1.f / chart_.density;
  lift(samples);
  findBounds(samples, samples.triangles.empty() ? vec3(0.f) : stepsOn(samples.triangles[0]).x);
}

}  // namespace lucerna::bake
