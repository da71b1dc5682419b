#include "bake/solve_seams.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.hpp"

namespace lucerna::bake {
namespace {

using glm::dvec3;

// Of the gradient, in brightness: a thousandth of what an eye or 8 bits can tell.
constexpr double kAgrees = 4e-6;
constexpr int kMostIterations = 1000;
// Each fixes those texels at 0 that would be below, and lets go of those that would rise.
constexpr int kMostRounds = 30;

double largestOf(std::span<const dvec3> list) {
  double largest = 0.;
  for (const dvec3& v : list)
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest;
}

dvec3 product(std::span<const dvec3> a, std::span<const dvec3> b) {
  dvec3 sum(0.);
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Channels that have come to rest divide 0 by 0.
dvec3 quotient(dvec3 a, dvec3 b) {
  const auto of = [](double x, double y) { return y > 0. ? x / y : 0.; };
  return {of(a.x, b.x), of(a.y, b.y), of(a.z, b.z)};
}

class Solver {
 public:
  Solver(const SeamSystem& system, const SeamPart& part, std::span<dvec3> values)
      : samples_(std::span(system.samples).subspan(part.firstSample, part.samples)),
        stiffness_(std::span(system.stiffness).subspan(part.firstTexel, part.texels)),
        first_(part.firstTexel),
        values_(values),
        start_(values.begin(), values.end()),
        free_(values.size(), dvec3(1.)),
        inverse_(values.size()),
        residual_(values.size()),
        way_(values.size()),
        result_(values.size()) {
    std::vector<double> diagonal(stiffness_.begin(), stiffness_.end());
    for (const SeamSample& s : samples_)
      for (std::size_t k = 0; k < 8; ++k)
        diagonal[s.texels[k] - first_] += double{s.share} * s.weights[k] * s.weights[k];
    for (std::size_t i = 0; i < diagonal.size(); ++i) inverse_[i] = 1. / diagonal[i];
  }

  std::uint64_t solve() {
    std::uint64_t iterations = 0;
    for (int round = 0; round < kMostRounds; ++round) {
      iterations += descend();
      if (!exchange()) break;
    }
    return iterations;
  }

 private:
  // to = (A^T A + stiffness) of.
  void apply(std::span<const dvec3> of, std::span<dvec3> to) const {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = double{stiffness_[i]} * of[i];
    for (const SeamSample& s : samples_) {
      dvec3 difference(0.);
      for (std::size_t k = 0; k < 8; ++k)
        difference += double{s.weights[k]} * of[s.texels[k] - first_];
      difference *= double{s.share};
      for (std::size_t k = 0; k < 8; ++k)
        to[s.texels[k] - first_] += double{s.weights[k]} * difference;
    }
  }

  std::uint64_t descend() {
    apply(values_, result_);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      residual_[i] = free_[i] * (double{stiffness_[i]} * start_[i] - result_[i]);
      way_[i] = residual_[i] * inverse_[i];
    }
    dvec3 along = product(residual_, way_);
    std::uint64_t n = 0;
    for (; n < kMostIterations && largestOf(residual_) > kAgrees; ++n) {
      apply(way_, result_);
      const dvec3 step = quotient(along, product(way_, result_));
      for (std::size_t i = 0; i < values_.size(); ++i) {
        values_[i] += step * way_[i];
        residual_[i] -= step * free_[i] * result_[i];
        result_[i] = residual_[i] * inverse_[i];
      }
      const dvec3 next = product(residual_, result_);
      const dvec3 turn = quotient(next, along);
      for (std::size_t i = 0; i < values_.size(); ++i) way_[i] = result_[i] + turn * way_[i];
      along = next;
    }
    return n;
  }

  // Changes what is fixed to where the values push (block principal pivoting: Judice and Pires,
  // 1994). False if nothing does; then no value is negative.
  bool exchange() {
    apply(values_, result_);
    bool any = false;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const dvec3 push = double{stiffness_[i]} * start_[i] - result_[i];
      for (int c = 0; c < 3; ++c)
        if (free_[i][c] == 0.) {
          if (push[c] > kAgrees) free_[i][c] = 1., any = true;
        } else if (values_[i][c] < 0.) {
          any = any || values_[i][c] < -kAgrees;
          values_[i][c] = free_[i][c] = 0.;
        }
    }
    return any;
  }

  std::span<const SeamSample> samples_;
  std::span<const float> stiffness_;
  std::uint32_t first_;
  std::span<dvec3> values_;
  std::vector<dvec3> start_;
  std::vector<dvec3> free_;  // 1, or 0 where a value stays 0
  std::vector<double> inverse_;
  std::vector<dvec3> residual_, way_, result_;
};

}  // namespace

std::uint64_t solve(const SeamSystem& system, const SeamPart& part, std::span<dvec3> values) {
  CHECK(values.size() == part.texels);
  return Solver(system, part, values).solve();
}

}  // namespace lucerna::bake
