// Mean over four pixels along one axis; twice, it takes away the pattern of the four by four rotations.
#include "render/view.glsl"

uniform sampler2D visibility;
uniform sampler2D depth;
uniform ivec2 direction;
uniform bool bilateral;  // only over pixels of about the same distance

layout(location = 0) out float blurred;

float distanceAt(ivec2 pixel) {
  float found = texelFetch(depth, pixel, 0).r;
  return found == 0.0 ? 1e30 : -positionVOf(ndcOfPixel(vec2(pixel) + 0.5), found).z;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(visibility, 0) - 1;
  float here = bilateral ? distanceAt(pixel) : 0.0;
  float sum = 0.0, weights = 0.0;
  for (int i = -2; i < 2; ++i) {
    ivec2 there = clamp(pixel + i * direction, ivec2(0), last);
    float weight = !bilateral || abs(distanceAt(there) - here) < 0.02 * here ? 1.0 : 0.0;
    sum += weight * texelFetch(visibility, there, 0).r;
    weights += weight;
  }
  blurred = sum / weights;
}
