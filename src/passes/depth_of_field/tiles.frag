// The largest circles in each tile of pixels.
#include "passes/depth_of_field/circle.glsl"
#include "passes/depth_of_field/tile.glsl"
#include "passes/depth_of_field/width.glsl"

uniform sampler2D depth;

// px: rg: of what is before the plane in focus, of what is behind it; ba: the same of narrow ones.
layout(location = 0) out vec4 largest;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * kTile;
  ivec2 end = min(first + kTile, textureSize(depth, 0));
  largest = vec4(0.0);
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      float circle = circleAt(texelFetch(depth, ivec2(x, y), 0).r);
      vec2 sides = vec2(-circle, circle);
      largest.rg = max(largest.rg, sides);
      if (!isWide(abs(circle))) largest.ba = max(largest.ba, sides);
    }
}
