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
  std::array<std::uint32_t, 8> texels{};  // four of each side, of SeamSystem::places
  std::array<float, 8> weights{};
  float share = 0.f;  // of a texel of the seam that it stands for
};

// Texels that no sample has in common lie in different parts.
struct SeamPart {
  std::uint32_t firstTexel = 0, texels = 0;
  std::uint32_t firstSample = 0, samples = 0;
};

struct SeamSystem {
  std::vector<TexelPlace> places;     // of each unknown, part by part
  std::vector<float> stiffness;       // of each: how much it counts that it stays as it is
  std::vector<SeamSample> samples;    // part by part
  std::vector<SeamSample> measuring;  // between those, to see what was achieved
  std::vector<SeamPart> parts;
  std::vector<std::uint32_t> order;  // unknowns by map, row, column
};

// points, between: as seamPoints() gives them, what is solved and what is measured. A texel that
// the scene does not touch was not lit itself: it may change more.
SeamSystem seamSystem(std::span<const Seam> seams, std::span<const SeamPoint> points,
                      std::span<const SeamPoint> between, const MapTexels& texels);

}  // namespace lucerna::bake
