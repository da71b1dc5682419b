// What the methods share: the surface at a pixel, and how pixels differ.
#include "render/normal_encoding.glsl"
#include "render/view.glsl"

uniform sampler2D depth;
uniform sampler2D normal;
uniform float radius;      // m
uniform float reach;       // px
uniform int sampleCount;
uniform vec4 rotations[16];  // cosine, sine, share of a turn

vec3 positionVAt(ivec2 pixel, float reversedDepth) {
  return positionVOf(ndcOfPixel(vec2(pixel) + 0.5), reversedDepth);
}

vec3 normalVAt(ivec2 pixel) { return decodeNormal(texelFetch(normal, pixel, 0).rg); }

// Pixels of the picture repeat every four by four, so that tiles join.
vec4 rotationAt(ivec2 pixel) {
  ivec2 p = (pixel + ivec2(view.window.xy)) & 3;
  return rotations[p.y * 4 + p.x];
}

// How far above the tangent plane counts: less may be rounding of depth and normal.
float nearestAbove(vec3 positionV) { return 0.002 * radius + 0.0005 * length(positionV); }

// Pixels that a metre covers at a place.
float pixelsPerMetre(vec3 positionV) {
  float w = (view.clipFromView * vec4(positionV, 1.0)).w;
  return 0.5 * view.size.y * view.clipFromView[1][1] / w;
}
