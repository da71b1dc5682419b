// The tangent plane of a pixel's surface, and how far off it other pixels of the depth buffer lie.
#include "render/view.glsl"

struct TangentPlane {
  vec4 planeC;  // dot(planeC, c) / dot(wOfClip, c): distance in m of clip-space c = (ndc, reversed depth, 1)
  float stop;   // m: what is farther off is another surface
};

// m, across the view.
float pixelWidthAt(vec3 positionV) {
  float w = (view.clipFromView * vec4(positionV, 1.0)).w;
  return 2.0 * w / (view.size.y * view.clipFromView[1][1]);
}

// positionV, normalV (unit, of the true plane): of the pixel.
TangentPlane tangentPlaneAt(vec3 positionV, vec3 normalV, float stop) {
  return TangentPlane(vec4(normalV, -dot(normalV, positionV)) * view.viewFromClip, stop);
}

// Whether pixels at a depth lie on the plane; those where nothing was drawn are far away.
bvec4 onPlane(TangentPlane t, vec4 ndcX, vec4 ndcY, vec4 depths) {
  mat4 m = view.viewFromClip;
  vec4 off = t.planeC.x * ndcX + t.planeC.y * ndcY + t.planeC.z * depths + t.planeC.w;
  vec4 w = m[0][3] * ndcX + m[1][3] * ndcY + m[2][3] * depths + m[3][3];
  return lessThanEqual(abs(off), t.stop * abs(w));
}

bool onPlane(TangentPlane t, ivec2 pixel, float depth) {
  vec2 ndc = ndcOfPixel(vec2(pixel) + 0.5);
  return onPlane(t, vec4(ndc.x), vec4(ndc.y), vec4(depth)).x;
}
// The four pixels of a square, first.x and first.y its least, in the order of textureGather().
bvec4 onPlaneOfSquare(TangentPlane t, ivec2 first, vec4 depths) {
  vec2 ndc = ndcOfPixel(vec2(first) + 0.5), next = ndcOfPixel(vec2(first) + 1.5);
  return onPlane(t, vec4(ndc.x, next.x, next.x, ndc.x), vec4(next.y, next.y, ndc.y, ndc.y), depths);
}
