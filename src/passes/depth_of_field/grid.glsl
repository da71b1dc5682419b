// The grid of pixels that is read of a circle: all of them of a narrow one, of a wide one every second, fourth, ...
// along both axes. What is read so is smooth enough that nothing falls between.
#include "passes/depth_of_field/circle.glsl"
#include "passes/depth_of_field/tile.glsl"
#include "passes/depth_of_field/width.glsl"

// px, of each tile: see tiles.frag.
uniform sampler2D largest;  // the largest circles that may reach into it
uniform sampler2D widest;   // the largest of what may be read together with it

vec2 largestAt(ivec2 pixel) { return texelFetch(largest, pixel / kTile, 0).rg; }
vec2 largestNarrowAt(ivec2 pixel) { return texelFetch(largest, pixel / kTile, 0).ba; }

// The widest stride with which a pixel may be read: by a power of two, it is smooth enough for all others.
float widestStride(ivec2 pixel) {
  vec2 radius = texelFetch(widest, pixel / kTile, 0).rg;
  return strideOf(max(radius.x, radius.y));
}

// The circle that is as large as this one when its light has been smoothed, px: variances add up, that of a disc
// being radius^2 / 4 and that of a tent as wide as the stride (stride^2 - 1) / 6.
float unsmoothed(float radius, float stride) {
  return sqrt(max(radius * radius - (stride * stride - 1.0) / 1.5, 0.0));
}
