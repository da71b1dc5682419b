// Moments of the depths in a shadow map, a texel for each square of its texels.
//   TEXELS  of the map along each side of a square: 1, 2 or 4
// variant: TEXELS=1
// variant: TEXELS=4
#ifndef TEXELS
#define TEXELS 2
#endif
#include "render/moments.glsl"

uniform sampler2DArray shadowMaps;  // depth
uniform int layer;
uniform ivec2 corner;  // of the map in its layer
uniform ivec2 side;    // of the map; texels
uniform bool directional;
uniform float lampShare;  // see momentDepth()

layout(location = 0) out vec4 moments;

vec4 momentsOfDepth(float depth) { return momentsOf(momentDepth(directional, lampShare, depth)); }

void main() {
  ivec2 first = TEXELS * ivec2(gl_FragCoord.xy);
#if TEXELS == 1
  moments = momentsOfDepth(texelFetch(shadowMaps, ivec3(corner + min(first, side - 1), layer), 0).r);
#else
  // Four depths at a time: on the software rasteriser a fifth of the time of each by itself.
  moments = vec4(0.0);
  vec2 texel = 1.0 / vec2(textureSize(shadowMaps, 0).xy);
  for (int y = 1; y < TEXELS; y += 2)
    for (int x = 1; x < TEXELS; x += 2) {
      ivec2 middle = corner + min(first + ivec2(x, y), side - 1);
      vec4 depths = textureGather(shadowMaps, vec3(vec2(middle) * texel, float(layer)));
      for (int i = 0; i < 4; ++i) moments += momentsOfDepth(depths[i]) / float(TEXELS * TEXELS);
    }
#endif
}
