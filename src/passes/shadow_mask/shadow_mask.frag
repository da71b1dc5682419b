// A bit for each layer whose light is blocked.
// variant: TILE_LIGHTS=1
#include "render/layer_lookup.glsl"

layout(location = 0) out uint mask;

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  SurfacePixel s = surfaceAt(ivec2(pixel));
  mask = 0u;
  for (uint i = firstLightAt(pixel); i < lightCount.x; i = lightAfterAt(pixel, i)) {
    if (!mayShadow(i, s)) continue;
    float visible = shadowVisibility(i, s.positionW, s.planeNormalW, towardsLight(i, s.positionW));
    if (visible < 0.5) mask |= 1u << uint(lightLayers[i]);
  }
}
