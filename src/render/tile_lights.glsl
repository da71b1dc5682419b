// The lights that may reach a pixel, in the order of LightBlock:
//   for (uint i = firstLightAt(pixel); i < lightCount.x; i = lightAfterAt(pixel, i))
//   TILE_LIGHTS        those of the pixel's tile; without, all lights
//   WRITE_TILE_LIGHTS  for the pass that finds them
//   READ_TILE_LIGHTS   for other uses of the tiles' bits
const uint kLightTile = 16u;  // px, side of a tile, as in render/tile_lights.hpp

#if defined(WRITE_TILE_LIGHTS) || defined(READ_TILE_LIGHTS) || defined(TILE_LIGHTS)
#ifdef WRITE_TILE_LIGHTS
layout(std430) writeonly buffer TileLightBlock {
#else
layout(std430) readonly buffer TileLightBlock {
#endif
  uvec4 tileGrid;    // tiles across; words that each tile has
  uint tileWords[];  // a bit for each light, 32 to a word
};
#endif

#ifdef TILE_LIGHTS
// All pixels of a tile go through their loops alike: see docs/dev/drivers.md.
uint lightFrom(uvec2 pixel, uint light) {
  uvec2 tile = pixel / kLightTile;
  uint first = (tile.y * tileGrid.x + tile.x) * tileGrid.y, word = light / 32u;
  uint bits = 0u, from = 0xffffffffu << (light % 32u);
  for (; word < tileGrid.y && bits == 0u; ++word) {
    bits = tileWords[first + word] & from;
    from = 0xffffffffu;
  }
  return bits == 0u ? 0xffffffffu : (word - 1u) * 32u + uint(findLSB(bits));
}
uint firstLightAt(uvec2 pixel) { return lightFrom(pixel, 0u); }
uint lightAfterAt(uvec2 pixel, uint light) { return lightFrom(pixel, light + 1u); }
#else
uint firstLightAt(uvec2 pixel) { return 0u; }
uint lightAfterAt(uvec2 pixel, uint light) { return light + 1u; }
#endif
