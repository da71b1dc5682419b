// A bit for each layer whose light is blocked.
//   TILE_LIGHTS       see render/tile_lights.glsl
//   PLANE_COMPARISON  see render/shadows.glsl
//   PUBLISHED         bits are packed and unpacked as in system C
// variant: PLANE_COMPARISON=1
// variant: TILE_LIGHTS=1 PLANE_COMPARISON=1
// variant: PLANE_COMPARISON=1 PUBLISHED=1
#include "render/layer_lookup.glsl"

layout(location = 0) out uint mask;

#ifdef PUBLISHED
// Four layers as sixteenths in a byte of a texture, unpacked by the integer below sixteen times what is read (system C,
// section 7). From nine on a pattern comes back as the one before: bytes are shares of 255, not of 256.
uint throughBytes(uint bits) {
  uint unpacked = 0u;
  for (uint first = 0u; first < 32u; first += 4u) {
    float stored = floor(255.0 * float(bits >> first & 15u) / 16.0 + 0.5) / 255.0;
    unpacked |= uint(16.0 * stored) << first;
  }
  return unpacked;
}
#endif

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  SurfacePixel s = surfaceAt(ivec2(pixel));
  mask = 0u;
  for (uint i = firstLightAt(pixel); i < lightCount.x; i = lightAfterAt(pixel, i)) {
    if (!mayShadow(i, s)) continue;
    float visible = shadowVisibility(i, s.positionW, s.planeNormalW, towardsLight(i, s.positionW));
    if (visible < 0.5) mask |= 1u << uint(lightLayers[i]);
  }
#ifdef PUBLISHED
  mask = throughBytes(mask);
#endif
}
