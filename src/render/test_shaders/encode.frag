// Stores the directions of a texture as the G-buffer stores normals.
#include "render/normal_encoding.glsl"

uniform sampler2D directions;

layout(location = 0) out vec2 encoded;

void main() { encoded = encodeNormal(texelFetch(directions, ivec2(gl_FragCoord.xy), 0).xyz); }
