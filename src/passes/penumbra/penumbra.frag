// The width of each layer's penumbra.
//   ARRAY_LAYERS, NEAREST_BLOCKERS, SHARED_LAYERS, TILE_LIGHTS  see render/layer_widths.glsl
// variant: ARRAY_LAYERS=3
// variant: SHARED_LAYERS=1
// variant: ARRAY_LAYERS=8 TILE_LIGHTS=1 NEAREST_BLOCKERS=1
#ifndef ARRAY_LAYERS
#define ARRAY_LAYERS 1
#endif
#include "render/layer_widths.glsl"

uniform int scale;  // px of the picture for each

layout(location = 0) out vec4 widths[ARRAY_LAYERS];  // m

void main() {
  float width[4 * ARRAY_LAYERS];
  findWidths(uint(scale) * uvec2(gl_FragCoord.xy), width);
  for (int i = 0; i < ARRAY_LAYERS; ++i)
    widths[i] = vec4(width[4 * i], width[4 * i + 1], width[4 * i + 2], width[4 * i + 3]);
}
