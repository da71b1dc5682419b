// The picture through a thin lens: each pixel gathers from the circles that reach it. First its own surface and
// what is seen past that, then what lies in front and is blurred over it. Narrow circles are gathered from the picture,
// pixel by pixel, wide ones in strides from a layer that is smooth enough for that.
#include "passes/depth_of_field/grid.glsl"

uniform sampler2D color;
uniform sampler2D depth;
uniform sampler2D farLayer;   // of wide circles, smoothed for the widest stride: rgb; a: radius of its circle, px
uniform sampler2D farCover;   // share of the pixel whose light it is
uniform sampler2D nearLayer;  // the same of what is before the plane in focus
uniform sampler2D nearCover;
uniform sampler2D behind;        // rgb times a: what is not before it
uniform sampler2D narrow;        // rgb times a: what is, in narrow circles
uniform sampler2D narrowRadius;  // of these, px, times a
uniform vec2 uvOfPixel;          // in these three

layout(location = 0) out vec4 blurred;

ivec2 pixel, last;

struct Light {
  vec3 color;
  float radius;  // px
  float cover;   // share of the pixel
};

// What of the picture counts. Known where a loop is compiled, so that the others are not read.
const int kAll = 0, kNarrow = 1, kWide = 2;

Light lightAt(vec2 offset, float side, int which) {
  ivec2 tap = clamp(pixel + ivec2(offset), ivec2(0), last);
  if (which == kWide) {
    vec4 found = side < 0.0 ? texelFetch(nearLayer, tap, 0) : texelFetch(farLayer, tap, 0);
    float cover = side < 0.0 ? texelFetch(nearCover, tap, 0).r : texelFetch(farCover, tap, 0).r;
    return Light(found.rgb, found.a, cover);
  }
  float radius = side * circleAt(texelFetch(depth, tap, 0).r);
  bool counts = radius > kSharp && (which == kAll || !isWide(radius));
  return Light(finite(texelFetch(color, tap, 0).rgb), radius, counts ? 1.0 : 0.0);
}
Light farLight(vec2 offset, int which) { return lightAt(offset, 1.0, which); }
Light nearLight(vec2 offset, int which) { return lightAt(offset, -1.0, which); }

float ownRadius(float radius) { return isWide(radius) ? unsmoothed(radius, widestStride(pixel)) : radius; }

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

// Behind the plane in focus a tap counts as far as its own circle and the pixel's reach: what is farther away is
// covered by what is nearer, and never spreads over it.
vec4 farSum(float radius, float own, float stride, int which) {
  int rows = rowsOf(radius, stride);
  vec4 sum = vec4(0.0);
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = farLight(offset, which);
      sum += light.cover * share(min(light.radius, own), length(offset), stride) * vec4(light.color, 1.0);
    }
  }
  return sum;
}
vec3 farColor(float radius) {
  float own = ownRadius(radius);
  vec4 sum;
  if (isWide(radius)) {
    sum = farSum(radius, own, strideOf(radius), kWide);
    float largestNarrow = largestNarrowAt(pixel).y;
    if (largestNarrow > kSharp) sum += farSum(largestNarrow, own, 1.0, kNarrow);
  } else {
    sum = farSum(radius, own, 1.0, kAll);
  }
  return sum.a > 0.0 ? sum.rgb / sum.a : blurred.rgb;
}

// A surface before it covers a share of the pixel's circle. Through the rest one sees what is behind.
struct Surface {
  vec4 light;  // that arrives from it: rgb times a
  float open;  // the rest
};
Surface nearSurface(float radius, float own, float stride, int which) {
  int rows = rowsOf(radius, stride);
  Surface sum = Surface(vec4(0.0), 0.0);
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = nearLight(offset, which);
      float weight = share(own, length(offset), stride);
      float notInFront = 1.0 - inFront(light.radius, own), further = inFront(own, light.radius);
      float surface = light.cover * notInFront;
      sum.light += share(light.radius, length(offset), stride) * (1.0 - further) * surface * vec4(light.color, 1.0);
      // Narrow circles of the same surface are open as seen among the wide ones.
      if (which == kNarrow) sum.open -= weight * (1.0 - further) * surface;
      else sum.open += weight * (further * surface + notInFront * (1.0 - light.cover));
    }
  }
  return sum;
}

