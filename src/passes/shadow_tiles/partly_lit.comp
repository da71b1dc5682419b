// A thread for each tile: of its lights, those whose layer is blocked at some pixel of the tiles around and not at all.
#define READ_TILE_LIGHTS
#include "render/lights.glsl"
#include "render/shadow_layers.glsl"
#include "render/tile_lights.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer TileBitBlock { uvec2 tileBits[]; };
layout(std430) writeonly buffer PartlyLitBlock {  // as TileLightBlock
  uvec4 partlyLitGrid;
  uint partlyLitWords[];
};

uniform int tiles;
uniform int reach;  // tiles to all sides

void main() {
  if (gl_GlobalInvocationID.x >= uint(tiles)) return;
  ivec2 grid = ivec2(tileGrid.x, uint(tiles) / tileGrid.x);
  ivec2 tile = ivec2(gl_GlobalInvocationID.x % tileGrid.x, gl_GlobalInvocationID.x / tileGrid.x);
  ivec2 from = max(tile - reach, ivec2(0)), to = min(tile + reach, grid - 1);
  uvec2 around = uvec2(0u);
  for (int y = from.y; y <= to.y; ++y)
    for (int x = from.x; x <= to.x; ++x) around |= tileBits[y * grid.x + x];
  uint partly = around.x & around.y;
  if (gl_GlobalInvocationID.x == 0u) partlyLitGrid = tileGrid;
  for (uint word = 0u; word < tileGrid.y; ++word) {
    uint at = gl_GlobalInvocationID.x * tileGrid.y + word, bits = tileWords[at], chosen = 0u;
    for (uint bit = 0u; bit < 32u && word * 32u + bit < lightCount.x; ++bit) {
      int layer = lightLayers[word * 32u + bit];
      if (layer >= 0 && (partly >> uint(layer) & 1u) != 0u) chosen |= 1u << bit;
    }
    partlyLitWords[at] = bits & chosen;
  }
}
