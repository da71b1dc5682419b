// One axis of a separable blur of a map's moments.
uniform sampler2D unblurred;  // the map's lower left corner is the texture's
uniform ivec2 side;           // of the map, texels: taps beyond it are those of its edge
uniform ivec2 corner;         // of the map in what is drawn to
uniform ivec2 axis;
uniform int taps;           // on either side
uniform float weights[24];  // of a tap by its distance; they add up to 1

layout(location = 0) out vec4 moments;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy) - corner;
  moments = weights[0] * texelFetch(unblurred, texel, 0);
  for (int i = 1; i <= taps; ++i)
    moments += weights[i] * (texelFetch(unblurred, max(texel - i * axis, 0), 0) +
                             texelFetch(unblurred, min(texel + i * axis, side - 1), 0));
}
