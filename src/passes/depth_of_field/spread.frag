// The largest circles that may reach into each tile, from any. Of these once more: the largest by which a pixel
// is read that reads the tile, too.
#include "passes/depth_of_field/tile.glsl"

uniform sampler2D tiles;
uniform int reach;  // tiles to all sides

layout(location = 0) out vec4 largest;  // px, as in tiles.frag

void main() {
  ivec2 tile = ivec2(gl_FragCoord.xy);
  ivec2 first = max(tile - reach, ivec2(0)), last = min(tile + reach, textureSize(tiles, 0) - 1);
  largest = vec4(0.0);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      vec4 found = texelFetch(tiles, ivec2(x, y), 0);
      float between = length(vec2(max(abs(ivec2(x, y) - tile) - 1, 0) * kTile));
      largest = max(largest, mix(vec4(0.0), found, greaterThan(found, vec4(between))));
    }
}
