#include "bake/solve_seams.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/check.hpp"

namespace lucerna::bake {
namespace {

// Of the gradient, in brightness: 1/400 of what 8 bits can tell.
constexpr double kAgrees = 1e-5;
// On the dragon, 2000 instead would take four times as long and leave 0.0033 instead of 0.0035.
constexpr std::uint64_t kMostIterations = 400;
// Scaled by its diagonal, the matrix lengthens no vector to more than 8 times, as a sample has 8
// texels: (sum of 8 numbers)^2 <= 8 * the sum of their squares. Steps along the gradient by up to
// 2 / 8 lead down.
constexpr double kStep = 0.24;

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0.;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// In variables x = value * sqrt(diagonal).
class Solver {
 public:
  Solver(const SeamSystem& system, const SeamPart& part, std::span<double> values)
      : samples_(system.samplesOf(part)),
        stiffness_(system.stiffness().subspan(part.firstTexel, part.texels)),
        first_(part.firstTexel),
        values_(values),
        scale_(stiffness_.begin(), stiffness_.end()) {
    for (const SeamSample& s : samples_)
      for (std::size_t k = 0; k < 8; ++k)
        scale_[s.texels[k] - first_] += double{s.share} * s.weights[k] * s.weights[k];
    for (double& d : scale_) d = 1. / std::sqrt(d);
    for (auto* list : {&x_, &gradient_, &constant_, &way_, &image_, &scratch_})
      list->resize(values.size());
  }

  std::uint64_t solve() {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_[i] = values_[i] / scale_[i];
      constant_[i] = scale_[i] * stiffness_[i] * values_[i];
    }
    findGradient();
    way_ = free();
    std::uint64_t n = 0;
    for (; n < kMostIterations && farthest() > kAgrees; ++n)
      if (proportional())
        descend();
      else
        letGo();
    if (n > 0)
      for (std::size_t i = 0; i < x_.size(); ++i) values_[i] = x_[i] * scale_[i];
    return n;
  }

 private:
  // image_ = matrix * of.
  void apply(std::span<const double> of) {
    for (std::size_t i = 0; i < of.size(); ++i) {
      scratch_[i] = scale_[i] * of[i];
      image_[i] = stiffness_[i] * scratch_[i];
    }
    for (const SeamSample& s : samples_) {
      double difference = 0.;
      for (std::size_t k = 0; k < 8; ++k)
        difference += s.weights[k] * scratch_[s.texels[k] - first_];
      difference *= s.share;
      for (std::size_t k = 0; k < 8; ++k) image_[s.texels[k] - first_] += s.weights[k] * difference;
    }
    for (std::size_t i = 0; i < of.size(); ++i) image_[i] *= scale_[i];
  }

  void findGradient() {
    apply(x_);
    for (std::size_t i = 0; i < x_.size(); ++i) gradient_[i] = image_[i] - constant_[i];
  }

  // The gradient where values are above 0, and where they are 0 and would rise.
  double freeAt(std::size_t i) const { return x_[i] > 0. ? gradient_[i] : 0.; }
  double heldAt(std::size_t i) const { return x_[i] > 0. ? 0. : std::min(gradient_[i], 0.); }
  std::vector<double> free() const {
    std::vector<double> list(x_.size());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = freeAt(i);
    return list;
  }

  double farthest() const {
    double largest = 0.;
    for (std::size_t i = 0; i < x_.size(); ++i)
      largest = std::max(largest, std::abs(freeAt(i) + heldAt(i)));
    return largest;
  }

  // Whether more is to be won by values above 0 than by those at 0.
  bool proportional() const {
    double held = 0., reduced = 0.;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      held += heldAt(i) * heldAt(i);
      reduced += std::min(x_[i] / kStep, freeAt(i)) * freeAt(i);
    }
    return held <= reduced;
  }

  void move(double by, std::span<const double> way) {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_[i] -= by * way[i];
      gradient_[i] -= by * image_[i];
    }
  }

  // One step of conjugate gradients, or as far as a value reaches 0 and then one along the
  // gradient.
  void descend() {
    apply(way_);
    const double bent = product(way_, image_), step = product(gradient_, way_) / bent;
    double most = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (way_[i] > 0.) most = std::min(most, x_[i] / way_[i]);
    move(std::min(step, most), way_);
    if (step <= most) {
      double turn = 0.;
      for (std::size_t i = 0; i < x_.size(); ++i) turn += freeAt(i) * image_[i];
      turn /= bent;
      for (std::size_t i = 0; i < x_.size(); ++i) way_[i] = freeAt(i) - turn * way_[i];
      return;
    }
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = std::max(x_[i] - kStep * freeAt(i), 0.);
    findGradient();
    way_ = free();
  }

  // One step of the values at 0 that would rise.
  void letGo() {
    std::vector<double> way(x_.size());
    for (std::size_t i = 0; i < x_.size(); ++i) way[i] = heldAt(i);
    apply(way);
    move(product(gradient_, way) / product(way, image_), way);
    way_ = free();
  }

  std::vector<SeamSample> samples_;
  std::span<const float> stiffness_;
  std::uint32_t first_;
  std::span<double> values_;
  std::vector<double> scale_;
  std::vector<double> x_, gradient_, constant_, way_, image_, scratch_;
};

}  // namespace

std::uint64_t solve(const SeamSystem& system, const SeamPart& part, std::span<double> values) {
  CHECK(values.size() == part.texels);
  return Solver(system, part, values).solve();
}

}  // namespace lucerna::bake
