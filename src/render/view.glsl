// The view that is drawn, and positions from its depth.
//   SHADOW_VIEWS  the view is one of those of render/shadow_views.glsl, which comes before
#include "render/blocks.glsl"

#ifndef SHADOW_VIEWS
layout(std140) uniform ViewBlock { ViewValues view; };
#endif

// A pixel's place in the whole picture, of which a tile shows a window: (0, 0) is the lower left corner.
// fragCoord as gl_FragCoord gives it (centres are at .5, row 0 is the bottom). Whatever depends on the
// place goes by this, so that tiles join.
vec2 pictureUv(vec2 fragCoord) { return (fragCoord + view.window.xy) * view.size.zw; }

// Normalised device coordinates of the whole picture at a pixel's centre.
vec2 ndcOfPixel(vec2 fragCoord) { return pictureUv(fragCoord) * 2.0 - 1.0; }

// What a vertex shader gives to gl_Position, for the viewport of render::ViewData. That is the whole
// picture unless the picture is too large for one, and nothing changes.
vec4 windowPosition(vec4 positionV) {
  vec4 clip = view.clipFromView * positionV;
  clip.xy = clip.xy * view.viewportFromClip.xy + clip.w * view.viewportFromClip.zw;
  return clip;
}

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
