// Morphological anti-aliasing after the idea of Lottes, "FXAA", NVIDIA white paper, 2009: where the luma
// changes, find the edge's direction and how far the pixel is from the ends of its stair; the straight line
// that the stair stands for says how much of the neighbour across the edge belongs here.

uniform sampler2D color;
uniform float threshold;
uniform float subpixel;  // 0 to 1
uniform int search;      // px

layout(location = 0) out vec4 smoothed;

ivec2 last;

vec4 colorAt(ivec2 pixel) { return texelFetch(color, clamp(pixel, ivec2(0), last), 0); }
float lumaOf(vec4 c) { return dot(c.rgb, vec3(0.299, 0.587, 0.114)); }
float lumaAt(ivec2 pixel) { return lumaOf(colorAt(pixel)); }

// Steps along the edge until the mean luma across it is no longer that of the edge; y: what it was there.
vec2 endOfEdge(ivec2 pixel, ivec2 along, ivec2 across, float edge, float tolerance) {
  float difference = 0.0;
  for (int i = 1; i <= search; ++i) {
    ivec2 at = pixel + i * along;
    difference = 0.5 * (lumaAt(at) + lumaAt(at + across)) - edge;
    if (abs(difference) >= tolerance) return vec2(float(i), difference);
  }
  return vec2(float(search), difference);
}

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  last = textureSize(color, 0) - 1;
  vec4 here = colorAt(p);
  float m = lumaOf(here);
  float n = lumaAt(p + ivec2(0, 1)), s = lumaAt(p - ivec2(0, 1));
  float e = lumaAt(p + ivec2(1, 0)), w = lumaAt(p - ivec2(1, 0));
  float highest = max(m, max(max(n, s), max(e, w)));
  float lowest = min(m, min(min(n, s), min(e, w)));
  smoothed = here;
  if (highest - lowest < max(threshold * highest, 0.02)) return;

  float ne = lumaAt(p + ivec2(1, 1)), nw = lumaAt(p + ivec2(-1, 1));
  float se = lumaAt(p + ivec2(1, -1)), sw = lumaAt(p + ivec2(-1, -1));
  // Second differences across rows and across columns.
  float rows = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
  float columns = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
  bool horizontal = rows >= columns;

  // The neighbour across the edge is the one that differs more.
  ivec2 unit = horizontal ? ivec2(0, 1) : ivec2(1, 0);
  float ahead = horizontal ? n : e, behind = horizontal ? s : w;
  bool isAhead = abs(ahead - m) >= abs(behind - m);
  ivec2 across = isAhead ? unit : -unit;
  float other = isAhead ? ahead : behind;
  float edge = 0.5 * (m + other), tolerance = 0.25 * abs(other - m);

  ivec2 along = horizontal ? ivec2(1, 0) : ivec2(0, 1);
  vec2 forth = endOfEdge(p, along, across, edge, tolerance);
  vec2 back = endOfEdge(p, -along, across, edge, tolerance);
  vec2 nearer = forth.x < back.x ? forth : back;
  // At the nearer end the line has crossed to this side if the luma there turns against this pixel's.
  bool crosses = (nearer.y < 0.0) != (m < edge);
  float share = crosses ? 0.5 - nearer.x / (forth.x + back.x) : 0.0;

  // What is thinner than a pixel differs from the mean of all around.
  float around = (2.0 * (n + s + e + w) + ne + nw + se + sw) / 12.0;
  float thin = smoothstep(0.0, 1.0, clamp(abs(around - m) / (highest - lowest), 0.0, 1.0));
  share = max(share, subpixel * thin * thin);
  smoothed = mix(here, colorAt(p + across), share);
}
