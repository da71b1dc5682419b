#include "bake/unfold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lucerna::bake {
namespace {

// Needles are taken to be this share of their length high: the steps' equations stay solvable.
constexpr double kLeastHeight = 1e-3;

constexpr int kConformalSteps = 400;  // of conjugate gradients
constexpr int kRigidRounds = 12;
constexpr int kRigidSteps = 40;   // of conjugate gradients, a round
constexpr double kSolved = 1e-5;  // of the first residual

constexpr double kRounding = 1e-10;  // of the points' coordinates: steps below it lead astray

using Point = glm::dvec2;
using Points = std::vector<Point>;

double crossOf(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}
// As complex numbers multiply: turned by the angle of `by`, as long as both are.
Point turned(Point p, Point by) {
  return {p.x * by.x - p.y * by.y, p.x * by.y + p.y * by.x};
}

// A triangle in its own plane, and the cotangents of the angles at its corners.
struct Flat {
  std::array<Point, 3> corners;
  std::array<double, 3> cotangents{};
};

Flat layFlat(const Piece& piece, const std::array<std::uint32_t, 3>& triangle) {
  const glm::dvec3 a = piece.points[triangle[0]], ab = piece.points[triangle[1]] - a,
                   ac = piece.points[triangle[2]] - a;
  const double length = glm::length(ab);
  const Point third(glm::dot(ab, ac) / length, glm::length(glm::cross(ab, ac)) / length);
  const double height = std::max(third.y, kLeastHeight * std::max(length, std::abs(third.x)));
  Flat flat{.corners = {Point(0), Point(length, 0), Point(third.x, height)}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point u = flat.corners[(k + 1) % 3] - flat.corners[k],
                v = flat.corners[(k + 2) % 3] - flat.corners[k];
    flat.cotangents[k] = glm::dot(u, v) / crossOf(u, v);
  }
  return flat;
}

double dotOf(const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
  return sum;
}

// Sums over the points next to each point, weighed by cotangents: twice the Dirichlet energy's
// matrix.
class Laplacian {
 public:
  Laplacian(const Piece& piece, const std::vector<Flat>& flats);

  void apply(const Points& x, Points& result) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Point sum = diagonal[i] * x[i];
      for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k)
        sum -= entries_[k].weight * x[entries_[k].point];
      result[i] = sum;
    }
  }
  std::vector<double> diagonal;

 private:
  struct Entry {
    std::uint32_t point;
    double weight;
  };
  std::vector<std::size_t> starts_;
  std::vector<Entry> entries_;
};

Laplacian::Laplacian(const Piece& piece, const std::vector<Flat>& flats)
    : diagonal(piece.points.size(), 0.), starts_(piece.points.size() + 1, 0) {
  for (const auto& triangle : piece.triangles)
    for (const std::uint32_t point : triangle) starts_[point + 1] += 2;
  for (std::size_t i = 0; i + 1 < starts_.size(); ++i) starts_[i + 1] += starts_[i];
  std::vector<Entry> all(starts_.back());
  std::vector<std::size_t> ends(starts_.begin(), starts_.end() - 1);
  for (std::size_t t = 0; t < flats.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = piece.triangles[t][(k + 1) % 3], b = piece.triangles[t][(k + 2) % 3];
      all[ends[a]++] = {b, flats[t].cotangents[k]};
      all[ends[b]++] = {a, flats[t].cotangents[k]};
    }
  for (std::size_t i = 0; i < diagonal.size(); ++i) {  // each neighbour once
    const std::size_t first = std::exchange(starts_[i], entries_.size());
    for (std::size_t k = first; k < ends[i]; ++k) {
      diagonal[i] += all[k].weight;
      const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(starts_[i]);
      const auto known = std::find_if(begin, entries_.end(),
                                      [&](const Entry& e) { return e.point == all[k].point; });
      if (known != entries_.end())
        known->weight += all[k].weight;
      else
        entries_.push_back(all[k]);
    }
  }
  starts_.back() = entries_.size();
}

// Conjugate gradients with a diagonal preconditioner (Hestenes and Stiefel, 1952): brings x nearer
// to matrix(x) = right. Points that are `held` stay.
template <typename Matrix>
void solve(const Matrix& matrix, const std::vector<double>& diagonal, const Points& right,
           Points& x, int steps, std::array<std::size_t, 2> held = {~0ull, ~0ull}) {
  const auto hold = [&](Points& points) {
    for (const std::size_t i : held)
      if (i < points.size()) points[i] = Point(0);
  };
  const std::size_t count = x.size();
  Points residual(count), preconditioned(count), direction(count, Point(0)), image(count);
  matrix(x, image);
  double rounding = 0;
  for (std::size_t i = 0; i < count; ++i) {
    residual[i] = right[i] - image[i];
    rounding += kRounding * kRounding * diagonal[i] * glm::dot(x[i], x[i]);
  }
  hold(residual);
  double before = 0, first = 0;
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < count; ++i)
      preconditioned[i] = diagonal[i] > 0 ? residual[i] / diagonal[i] : residual[i];
    const double now = dotOf(residual, preconditioned);
    if (step == 0) first = now;
    if (!(now > std::max(first * kSolved * kSolved, rounding))) return;
    const double share = step == 0 ? 0 : now / before;
    for (std::size_t i = 0; i < count; ++i) direction[i] = preconditioned[i] + share * direction[i];
    matrix(direction, image);
    hold(image);
    const double bend = dotOf(direction, image);
    if (!(bend > 0)) return;
    const double length = now / bend;
    for (std::size_t i = 0; i < count; ++i) {
      x[i] += length * direction[i];
      residual[i] -= length * image[i];
    }
    before = now;
  }
}

