// Reads directions back from how the G-buffer stores normals.
#include "render/normal_encoding.glsl"

uniform sampler2D encoded;

layout(location = 0) out vec4 direction;

void main() {
  direction = vec4(decodeNormal(texelFetch(encoded, ivec2(gl_FragCoord.xy), 0).rg), 1.0);
}
