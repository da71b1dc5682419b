// The grid of pixels that is read of a circle: all of them of a narrow one, of a wide one every second, fourth, ...
// along both axes. What is read so is smooth enough that nothing falls between.
#include "passes/depth_of_field/circle.glsl"
#include "passes/depth_of_field/tile.glsl"
#include "passes/depth_of_field/width.glsl"

uniform sampler2D largest;  // px: of each tile, the largest circles that may reach into it: tiles.frag

vec2 largestAt(ivec2 pixel) { return texelFetch(largest, pixel / kTile, 0).rg; }
vec2 largestNarrowAt(ivec2 pixel) { return texelFetch(largest, pixel / kTile, 0).ba; }

// The widest stride with which a pixel may be read: by a power of two, it is smooth enough for all others.
float widestStride(ivec2 pixel) {
  vec2 radius = largestAt(pixel);
  return strideOf(max(radius.x, radius.y));
}

// px over which the light of a circle is smoothed: the stride, but not so much that it shows.
float smoothingOf(float radius, float stride) { return clamp(0.5 * radius, 1.0, stride); }

// The circle that is as large as this one when its light has been smoothed, px: variances add up, that of a disc
// being radius^2 / 4 and that of a tent (width^2 - 1) / 6.
float unsmoothed(float radius, float stride) {
  float width = smoothingOf(radius, stride);
  return sqrt(max(radius * radius - (width * width - 1.0) / 1.5, 0.0));
}
