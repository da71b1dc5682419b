#include "bake/chart_growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

namespace lucerna::bake {
namespace {

constexpr double kRoundness = 0.02;  // how much a squared perimeter counts beside what bends

struct Cone {
  glm::dvec3 axis{0};
  double angle = 0;
};

double angleBetween(glm::dvec3 a, glm::dvec3 b) {
  return std::acos(std::clamp(glm::dot(a, b), -1., 1.));
}

// The smallest cone around two.
Cone around(const Cone& a, const Cone& b) {
  const double between = angleBetween(a.axis, b.axis);
  if (between + b.angle <= a.angle) return a;
  if (between + a.angle <= b.angle) return b;
  const double angle = (between + a.angle + b.angle) / 2;
  const glm::dvec3 across = b.axis - glm::dot(a.axis, b.axis) * a.axis;
  if (glm::length(across) < 1e-12) return {a.axis, angle + between};
  const double turn = angle - a.angle;
  return {std::cos(turn) * a.axis + std::sin(turn) * glm::normalize(across), angle};
}

// What a chart may become: flat parts, merged.
struct Part {
  glm::dvec3 sum{0};  // of the normals, by area
  double area = 0, perimeter = 0;
  Cone cone;
  glm::dvec3 low{1e300}, high{-1e300};
  std::uint32_t changes = 0;
  bool alive = true;
  std::uint32_t last = Surface::kNone;                       // triangle, of the ring of them
  std::vector<std::pair<std::uint32_t, double>> neighbours;  // and lengths shared, in rising order

  double bend() const { return area - glm::length(sum); }  // integral of |n - mean|^2 / 2
  double roundness() const { return perimeter * perimeter / (4 * std::numbers::pi * area); }
};

struct Merge {
  double cost;
  std::uint32_t a, b, changesA, changesB;
  auto key() const { return std::tuple(cost, a, b); }
  bool operator<(const Merge& other) const { return key() > other.key(); }  // least first
};

class Merger {
 public:
  Merger(const Surface& surface, const GrowthSettings& settings);

  std::vector<Region> run() {
    while (!merges_.empty()) {
      const Merge next = merges_.top();
      merges_.pop();
      const Part &a = parts_[next.a], &b = parts_[next.b];
      if (!a.alive || !b.alive || a.changes != next.changesA || b.changes != next.changesB)
        continue;
      Cone cone = around(a.cone, b.cone);
      if (cone.angle > settings_.cone) cone = exactCone(next.a, next.b);
      if (cone.angle <= settings_.cone) merge(next.a, next.b, cone);
    }
    return regions();
  }

 private:
  void addTriangle(std::uint32_t triangle);
  void propose(std::uint32_t a, std::uint32_t b, double shared);
  void merge(std::uint32_t a, std::uint32_t b, const Cone& cone);
  void forget(std::uint32_t part, std::uint32_t neighbour) {
    auto& list = parts_[part].neighbours;
    list.erase(
        std::ranges::lower_bound(list, neighbour, {}, &std::pair<std::uint32_t, double>::first));
  }
  void share(std::uint32_t part, std::uint32_t neighbour, double length);
  double coneOf(std::uint32_t part, glm::dvec3 axis) const;
  // Cones of cones grow wider than need be.
  Cone exactCone(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 axis = glm::normalize(parts_[a].sum + parts_[b].sum);
    return {axis, std::max(coneOf(a, axis), coneOf(b, axis))};
  }
  std::vector<Region> regions() const;

  const Surface& surface_;
  GrowthSettings settings_;
  float cosCrease_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> next_;  // triangle of the same part, in a ring
  std::priority_queue<Merge> merges_;
};

double sideLength(const Surface& surface, std::uint32_t side) {
  const auto& corners = surface.corners[side / 3];
  return glm::distance(glm::dvec3(corners[side % 3]), glm::dvec3(corners[(side + 1) % 3]));
}

Merger::Merger(const Surface& surface, const GrowthSettings& settings)
    : surface_(surface),
      settings_(settings),
      cosCrease_(std::cos(settings.crease)),
      parts_(surface.flatNormals.size()),
      next_(surface.triangles()) {
  for (std::uint32_t t = 0; t < surface.triangles(); ++t)
    if (surface.flatPart[t] != Surface::kNone) addTriangle(t);
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    parts_[i].cone.axis = glm::normalize(glm::dvec3(surface.flatNormals[i]));
    parts_[i].cone.angle = coneOf(i, parts_[i].cone.axis);
  }
  for (std::uint32_t i = 0; i < parts_.size(); ++i)
    for (const auto& [neighbour, shared] : parts_[i].neighbours)
      if (i < neighbour) propose(i, neighbour, shared);
}

void Merger::addTriangle(std::uint32_t triangle) {
  const std::uint32_t number = surface_.flatPart[triangle];
  Part& part = parts_[number];
  const TriangleShape& shape = surface_.shapes[triangle];
  part.sum += static_cast<double>(shape.area) * glm::dvec3(shape.normal);
  part.area += shape.area;
  for (const glm::dvec3 corner : surface_.corners[triangle]) {
    part.low = glm::min(part.low, corner);
    part.high = glm::max(part.high, corner);
  }
  if (part.last == Surface::kNone) part.last = next_[triangle] = triangle;
  next_[triangle] = std::exchange(next_[part.last], triangle);
  part.last = triangle;
  for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
    const std::uint32_t other = surface_.across[side];
    const std::uint32_t neighbour = other == Surface::kNone ? other : surface_.flatPart[other / 3];
    if (neighbour == number) continue;
    const double length = sideLength(surface_, side);
    part.perimeter += length;
    if (neighbour != Surface::kNone &&
        glm::dot(shape.normal, surface_.shapes[other / 3].normal) >= cosCrease_)
      share(number, neighbour, length);
  }
}

