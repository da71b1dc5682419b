// Writes the world position of the depth at each pixel.
#include "render/view.glsl"

uniform sampler2D depth;

layout(location = 0) out vec4 position;

void main() {
  float reversedDepth = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
  vec3 positionV = positionVOf(ndcOfPixel(gl_FragCoord.xy), reversedDepth);
  position = vec4(worldOfView(positionV), 1.0);
}
