// Darkens a pixel of an object that was drawn by its own shader: nobody knows how that uses the light,
// so the picture loses the share that a white Phong surface in its place would lose.
//   AMBIENT_VISIBILITY, BAKED_LIGHT  see render/read_gbuffer.glsl
//   TILE_LIGHTS         see render/tile_lights.glsl
//   SHADOW_FILTER, PLANE_COMPARISON, SHADOW_TRANSMISSION  see render/shadows.glsl
//   PREFILTERED_SHADOWS, LAYERED_SHADOWS, LAYERED_TRANSMITTANCE  see visibility.glsl
// variant: AMBIENT_VISIBILITY=1 TILE_LIGHTS=1
// variant: BAKED_LIGHT=1
// variant: TILE_LIGHTS=1 PLANE_COMPARISON=1 LAYERED_SHADOWS=2
#define LIGHT_VISIBILITY
#include "passes/tiled_lighting/visibility.glsl"

layout(location = 0) out vec4 factor;  // multiplies what is there

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = shadowedSurface(pixel);
  if (s.type != kTypeCustom) discard;
  vec3 lit = ambientScale * ambientLight.rgb * s.occlusion;
#ifdef BAKED_LIGHT
  lit += s.bakedIrradiance / kPi;
#endif
  vec3 shadowed = lit;
  for (uint i = firstLightAt(uvec2(pixel)); i < lightCount.x; i = lightAfterAt(uvec2(pixel), i)) {
    if (!mayLight(lights[i], s.positionW, s.normalW)) continue;
    LightSample light = sampleLight(lights[i], s.positionW);
    vec3 diffuse = light.irradiance * max(dot(s.normalW, light.toLightW), 0.0) / kPi;
    lit += diffuse;
    shadowed += diffuse * lightVisibility(s, i);
  }
  factor = vec4(mix(vec3(1.0), shadowed / max(lit, 1e-9), greaterThan(lit, vec3(1e-9))), 1.0);
}