void Merger::share(std::uint32_t part, std::uint32_t neighbour, double length) {
  auto& list = parts_[part].neighbours;
  const auto place =
      std::ranges::lower_bound(list, neighbour, {}, &std::pair<std::uint32_t, double>::first);
  if (place != list.end() && place->first == neighbour)
    place->second += length;
  else
    list.insert(place, {neighbour, length});
}

double Merger::coneOf(std::uint32_t part, glm::dvec3 axis) const {
  double least = 1;
  std::uint32_t triangle = parts_[part].last;
  do {
    least = std::min(least, glm::dot(axis, glm::dvec3(surface_.shapes[triangle].normal)));
    triangle = next_[triangle];
  } while (triangle != parts_[part].last);
  return std::acos(std::clamp(least, -1., 1.));
}

void Merger::propose(std::uint32_t a, std::uint32_t b, double shared) {
  if (a > b) std::swap(a, b);
  const Part &first = parts_[a], &second = parts_[b];
  const double diagonal =
      glm::distance(glm::min(first.low, second.low), glm::max(first.high, second.high));
  if (diagonal > settings_.longest) return;
  Part both;
  both.sum = first.sum + second.sum;
  both.area = first.area + second.area;
  both.perimeter = first.perimeter + second.perimeter - 2 * shared;
  if (both.roundness() >
      std::max({static_cast<double>(settings_.compact), first.roundness(), second.roundness()}))
    return;
  const double cost =
      both.bend() - first.bend() - second.bend() + kRoundness * both.perimeter * both.perimeter;
  merges_.push({cost, a, b, first.changes, second.changes});
}

// b goes into a.
void Merger::merge(std::uint32_t a, std::uint32_t b, const Cone& cone) {
  Part& into = parts_[a];
  Part gone = std::move(parts_[b]);
  parts_[b].alive = false;
  into.sum += gone.sum;
  into.area += gone.area;
  into.perimeter += gone.perimeter;
  into.cone = cone;
  into.low = glm::min(into.low, gone.low);
  into.high = glm::max(into.high, gone.high);
  ++into.changes;
  std::swap(next_[into.last], next_[gone.last]);
  for (const auto& [neighbour, shared] : gone.neighbours) {
    if (neighbour == a) {
      into.perimeter -= 2 * shared;
      forget(a, b);
      continue;
    }
    forget(neighbour, b);
    share(neighbour, a, shared);
    share(a, neighbour, shared);
  }
  for (const auto& [neighbour, shared] : into.neighbours) propose(a, neighbour, shared);
}

std::vector<Region> Merger::regions() const {
  std::vector<Region> result;
  for (const Part& part : parts_) {
    if (!part.alive) continue;
    Region& region = result.emplace_back();
    std::uint32_t triangle = part.last;
    do {
      region.triangles.push_back(triangle);
      triangle = next_[triangle];
    } while (triangle != part.last);
    std::ranges::sort(region.triangles);
    region.axis = part.cone.axis;
    region.cone = coneAround(region.axis, surface_, region.triangles);
  }
  std::ranges::sort(result, {}, [](const Region& region) { return region.triangles[0]; });
  return result;
}

}  // namespace

double coneAround(glm::dvec3 axis, const Surface& surface,
                  std::span<const std::uint32_t> triangles) {
  double least = 1;
  for (const std::uint32_t triangle : triangles)
    least = std::min(least, glm::dot(axis, glm::dvec3(surface.shapes[triangle].normal)));
  return std::acos(std::clamp(least, -1., 1.));
}

std::vector<Region> growRegions(const Surface& surface, const GrowthSettings& settings) {
  return Merger(surface, settings).run();
}

}  // namespace lucerna::bake
