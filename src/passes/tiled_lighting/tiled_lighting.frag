// Shades one pixel of the G-buffer.
//   AMBIENT_VISIBILITY, BAKED_LIGHT  see render/read_gbuffer.glsl
//   TILE_LIGHTS         see render/tile_lights.glsl
//   SHADOWS             shadow maps say how much of each light arrives
//   SHADOW_FILTER, PLANE_COMPARISON, SHADOW_TRANSMISSION  see render/shadows.glsl
//   PREFILTERED_SHADOWS, LAYERED_SHADOWS, LAYERED_TRANSMITTANCE  see visibility.glsl
// variant: AMBIENT_VISIBILITY=1
// variant: BAKED_LIGHT=1
// variant: TILE_LIGHTS=1
// variant: SHADOWS=1
// variant: SHADOWS=1 SHADOW_FILTER=1
// variant: AMBIENT_VISIBILITY=1 TILE_LIGHTS=1 SHADOWS=1 SHADOW_FILTER=2
// variant: SHADOWS=1 PLANE_COMPARISON=1
// variant: SHADOWS=1 SHADOW_FILTER=2 PLANE_COMPARISON=1
// variant: SHADOWS=1 PREFILTERED_SHADOWS=1
// variant: TILE_LIGHTS=1 SHADOWS=1 PREFILTERED_SHADOWS=1 MOMENT_LEVELS=1
// variant: TILE_LIGHTS=1 SHADOWS=1 PLANE_COMPARISON=1 LAYERED_SHADOWS=4 ALL_IN_LAYERS=1
// variant: TILE_LIGHTS=1 SHADOWS=1 PLANE_COMPARISON=1 LAYERED_SHADOWS=2 SHADOW_TRANSMISSION=1 LAYERED_TRANSMITTANCE=1
// variant: SHADOWS=1 SHADOW_TRANSMISSION=1
// variant: SHADOWS=1 SHADOW_TRANSMISSION=1 LAYERED_SHADOWS=1 LAYERED_TRANSMITTANCE=1
// variant: SHADOWS=1 SHADOW_FILTER=2 SHADOW_TRANSMISSION=1
#ifdef SHADOWS
#define LIGHT_VISIBILITY
#endif
#include "render/read_gbuffer.glsl"
#include "render/shading.glsl"
#ifdef SHADOWS
#include "passes/tiled_lighting/visibility.glsl"
#endif

layout(location = 0) out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef SHADOWS
  Surface s = shadowedSurface(pixel);
#else
  Surface s = readSurface(pixel);
#endif
  if (s.type == kTypeCustom) discard;  // CustomShaders draws it, before or after
  color = vec4(shade(s), 1.0);
}
