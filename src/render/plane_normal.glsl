// The true plane of a surface, from the depth buffer. Who includes this has `uniform sampler2D depth`, reversed.
#include "render/view.glsl"

// Where nothing was drawn, some place far away.
vec3 positionWOf(ivec2 pixel) {
  float reversedDepth = max(texelFetch(depth, pixel, 0).r, 1e-9);
  return worldOfView(positionVOf(ndcOfPixel(vec2(pixel) + 0.5), reversedDepth));
}

bool isEmpty(ivec2 pixel) { return texelFetch(depth, pixel, 0).r == 0.0; }

// Both sides are as good if they differ by less; rounding then does not choose.
const float kSameSide = 1e-3;

// The way along the surface from the pixel to one of two opposite neighbours: to the one that is more
// across the shading normal, for the other may show another surface.
vec3 alongSurface(vec3 positionW, vec3 normalW, ivec2 pixel, ivec2 side) {
  ivec2 last = textureSize(depth, 0) - 1;
  ivec2 next = clamp(pixel + side, ivec2(0), last), before = clamp(pixel - side, ivec2(0), last);
  vec3 forward = positionWOf(next) - positionW, backward = positionW - positionWOf(before);
  // Beyond the picture's edge, and where nothing was drawn, there is no neighbour.
  float a = isEmpty(next) ? 0.0 : dot(forward, forward), b = isEmpty(before) ? 0.0 : dot(backward, backward);
  float offA = a > 0.0 ? abs(dot(forward, normalW)) * inversesqrt(a) : 2.0;
  float offB = b > 0.0 ? abs(dot(backward, normalW)) * inversesqrt(b) : 2.0;
  return offA <= offB + kSameSide ? forward : backward;
}

// The normal of the plane through the pixel and its neighbours: shading normals lean, and a plane
// moved off along them would shadow itself. positionW, normalW: of the pixel, normalW for shading.
vec3 planeNormalOf(ivec2 pixel, vec3 positionW, vec3 normalW) {
  vec3 planeNormalW = cross(alongSurface(positionW, normalW, pixel, ivec2(1, 0)),
                            alongSurface(positionW, normalW, pixel, ivec2(0, 1)));
  float squared = dot(planeNormalW, planeNormalW);
  return squared > 0.0 ? planeNormalW * inversesqrt(squared) : normalW;
}
