// The constants and kernels of FLIP. Section numbers: Andersson et al., "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020. Private to this folder.
#pragma once

#include "image/convolution.hpp"

namespace lucerna::flip {

// 4.1.1: contrast sensitivity of the eye to achromatic, red-green and blue-yellow patterns as sums
// of Gaussians; the last needs two, so its 2D kernel is the sum of two separable ones.
struct SpatialFilters {
  Kernel achromatic, redGreen;      // each sums to 1
  Kernel blueYellow1, blueYellow2;  // the sums of both 2D kernels make 1
};
SpatialFilters spatialFilters(float pixelsPerDegree);

// 4.2.1: first and second derivatives of a Gaussian as wide as the eye's feature detectors.
struct FeatureFilters {
  Kernel smooth, edge, point;
};
FeatureFilters featureFilters(float pixelsPerDegree);

}  // namespace lucerna::flip
