// The picture through a thin lens: each pixel gathers from the circles that reach it. First its own surface and
// what is seen past that, then what lies in front and is blurred over it.
#include "passes/depth_of_field/grid.glsl"

uniform sampler2D color;
uniform sampler2D depth;
uniform sampler2D farLayer;   // smoothed for strides of more than a pixel: rgb; a: radius of its circle, px
uniform sampler2D farCover;   // share of the pixel whose light it is
uniform sampler2D nearLayer;  // the same of what is before the plane in focus
uniform sampler2D nearCover;
uniform sampler2D behind;  // rgb times a: what is not before it
uniform vec2 uvOfPixel;    // in `behind`

layout(location = 0) out vec4 blurred;

ivec2 pixel, last;

struct Light {
  vec3 color;
  float radius;  // px
  float cover;   // share of the pixel
};

Light fromPicture(ivec2 tap, float side) {
  float radius = side * circleAt(texelFetch(depth, tap, 0).r);
  return Light(finite(texelFetch(color, tap, 0).rgb), radius, radius > kSharp ? 1.0 : 0.0);
}
Light fromLayer(ivec2 tap, sampler2D layer, sampler2D cover) {
  vec4 found = texelFetch(layer, tap, 0);
  return Light(found.rgb, found.a, texelFetch(cover, tap, 0).r);
}
// From the layer where it is read in strides: known when the shader is compiled, so that the other is not read.
Light farLight(vec2 offset, bool strides) {
  ivec2 tap = clamp(pixel + ivec2(offset), ivec2(0), last);
  if (strides) return fromLayer(tap, farLayer, farCover);
  return fromPicture(tap, 1.0);
}
Light nearLight(vec2 offset, bool strides) {
  ivec2 tap = clamp(pixel + ivec2(offset), ivec2(0), last);
  if (strides) return fromLayer(tap, nearLayer, nearCover);
  return fromPicture(tap, -1.0);
}
float ownRadius(float radius, float stride) {
  return stride == 1.0 ? radius : unsmoothed(radius, widestStride(pixel));
}

// The taps of a circle: rows to both sides of its middle, and taps to both sides in each.
int rowsOf(float radius, float stride) { return int(ceil(radius / stride - 0.5)); }
int tapsOf(int row, int rows) { return int(sqrt(float(rows * rows + 2 * rows - row * row))); }

// The share of a circle's light that falls on a tap `away` from its middle, which stands for stride^2 pixels. The
// circle gets a rim of a stride, which makes it larger; that is taken off. On the grid its area is right to 5 %.
float share(float radius, float away, float stride) {
  float squared = max(radius * radius - 0.5 * stride * stride, 0.0);
  float reached = clamp((sqrt(squared) - away) / stride + 0.5, 0.0, 1.0);
  return reached / max(3.14159265 / (stride * stride) * squared + 0.26, 0.5);
}

// Whether, before the plane in focus, the first circle is so much larger that its thing is another one, in front
// of the second: 0 to 1.
const float kSame = 1.25, kOther = 1.75;
float inFront(float radius, float other) { return smoothstep(kSame, kOther, radius / max(other, kSharp)); }

// A surface behind the plane in focus. A tap counts as far as its own circle and the pixel's reach: what is
// farther away is covered by what is nearer, and never spreads over it.
vec3 farColor(float radius, bool strides) {
  float stride = strideOf(radius), own = ownRadius(radius, stride);
  int rows = rowsOf(radius, stride);
  vec4 sum = vec4(0.0);
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = farLight(offset, strides);
      sum += light.cover * share(min(light.radius, own), length(offset), stride) * vec4(light.color, 1.0);
    }
  }
  return sum.a > 0.0 ? sum.rgb / sum.a : blurred.rgb;
}

// What a surface before the plane in focus hides is like what is nearest beside it.
vec4 hiddenColor(float own, float stride, int rows, bool strides) {
  vec4 sum = vec4(0.0);
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = nearLight(offset, strides);
      float closeness = 1.0 / (1.0 + dot(offset, offset));
      vec4 further = light.cover * inFront(own, light.radius) * vec4(light.color, 1.0);
      if (light.cover < 1.0) further += textureLod(behind, (gl_FragCoord.xy + offset) * uvOfPixel, 0.0);
      sum += closeness * closeness * further;
    }
  }
  return sum;
}

// A surface before it. It leaves a share of the pixel's circle open to what is behind; the picture does not have
// that where the surface is, but it is like what is nearest beside it.
vec3 nearColor(float radius, bool strides) {
  float stride = strideOf(radius), own = ownRadius(radius, stride);
  int rows = rowsOf(min(kSame * radius, largestAt(pixel).x), stride);
  vec4 sum = vec4(0.0);
  float open = 0.0;
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = nearLight(offset, strides);
      float weight = share(own, length(offset), stride);
      float notInFront = 1.0 - inFront(light.radius, own), further = inFront(own, light.radius);
      float surface = light.cover * notInFront;
      sum += share(light.radius, length(offset), stride) * (1.0 - further) * surface * vec4(light.color, 1.0);
      open += weight * (further * surface + notInFront * (1.0 - light.cover));
    }
  }
  vec3 color = sum.a > 0.0 ? sum.rgb / sum.a : blurred.rgb;
  open /= max(open + sum.a, 1e-9);
  if (open > 0.004) {
    vec4 hidden = hiddenColor(own, stride, rows, strides);
    if (hidden.a > 0.0) color = mix(color, hidden.rgb / hidden.a, open);
  }
  return color;
}

// The light that what lies in front throws on the pixel; a: how much of it that covers.
vec4 front(float radius, float own, bool strides) {
  float stride = strideOf(radius);
  int rows = rowsOf(radius, stride);
  vec4 sum = vec4(0.0);
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = nearLight(offset, strides);
      float weight = light.cover * inFront(light.radius, own) * share(light.radius, length(offset), stride);
      sum += weight * vec4(light.color, 1.0);
    }
  }
  return sum;
}

void main() {
  pixel = ivec2(gl_FragCoord.xy);
  last = textureSize(color, 0) - 1;
  blurred = texelFetch(color, pixel, 0);
  blurred.rgb = finite(blurred.rgb);
  float circle = circleAt(texelFetch(depth, pixel, 0).r);
  float radius = abs(circle);
  bool strides = strideOf(radius) > 1.0;
  if (circle > kSharp) {
    if (strides) blurred.rgb = farColor(radius, true);
    else blurred.rgb = farColor(radius, false);
  }
  if (circle < -kSharp) {
    if (strides) blurred.rgb = nearColor(radius, true);
    else blurred.rgb = nearColor(radius, false);
  }

  float own = max(-circle, kSharp), largestNear = largestAt(pixel).x;
  if (largestNear <= kSame * own) return;
  vec4 light;
  if (strideOf(largestNear) > 1.0) light = front(largestNear, own, true);
  else light = front(largestNear, own, false);
  if (light.a > 0.0) blurred.rgb = mix(blurred.rgb, light.rgb / light.a, min(1.05 * light.a, 1.0));
}
