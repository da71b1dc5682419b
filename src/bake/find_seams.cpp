#include "bake/find_seams.hpp"

#include <algorithm>
#include <cmath>
#include <compare>

#include "bake/triangle.hpp"
#include "bake/weld.hpp"

namespace lucerna::bake {
namespace {

// Cosine up to which shading normals agree: 8 degrees, a fraction of the light at most.
constexpr float kSameNormal = 0.99f;
// Of the triangles' own normals: beyond 60 degrees one throws shadow onto the other.
constexpr float kBent = 0.5f;
// Texels that SeamSide::offW leads away, if the triangle is not smaller.
constexpr float kOff = 0.25f;
// Texels by which corners of one chart are apart.
constexpr float kApart = 1e-3f;
// Of an edge that very many share, a side is joined with one of this many next ones.
constexpr std::size_t kMostTried = 32;

// Of a triangle; seen from its front, it lies left of the way from its first to its second point.
struct Side {
  std::uint32_t low = 0, high = 0;  // welded
  std::uint32_t triangle = 0;       // of the world
  std::uint8_t first = 0;           // corners of the mesh's triangle
  std::uint8_t second = 0;
  bool rising = false;  // from low to high
  auto operator<=>(const Side&) const = default;

  std::uint8_t cornerAtLow() const { return rising ? first : second; }
  std::uint8_t cornerAtHigh() const { return rising ? second : first; }
  std::uint8_t apex() const { return static_cast<std::uint8_t>(3 - first - second); }
};

struct InChart {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t chart = kNone, triangle = 0;  // of the chart's list
};

class Finder {
 public:
  explicit Finder(const Plan& plan) : plan_(plan), world_(plan.world) {
    places_.resize(world_.triangleCount());
    for (std::uint32_t i = 0; i < plan.charts.charts.size(); ++i) {
      const Chart& chart = plan.charts.charts[i];
      for (std::uint32_t k = 0; k < chart.triangles.size(); ++k)
        places_[world_.objects[chart.object].firstTriangle + chart.triangles[k]] = {i, k};
    }
    findFronts();
    findSides();
  }

  std::vector<Seam> find() const {
    std::vector<Seam> seams;
    for (std::size_t i = 0, end = 0; i < sides_.size(); i = end) {
      while (end < sides_.size() && sides_[end].low == sides_[i].low &&
             sides_[end].high == sides_[i].high)
        ++end;
      if (end - i > 1) join(std::span(sides_).subspan(i, end - i), seams);
    }
    return seams;
  }

 private:
  const WorldObject& objectOf(std::uint32_t triangle) const {
    return world_.objects[world_.owners[triangle]];
  }
  std::uint32_t vertex(std::uint32_t triangle, std::uint8_t corner) const {
    return world_.indices[3 * std::size_t{triangle} + corner];
  }
  vec3 position(std::uint32_t triangle, std::uint8_t corner) const {
    return world_.positions[vertex(triangle, corner)];
  }
  vec3 normal(std::uint32_t triangle, std::uint8_t corner) const {
    const vec3 given = world_.normals[vertex(triangle, corner)];
    return given == vec3(0.f) ? fronts_[triangle] : given;
  }
  vec2 inChart(const Side& side, std::uint8_t corner) const {
    const InChart& at = places_[side.triangle];
    return plan_.charts.charts[at.chart].corners[at.triangle][corner];
  }

  void findFronts() {
    fronts_.reserve(world_.triangleCount());
    for (std::uint32_t t = 0; t < world_.triangleCount(); ++t)
      fronts_.push_back((objectOf(t).mirrored ? -1.f : 1.f) *
                        shapeOf({position(t, 0), position(t, 1), position(t, 2)}).normal);
  }

  void findSides() {
    const std::vector<std::uint32_t> welded = weld(world_.positions);
    sides_.reserve(world_.indices.size());
    for (std::uint32_t t = 0; t < world_.triangleCount(); ++t) {
      if (fronts_[t] == vec3(0.f)) continue;
      for (std::uint8_t k = 0; k < 3; ++k) {
        auto first = k, second = static_cast<std::uint8_t>((k + 1) % 3);
        if (objectOf(t).mirrored) std::swap(first, second);
        const std::uint32_t from = welded[vertex(t, first)], to = welded[vertex(t, second)];
        sides_.push_back({.low = std::min(from, to),
                          .high = std::max(from, to),
                          .triangle = t,
                          .first = first,
                          .second = second,
                          .rising = from < to});
      }
    }
    std::ranges::sort(sides_);
  }

