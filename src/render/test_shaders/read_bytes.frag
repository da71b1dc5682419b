// The bytes as numbers.
uniform usampler2D bytes;

layout(location = 0) out vec4 numbers;

void main() { numbers = vec4(texelFetch(bytes, ivec2(gl_FragCoord.xy), 0)); }
