// What makes seams agree, as least squares: for points along each seam, what a bilinear lookup
// reads on one side less what it reads on the other, and the texels that these lookups read.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "bake/assemble.hpp"
#include "bake/seam_points.hpp"

namespace lucerna::bake {

struct TexelPlace {
  std::uint16_t map = 0, x = 0, y = 0;
  auto operator<=>(const TexelPlace& other) const {
    return std::tuple(map, y, x) <=> std::tuple(other.map, other.y, other.x);
  }
  bool operator==(const TexelPlace&) const = default;
};

// Sum of weights[i] * value of texels[i]: one side's light less the other's.
struct SeamSample {
  std::array<std::uint32_t, 8> texels{};  // unknowns: four of each side
  std::array<float, 8> weights{};
  float share = 0.f;  // of a texel of the seam that it stands for
};

// Texels that no sample has in common lie in different parts.
struct SeamPart {
  std::uint32_t firstTexel = 0, texels = 0;
  std::uint32_t firstPoint = 0, points = 0;
};

// Numbers of marked texels by map, row and column.
class TexelNumbers {
 public:
  TexelNumbers() = default;
  TexelNumbers(std::size_t maps, int side);

  void mark(TexelPlace p) { words_[word(p)] |= std::uint64_t{1} << bit(p); }
  // After the last mark: where the marked ones are.
  std::vector<TexelPlace> count();

  bool isMarked(TexelPlace p) const { return (words_[word(p)] >> bit(p) & 1) != 0; }
  std::uint32_t number(TexelPlace p) const;

 private:
  std::size_t texel(TexelPlace p) const { return p.y * side_ + p.x; }
  std::size_t word(TexelPlace p) const { return p.map * wordsPerMap_ + texel(p) / 64; }
  std::size_t bit(TexelPlace p) const { return texel(p) % 64; }

  std::size_t side_ = 0, wordsPerMap_ = 0;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> before_;  // of each word: how many are marked in earlier ones
};

// Samples are made when they are asked for, as they take six times as much memory as points.
class SeamSystem {
 public:
  // points, between: as seamPoints() gives them, what is solved and what is measured. A texel that
  // the scene does not touch was not lit itself: it may change more.
  SeamSystem(std::vector<Seam> seams, std::vector<SeamPoint> points, std::vector<SeamPoint> between,
             const MapTexels& texels);

  std::size_t seamCount() const { return seams_.size(); }
  std::span<const TexelPlace> places() const { return places_; }  // of each unknown, part by part
  // Of each unknown: how much it counts that it stays as it is.
  std::span<const float> stiffness() const { return stiffness_; }
  std::span<const SeamPart> parts() const { return parts_; }
  std::span<const SeamPoint> points() const { return points_; }    // part by part
  std::span<const SeamPoint> between() const { return between_; }  // to see what was achieved

  // kNone: lookups along seams do not read that texel.
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t unknownAt(TexelPlace place) const;
  std::uint32_t partOf(std::uint32_t unknown) const;
  SeamSample sampleAt(const SeamPoint& point) const;
  std::vector<SeamSample> samplesOf(const SeamPart& part) const;

 private:
  void findParts();

  int side_;
  std::vector<Seam> seams_;
  std::vector<SeamPoint> points_, between_;
  TexelNumbers numbers_;
  std::vector<std::uint32_t> order_;  // the unknown of each number
  std::vector<TexelPlace> places_;
  std::vector<float> stiffness_;
  std::vector<SeamPart> parts_;
};

}  // namespace lucerna::bake
