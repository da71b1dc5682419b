// A thread for each tile: each of its lights overlaps all others of it.
#define READ_TILE_LIGHTS
#include "render/lights.glsl"
#include "render/tile_lights.glsl"

layout(local_size_x = 64) in;

layout(std430) buffer ConflictBlock { uint conflicts[]; };  // of each light, a bit for each other, as in a tile

uniform int tiles;

void main() {
  if (gl_GlobalInvocationID.x >= uint(tiles)) return;
  uint words = tileGrid.y, first = gl_GlobalInvocationID.x * words;
  for (uint light = 0u; light < lightCount.x; ++light) {
    if ((tileWords[first + light / 32u] >> (light % 32u) & 1u) == 0u) continue;
    for (uint word = 0u; word < words; ++word)
      if (tileWords[first + word] != 0u) atomicOr(conflicts[light * words + word], tileWords[first + word]);
  }
}
