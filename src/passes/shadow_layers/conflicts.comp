// A thread for each tile: each of its lights overlaps all others of it and of the tiles around.
#define READ_TILE_LIGHTS
#include "render/lights.glsl"
#include "render/tile_lights.glsl"

layout(local_size_x = 64) in;

layout(std430) buffer ConflictBlock { uint conflicts[]; };  // of each light, a bit for each other, as in a tile

uniform int tiles;
uniform int reach;  // tiles to all sides

void main() {
  if (gl_GlobalInvocationID.x >= uint(tiles)) return;
  uint words = tileGrid.y, first = gl_GlobalInvocationID.x * words;
  ivec2 grid = ivec2(tileGrid.x, uint(tiles) / tileGrid.x);
  ivec2 tile = ivec2(gl_GlobalInvocationID.x % tileGrid.x, gl_GlobalInvocationID.x / tileGrid.x);
  ivec2 from = max(tile - reach, ivec2(0)), to = min(tile + reach, grid - 1);
  for (uint word = 0u; word < words; ++word) {
    uint around = 0u;
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) around |= tileWords[uint(y * grid.x + x) * words + word];
    if (around == 0u) continue;
    for (uint light = 0u; light < lightCount.x; ++light)
      if ((tileWords[first + light / 32u] >> (light % 32u) & 1u) != 0u)
        atomicOr(conflicts[light * words + word], around);
  }
}