vec4 furtherNarrow(float own, vec2 uv) {
  vec4 light = textureLod(narrow, uv, 0.0);
  return light.a > 0.0 ? light * inFront(own, textureLod(narrowRadius, uv, 0.0).r / light.a) : vec4(0.0);
}

// The picture does not have what a surface before the plane in focus hides, but it is like what is nearest beside it.
vec4 hiddenColor(float radius, float own, float stride, int which) {
  int rows = rowsOf(radius, stride);
  vec4 sum = vec4(0.0);
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = nearLight(offset, which);
      float closeness = 1.0 / (1.0 + dot(offset, offset));
      vec4 further = light.cover * inFront(own, light.radius) * vec4(light.color, 1.0);
      if (light.cover < 1.0) {
        vec2 uv = (gl_FragCoord.xy + offset) * uvOfPixel;
        further += textureLod(behind, uv, 0.0);
        if (which == kWide) further += furtherNarrow(own, uv);
      }
      sum += closeness * closeness * further;
    }
  }
  return sum;
}

vec3 nearColor(float radius) {
  float own = ownRadius(radius), stride = strideOf(radius);
  float reach = min(kSame * radius, largestAt(pixel).x);
  Surface surface;
  if (isWide(radius)) {
    surface = nearSurface(reach, own, stride, kWide);
    float largestNarrow = largestNarrowAt(pixel).x;
    if (largestNarrow > kSharp && own < kOther * largestNarrow) {
      Surface same = nearSurface(own + 0.5, own, 1.0, kNarrow);
      surface.light += same.light;
      surface.open = max(surface.open + same.open, 0.0);
    }
  } else {
    surface = nearSurface(reach, own, 1.0, kAll);
  }
  vec3 color = surface.light.a > 0.0 ? surface.light.rgb / surface.light.a : blurred.rgb;
  float open = surface.open / max(surface.open + surface.light.a, 1e-9);
  if (open > 0.004) {
    vec4 hidden;
    if (isWide(radius)) hidden = hiddenColor(reach, own, stride, kWide);
    else hidden = hiddenColor(reach, own, 1.0, kAll);
    if (hidden.a > 0.0) color = mix(color, hidden.rgb / hidden.a, open);
  }
  return color;
}

// What lies in front throws light on the pixel.
struct Front {
  vec4 light;    // rgb times a; a: how much of the pixel it covers
  float radius;  // of its circles, times a
};
Front front(float radius, float own, float stride, int which) {
  int rows = rowsOf(radius, stride);
  Front sum = Front(vec4(0.0), 0.0);
  for (int y = -rows; y <= rows; ++y) {
    int taps = tapsOf(y, rows);
    for (int x = -taps; x <= taps; ++x) {
      vec2 offset = stride * vec2(x, y);
      Light light = nearLight(offset, which);
      float weight = light.cover * inFront(light.radius, own) * share(light.radius, length(offset), stride);
      sum.light += weight * vec4(light.color, 1.0);
      sum.radius += weight * light.radius;
    }
  }
  return sum;
}

// Narrow circles count as far as wide ones do not cover them; where both are of one thing, they lie side by side.
vec4 together(Front wide, Front beside) {
  if (min(wide.light.a, beside.light.a) <= 0.0) return wide.light + beside.light;
  float covering = inFront(wide.radius / wide.light.a, beside.radius / beside.light.a);
  return wide.light + beside.light * (1.0 - covering * min(wide.light.a, 1.0));
}

void main() {
  pixel = ivec2(gl_FragCoord.xy);
  last = textureSize(color, 0) - 1;
  blurred = texelFetch(color, pixel, 0);
  blurred.rgb = finite(blurred.rgb);
  float circle = circleAt(texelFetch(depth, pixel, 0).r);
  if (circle > kSharp) blurred.rgb = farColor(circle);
  if (circle < -kSharp) blurred.rgb = nearColor(-circle);

  float own = max(ownRadius(-circle), kSharp), largestWide = largestAt(pixel).x, largestNarrow = largestNarrowAt(pixel).x;
  Front wide = Front(vec4(0.0), 0.0), beside = wide;
  if (isWide(largestWide) && largestWide > kSame * own) wide = front(largestWide, own, strideOf(largestWide), kWide);
  if (largestNarrow > kSame * own) beside = front(largestNarrow, own, 1.0, kNarrow);
  vec4 light = together(wide, beside);
  if (light.a > 0.0) blurred.rgb = mix(blurred.rgb, light.rgb / light.a, min(1.05 * light.a, 1.0));
}
