// A bake as pictures to look at: U8 RGB, one pixel a texel.
#pragma once

#include "image/image.hpp"
#include "lightmap/chart_texels.hpp"
#include "lightmap/patch.hpp"

namespace lucerna::lightmap {

// What a white surface shows: irradiance / pi, times `factor`, by c / (1 + c), as sRGB.
Image tonePicture(const Image& map, float factor);

// Each chart in a colour of its own, by its number.
Image chartPicture(const ChartTexels& texels);

// Green: on the scene. Yellow: beside it, for filters. Grey: empty. Red: two charts overlap.
// Violet: the map's value is negative or no number.
Image validityPicture(const ChartTexels& texels, const Image& map);

// Charts dark grey, their borders white.
Image seamPicture(const ChartTexels& texels);

// Texels a metre by heatMap() of image/metrics.hpp: from a quarter of `wanted`, black, to four
// times, pale.
Image densityPicture(const Layout& layout, int map,
                     const std::vector<std::vector<float>>& densities, float wanted);

// Each triangle of the patch in a colour of its own, its tiles' texels grey by their light.
Image patchPicture(const Patch& patch, int map);
bool lights(const Patch& patch, int map);

}  // namespace lucerna::lightmap
