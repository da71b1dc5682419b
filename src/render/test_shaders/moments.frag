// The share and the mean of depths before one that their moments tell.
#include "render/moments.glsl"

uniform sampler2D moments;
uniform sampler2D depths;

layout(location = 0) out vec4 result;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  DepthsBefore before = depthsBefore(texelFetch(moments, texel, 0), texelFetch(depths, texel, 0).r);
  result = vec4(before.share, before.mean, 0.0, 0.0);
}
