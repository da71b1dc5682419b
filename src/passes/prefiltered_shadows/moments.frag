// Moments of the depths in a shadow map, a texel for each square of its texels.
#include "render/moments.glsl"

uniform sampler2DArray shadowMaps;  // depth
uniform int layer;
uniform ivec2 corner;  // of the map in its layer
uniform ivec2 side;    // of the map; texels
uniform int texels;    // along each side of a square
uniform bool directional;
uniform float lampShare;  // see momentDepth()

layout(location = 0) out vec4 moments;

void main() {
  ivec2 first = texels * ivec2(gl_FragCoord.xy);
  moments = vec4(0.0);
  for (int y = 0; y < texels; ++y)
    for (int x = 0; x < texels; ++x) {
      ivec2 texel = corner + min(first + ivec2(x, y), side - 1);
      moments += momentsOf(momentDepth(directional, lampShare, texelFetch(shadowMaps, ivec3(texel, layer), 0).r));
    }
  moments /= float(texels * texels);
}
