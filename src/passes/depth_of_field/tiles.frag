// The largest circles in each tile of pixels.
#include "passes/depth_of_field/circle.glsl"
#include "passes/depth_of_field/tile.glsl"

uniform sampler2D depth;

layout(location = 0) out vec2 largest;  // px: of what is before the plane in focus, of what is behind it

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * kTile;
  ivec2 end = min(first + kTile, textureSize(depth, 0));
  float nearest = 0.0, farthest = 1.0;  // reversed depths: these have the largest circles
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      float found = texelFetch(depth, ivec2(x, y), 0).r;
      nearest = max(nearest, found);
      farthest = min(farthest, found);
    }
  largest = max(vec2(-circleAt(nearest), circleAt(farthest)), 0.0);
}
