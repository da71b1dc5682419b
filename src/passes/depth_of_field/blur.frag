// One direction of system A's blur, on a smaller picture. The weights are a disc's chords: an edge across the
// direction is blurred as by the circle of confusion.
#include "passes/depth_of_field/circle.glsl"

uniform sampler2D picture;
uniform sampler2D depth;
uniform float scale;     // of the smaller picture
uniform vec2 uvOfPixel;  // of the smaller picture, in the picture that is read
uniform vec2 direction;

layout(location = 0) out vec4 blurred;

// The radius of the disc in pixels of the smaller picture. The last chord's pixel blurs, too, by a variance of 1/12; so
// do making the picture smaller and larger again, if it is, by those of linear filtering, 1/6 each. A disc's variance is a
// quarter of radius^2.
float radiusAt(ivec2 pixel) {
  float circle = circleAt(texelFetch(depth, pixel, 0).r) * scale;
  float resampling = scale < 1.0 ? scale * scale / 6.0 + 1.0 / 6.0 : 0.0;
  return sqrt(max(circle * circle - 4.0 * (resampling + 1.0 / 12.0), 0.0));
}

void main() {
  vec2 place = gl_FragCoord.xy / scale;
  float radius = max(radiusAt(min(ivec2(place), textureSize(depth, 0) - 1)), 0.5);
  vec2 uv = gl_FragCoord.xy * uvOfPixel, stride = direction * uvOfPixel;
  blurred = texture(picture, uv);
  float weights = 1.0;
  for (int i = 1; float(i) - 0.5 < radius; ++i) {
    float from = float(i) - 0.5, to = min(float(i) + 0.5, radius);
    float middle = 0.5 * (from + to) / radius;
    float chord = (to - from) * sqrt(1.0 - middle * middle);
    blurred += chord * (texture(picture, uv - float(i) * stride) + texture(picture, uv + float(i) * stride));
    weights += 2.0 * chord;
  }
  blurred /= weights;
}
