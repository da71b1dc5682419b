// What both shaders of ShadowedLighting need: the surface, and the light that reaches it.
#include "render/read_gbuffer.glsl"
#include "render/shading.glsl"
#include "render/shadows.glsl"

#ifdef AMBIENT_VISIBILITY
uniform sampler2D ambientVisibility;
#endif

// The normal of the plane through the pixel and its neighbours, of each side the one that is nearer in
// depth: shading normals lean, and a plane moved off along them would shadow itself.
vec3 trueNormalW(ivec2 pixel, vec3 positionW) {
  ivec2 last = textureSize(depth, 0) - 1;
  float here = texelFetch(depth, pixel, 0).r;
  vec3 along[2];
  for (int axis = 0; axis < 2; ++axis) {
    ivec2 step = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
    ivec2 a = max(pixel - step, ivec2(0)), b = min(pixel + step, last);
    float depthA = texelFetch(depth, a, 0).r, depthB = texelFetch(depth, b, 0).r;
    bool takeA = b == pixel || (a != pixel && abs(depthA - here) < abs(depthB - here));
    ivec2 other = takeA ? a : b;
    vec3 otherV = positionVOf(ndcOfPixel(vec2(other) + 0.5), max(takeA ? depthA : depthB, 1e-30));
    along[axis] = (worldOfView(otherV) - positionW) * (takeA ? -1.0 : 1.0);
  }
  vec3 normalW = cross(along[0], along[1]);
  return normalW * inversesqrt(max(dot(normalW, normalW), 1e-30));
}

// The pixel's, for lightVisibility().
vec3 planeNormalW;

Surface shadowedSurface(ivec2 pixel) {
  Surface s = readSurface(pixel);
  planeNormalW = trueNormalW(pixel, s.positionW);
#ifdef AMBIENT_VISIBILITY
  s.occlusion *= texelFetch(ambientVisibility, pixel, 0).r;
#endif
  return s;
}

float lightVisibility(Surface s, uint light) {
  LightValues values = lights[light];
  vec3 toLightW = normalize(values.position.xyz - s.positionW * values.position.w);
  return shadowVisibility(light, s.positionW, planeNormalW, toLightW);
}
