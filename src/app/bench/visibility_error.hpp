// How far one light's visibility, as a method shows it, is from that of a reference.
#pragma once

#include <optional>

#include "image/image.hpp"
#include "scene/view.hpp"

namespace lucerna::app::bench {

// What of a light reaches each pixel's surface, 0 to 1, and which pixels count: F32 and U8, one
// channel each.
struct VisibilityPair {
  const Image& reference;
  const Image& test;
  const Image& lit;  // 0: the light would not reach the pixel anyhow
};

struct PenumbraError {
  double flip = 0, psnr = 0, ssim = 0;
};
// Over the pixels whose reference is between 0.02 and 0.98; none if they are fewer than `fewest`.
// FLIP is that of the values as an eye sees them on a screen, grey.
std::optional<PenumbraError> penumbraError(const VisibilityPair& pair, int fewest = 64);

// Sums over pixels, so that those of several lights can be added.
struct ShadowFaults {
  double lit = 0;              // pixels that count
  double dark = 0, leak = 0;   // whose reference is 0; visibility there
  double clear = 0, loss = 0;  // whose reference is 1; what is missing there
  double halo = 0;             // near an edge, and wrong by more than 0.1

  void add(const ShadowFaults& other);
  // Shares in percent; 0 where there is nothing to share.
  double leakPercent() const;         // mean visibility where there is none
  double falseShadowPercent() const;  // mean shadow where there is none
  double haloPercent() const;         // of all pixels that count
};
// nearEdge: U8, not 0 near edges of depth.
ShadowFaults shadowFaults(const VisibilityPair& pair, const Image& nearEdge);

// Which pixels are at most `within` pixels (along rows and columns) from an edge: from one pixel to
// the next the depth continues neither side's plane by more than a fiftieth. reversedDepth: F32, 0
// where there is nothing; it is linear over a plane's picture. Returns U8, 255 there.
Image nearDepthEdges(const Image& reversedDepth, int within);

// How far three pictures in equal steps of time are from a steady change: the mean of |before -
// 2 now + after| over all pixels and channels. F32, of one size.
double flickerOf(const Image& before, const Image& now, const Image& after);

// Largest difference of two visibilities where lit.
double largestDifference(const Image& a, const Image& b, const Image& lit);

// The width in m of the penumbra that a walk from `litW` to `darkW` crosses, by where visibility
// passes 3/4 and 1/4: behind an edge a disc's light falls from one to the other within 0.404 of the
// whole. The walk begins and ends as far again outside. None if it leaves the picture or does not
// pass them.
std::optional<double> penumbraWidth(const Image& visibility, const scene::View& view, vec3 litW,
                                    vec3 darkW);

}  // namespace lucerna::app::bench
