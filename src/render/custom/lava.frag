// Molten rock: a dark crust that is lit, and between its plates a glow that creeps and breathes.
#include "render/custom_shader.glsl"

uniform float plates = 5.0;                  // per metre
uniform float speed = 0.05;                  // creep in m/s
uniform vec3 glow = vec3(5.0, 1.1, 0.12);    // radiance of the cracks
uniform sampler2D grain;                     // r: tileable noise

vec3 hashed(vec3 cell) {
  uvec3 h = uvec3(ivec3(cell)) * uvec3(1597334673u, 3812015801u, 2798796415u);
  uint n = (h.x ^ h.y ^ h.z) * 1597334673u;
  uvec3 three = n * uvec3(1u, 1664525u, 22695477u);
  return vec3(three >> 8) / 16777216.0;
}

// Distances to the nearest and second nearest of points strewn one a cell (Worley, SIGGRAPH 1996),
// and a number of the nearest one's own.
vec3 plateAt(vec3 p) {
  vec3 cell = floor(p), f = p - cell;
  vec3 result = vec3(9.0, 9.0, 0.0);
  for (int i = 0; i < 27; ++i) {
    vec3 offset = vec3(i % 3, (i / 3) % 3, i / 9) - 1.0;
    vec3 strewn = hashed(cell + offset);
    float d = distance(offset + strewn, f);
    if (d < result.x) {
      result = vec3(d, result.x, strewn.x);
    } else {
      result.y = min(result.y, d);
    }
  }
  return result;
}

vec3 radianceOf(Surface s) {
  float fine = texture(grain, texCoords.xy * 2.0).r;
  float coarse = texture(grain, texCoords.xy * 0.5 + 0.02 * time).r;
  vec3 warp = 0.35 * vec3(coarse - 0.5, fine - 0.5, coarse - fine);
  vec3 plate = plateAt(objectPositionO * plates + warp + vec3(0.0, speed * time * plates, 0.0));
  float crack = plate.y - plate.x;
  float breath = 0.75 + 0.25 * sin(time * 1.7 + 6.2832 * plate.z);
  float heat = exp(-22.0 * crack) + 0.12 * exp(-5.0 * crack) * coarse;
  s.albedo = mix(vec3(0.035, 0.03, 0.03), vec3(0.13, 0.11, 0.10), fine) * (0.6 + 0.8 * plate.z);
  s.roughness = 0.55 + 0.4 * fine;
  return shade(s) + glow * heat * breath;
}
