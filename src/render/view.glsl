// The view that is drawn, and positions from its depth.
#include "render/blocks.glsl"

layout(std140) uniform ViewBlock { ViewValues view; };

// Normalised device coordinates of a pixel's centre; fragCoord as gl_FragCoord gives it (centres are
// at .5, row 0 is the bottom).
vec2 ndcOfPixel(vec2 fragCoord) { return fragCoord * view.size.zw * 2.0 - 1.0; }

// The view-space position at reversed depth `depth` (1 near, 0 far). Uses the whole inverse
// projection, so off-axis windows and orthographic views need nothing special. With an infinite far
// plane depth 0 has no position.
vec3 positionVOf(vec2 ndc, float depth) {
  vec4 p = view.viewFromClip * vec4(ndc, depth, 1.0);
  return p.xyz / p.w;
}

vec3 worldOfView(vec3 positionV) { return (view.worldFromView * vec4(positionV, 1.0)).xyz; }

// Unit vector from a surface point to the eye.
vec3 toEyeFrom(vec3 positionW) { return normalize(view.eyeW.xyz - positionW * view.eyeW.w); }

// Direction (not normalised) in which the eye looks through a pixel.
vec3 lookDirectionW(vec2 ndc) {
  vec4 p = view.viewFromClip * vec4(ndc, 1.0, 1.0);
  vec3 directionV = view.eyeW.w == 1.0 ? p.xyz / p.w : vec3(0.0, 0.0, -1.0);
  return mat3(view.worldFromView) * directionV;
}
