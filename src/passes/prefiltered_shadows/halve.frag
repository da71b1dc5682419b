// A level of moments from the one before: blurred by a variance of 3/4 along each axis, and halved.
uniform sampler2DArray levels;
uniform int layer;
uniform int finer;  // the level before
uniform ivec2 corner;  // of the map there, texels
uniform ivec2 side;

layout(location = 0) out vec4 moments;

const float kWeights[4] = float[](1.0 / 8.0, 3.0 / 8.0, 3.0 / 8.0, 1.0 / 8.0);

void main() {
  ivec2 first = 2 * ivec2(gl_FragCoord.xy) - 1, last = corner + side - 1;
  moments = vec4(0.0);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      ivec2 texel = clamp(first + ivec2(x, y), corner, last);
      moments += kWeights[x] * kWeights[y] * texelFetch(levels, ivec3(texel, layer), finer);
    }
}
