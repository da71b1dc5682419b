// What prefiltered shadow maps (render/prefiltered_shadows.hpp) say of a point: how much of a light reaches it.
#include "render/moments.glsl"
#include "render/shadows.glsl"

uniform sampler2DArray directionalMoments;
uniform sampler2DArray localMoments;
uniform float momentTexels;  // of a shadow map, along each side of a texel of moments

// Where the moments around a place of a map are.
vec3 momentPlace(ShadowMapValues map, vec2 uv, int textureSide) {
  return vec3(uv / (map.texel.z * momentTexels * float(textureSide)), float(map.place.x));
}

vec4 momentsAt(ShadowMapValues map, vec2 uv) {
  return isDirectional(map)
             ? textureLod(directionalMoments, momentPlace(map, uv, textureSize(directionalMoments, 0).x), 0.0)
             : textureLod(localMoments, momentPlace(map, uv, textureSize(localMoments, 0).x), 0.0);
}

// As shadowVisibility(). shadowReach: the standard deviation of what a texel of moments holds: depths of the point's own
// plane are then one deviation and more behind it, and none of them can be taken for a blocker.
float prefilteredVisibility(uint light, vec3 positionW, vec3 normalW, vec3 toLightW) {
  ShadowLookup at = lookUpShadow(light, positionW, normalW, toLightW);
  if (!at.found) return 1.0;
  float z = momentDepth(isDirectional(at.map), at.map.inner.z, at.uvDepth.z);
  return 1.0 - leastShareBelow(momentsAt(at.map, at.uvDepth.xy), z);
}
