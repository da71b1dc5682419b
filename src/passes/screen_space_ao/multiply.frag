// The factor of a pixel's colour, which blending multiplies by it.
uniform sampler2D visibility;

layout(location = 0) out vec4 factor;

void main() { factor = vec4(vec3(texelFetch(visibility, ivec2(gl_FragCoord.xy), 0).r), 1.0); }