  bool takesLight(const Side& side) const { return places_[side.triangle].chart != InChart::kNone; }

  bool smooth(const Side& a, const Side& b) const {
    const auto agree = [&](std::uint8_t ofA, std::uint8_t ofB) {
      return glm::dot(normal(a.triangle, ofA), normal(b.triangle, ofB)) > kSameNormal;
    };
    return glm::dot(fronts_[a.triangle], fronts_[b.triangle]) > kBent &&
           agree(a.cornerAtLow(), b.cornerAtLow()) && agree(a.cornerAtHigh(), b.cornerAtHigh());
  }

  bool together(const Side& a, const Side& b) const {
    const auto near = [&](std::uint8_t ofA, std::uint8_t ofB) {
      return glm::distance(inChart(a, ofA), inChart(b, ofB)) < kApart;
    };
    return places_[a.triangle].chart == places_[b.triangle].chart &&
           near(a.cornerAtLow(), b.cornerAtLow()) && near(a.cornerAtHigh(), b.cornerAtHigh());
  }

  // Unit, in the triangle's plane, from the edge to the apex.
  vec3 inward(const Side& side) const {
    const vec3 along = position(side.triangle, side.second) - position(side.triangle, side.first);
    return glm::normalize(glm::cross(fronts_[side.triangle], along));
  }
  // m.
  float mostOff(const Side& side) const {
    const float height = glm::dot(
        inward(side), position(side.triangle, side.apex()) - position(side.triangle, side.first));
    return std::min(kOff / plan_.charts.charts[places_[side.triangle].chart].density,
                    0.5f * height);
  }

  SeamSide sideOf(const Side& side, float off) const {
    const std::uint32_t chart = places_[side.triangle].chart;
    const auto most = static_cast<float>(plan_.settings.pack.side);
    const auto at = [&](std::uint8_t corner) {
      return glm::clamp(placed(plan_, chart, inChart(side, corner)), 0.f, most);
    };
    return {.map = plan_.packed.packing.places[chart].map,
            .ends = {at(side.cornerAtLow()), at(side.cornerAtHigh())},
            .offW = off * (fronts_[side.triangle] + inward(side))};
  }

  // The sides of one edge: what goes on most straightly is joined first.
  void join(std::span<const Side> sides, std::vector<Seam>& seams) const {
    struct Pair {
      float minusDot;  // of the triangles' normals
      std::size_t a, b;
      auto operator<=>(const Pair&) const = default;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = i + 1; j < std::min(sides.size(), i + 1 + kMostTried); ++j) {
        const Side &a = sides[i], &b = sides[j];
        if (a.rising == b.rising || !takesLight(a) || !takesLight(b) || !smooth(a, b)) continue;
        pairs.push_back({-glm::dot(fronts_[a.triangle], fronts_[b.triangle]), i, j});
      }
    std::ranges::sort(pairs, [](const Pair& a, const Pair& b) { return a < b; });
    std::vector<bool> joined(sides.size(), false);
    for (const Pair& pair : pairs) {
      if (joined[pair.a] || joined[pair.b]) continue;
      joined[pair.a] = joined[pair.b] = true;
      const Side &a = sides[pair.a], &b = sides[pair.b];
      if (together(a, b)) continue;
      const float off = std::min(mostOff(a), mostOff(b));
      seams.push_back(
          {.endsW = {position(a.triangle, a.cornerAtLow()), position(a.triangle, a.cornerAtHigh())},
           .sides = {sideOf(a, off), sideOf(b, off)}});
    }
  }

  const Plan& plan_;
  const World& world_;
  std::vector<InChart> places_;  // of each triangle
  std::vector<vec3> fronts_;     // unit normals; 0: without an area
  std::vector<Side> sides_;      // sorted
};

}  // namespace

float Seam::length() const {
  return std::max(glm::distance(sides[0].ends[0], sides[0].ends[1]),
                  glm::distance(sides[1].ends[0], sides[1].ends[1]));
}

std::vector<Seam> findSeams(const Plan& plan) {
  return Finder(plan).find();
}

}  // namespace lucerna::bake