class Unfolding {
 public:
  Unfolding(const Piece& piece, Points start) : piece_(piece), at_(std::move(start)) {
    for (const auto& triangle : piece.triangles) flats_.push_back(layFlat(piece, triangle));
  }

  Points run() {
    const Laplacian laplacian(piece_, flats_);
    makeConformal(laplacian);
    scaleToArea(piece_, at_);
    for (int round = 0; round < kRigidRounds; ++round) makeRigid(laplacian);
    return std::move(at_);
  }

 private:
  // The conformal energy is the Dirichlet energy less the area, which is a sum over the border. Two
  // points far from each other stay, else all would shrink to one.
  void makeConformal(const Laplacian& laplacian) {
    const std::vector<std::array<std::uint32_t, 2>> border = borderOf();
    const auto energy = [&](const Points& x, Points& result) {
      laplacian.apply(x, result);
      for (const auto& [from, to] : border) {
        result[from] += Point(-x[to].y, x[to].x);
        result[to] -= Point(-x[from].y, x[from].x);
      }
    };
    const std::size_t one = farthestFrom(0), other = farthestFrom(one);
    solve(energy, laplacian.diagonal, Points(at_.size(), Point(0)), at_, kConformalSteps,
          {one, other});
  }

  // Each triangle by itself turned as it lies, then all joined again.
  void makeRigid(const Laplacian& laplacian) {
    Points right(at_.size(), Point(0));
    for (std::size_t t = 0; t < flats_.size(); ++t) {
      const auto& triangle = piece_.triangles[t];
      const Flat& flat = flats_[t];
      const auto side = [&](std::size_t k) {
        return flat.cotangents[k] * (flat.corners[(k + 2) % 3] - flat.corners[(k + 1) % 3]);
      };
      Point turn(0);
      for (std::size_t k = 0; k < 3; ++k) {
        const Point now = at_[triangle[(k + 2) % 3]] - at_[triangle[(k + 1) % 3]];
        turn += Point(glm::dot(side(k), now), crossOf(side(k), now));
      }
      turn = glm::length(turn) > 0 ? glm::normalize(turn) : Point(1, 0);
      for (std::size_t k = 0; k < 3; ++k) {
        right[triangle[(k + 2) % 3]] += turned(side(k), turn);
        right[triangle[(k + 1) % 3]] -= turned(side(k), turn);
      }
    }
    const auto matrix = [&](const Points& x, Points& result) { laplacian.apply(x, result); };
    solve(matrix, laplacian.diagonal, right, at_, kRigidSteps);
  }

  // Sides with no triangle across them, as they run.
  std::vector<std::array<std::uint32_t, 2>> borderOf() const {
    using Side = std::array<std::uint32_t, 2>;
    std::vector<Side> sides;
    for (const auto& triangle : piece_.triangles)
      for (std::size_t k = 0; k < 3; ++k) sides.push_back({triangle[k], triangle[(k + 1) % 3]});
    std::ranges::sort(sides);
    std::vector<Side> border;
    for (const Side& side : sides)
      if (!std::ranges::binary_search(sides, Side{side[1], side[0]})) border.push_back(side);
    return border;
  }

  std::size_t farthestFrom(std::size_t point) const {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < at_.size(); ++i)
      if (glm::distance(at_[i], at_[point]) > glm::distance(at_[farthest], at_[point]))
        farthest = i;
    return farthest;
  }

  const Piece& piece_;
  std::vector<Flat> flats_;
  Points at_;
};

}  // namespace

void scaleToArea(const Piece& piece, std::vector<glm::dvec2>& at) {
  double wanted = 0, found = 0;
  for (const auto& [a, b, c] : piece.triangles) {
    wanted += glm::length(
        glm::cross(piece.points[b] - piece.points[a], piece.points[c] - piece.points[a]));
    found += crossOf(at[b] - at[a], at[c] - at[a]);
  }
  if (found > 0)
    for (glm::dvec2& point : at) point *= std::sqrt(wanted / found);
}

std::vector<glm::dvec2> unfold(const Piece& piece, std::vector<glm::dvec2> start) {
  return Unfolding(piece, std::move(start)).run();
}

}  // namespace lucerna::bake
