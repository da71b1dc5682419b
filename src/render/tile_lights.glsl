// The lights that may reach a pixel, in the order of LightBlock:
//   for (uint i = firstLight(); i < lightCount.x; i = lightAfter(i))
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
uint lightFrom(uint light) {
  uvec2 tile = uvec2(gl_FragCoord.xy) / kLightTile;
  uint first = (tile.y * tileGrid.x + tile.x) * tileGrid.y, word = light / 32u;
  uint bits = 0u, from = 0xffffffffu << (light % 32u);
  for (; word < tileGrid.y && bits == 0u; ++word) {
    bits = tileWords[first + word] & from;
    from = 0xffffffffu;
  }
  return bits == 0u ? 0xffffffffu : (word - 1u) * 32u + uint(findLSB(bits));
}
uint firstLight() { return lightFrom(0u); }
uint lightAfter(uint light) { return lightFrom(light + 1u); }
#else
uint firstLight() { return 0u; }
uint lightAfter(uint light) { return light + 1u; }
#endif
