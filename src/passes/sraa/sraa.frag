// Subpixel reconstruction: each geometry sample of the pixel takes its colour from those shaded pixels around
// that lie on its surface, weighted as in the thesis by exp(-sharpness * max(dn, dp)).
//   NORMALS  surfaces are told apart by their normals, too
// variant: NORMALS=1
#include "render/normal_encoding.glsl"
#include "render/srgb.glsl"
#include "render/view.glsl"

uniform sampler2D color;    // as it was
uniform sampler2D depth;
uniform sampler2DMS depthSamples;
#ifdef NORMALS
uniform sampler2D normal;
uniform sampler2DMS normalSamples;
#endif
uniform vec4 placesX, placesY;  // of the four samples, px from the pixel's centre
uniform vec4 fitX, fitY;        // their parts in the gradient of the plane that fits them best
uniform float sharpness;
uniform bool encoded;           // the picture is sRGB-encoded
uniform float exposure;         // of a picture that is not

layout(location = 0) out vec4 smoothed;

// A share of nothing but such weights is still a number.
const float kLeastWeight = 1e-35;

vec4 found, pixelsPerDepth;  // of the samples: depth, and what a difference from it is in pixels there
#ifdef NORMALS
vec3 normals[4];             // of the samples
#endif

vec4 depthsAt(ivec2 pixel) {
  vec4 depths;
  for (int i = 0; i < 4; ++i) depths[i] = texelFetch(depthSamples, pixel, i).r;
  return depths;
}

// What the plane through a pixel's centre and its samples, which differ from it in depth by `steps`, adds to
// depth at (x, y) px from the centre. Flat as far as they lie in no plane: then the pixel holds an edge.
vec4 planeOf(vec4 steps, vec4 x, vec4 y) {
  vec2 gradient = vec2(dot(fitX, steps), dot(fitY, steps));
  vec4 fitted = gradient.x * placesX + gradient.y * placesY, off = steps - fitted;
  float square = dot(fitted, fitted);
  gradient *= square / (square + 64.0 * dot(off, off) + 1e-30);
  return gradient.x * x + gradient.y * y;
}

// dp: how far the samples are from the plane of a pixel's surface, on a scale that doubles with each step. `d`
// is depth at the pixel, `plane` what the plane has where the samples are.
vec4 distancesTo(float d, vec4 plane) {
  if (d == 0.0) return 1e6 * vec4(notEqual(found, vec4(0.0)));  // the background resembles no surface
  return log2(1.0 + abs(found - plane) * pixelsPerDepth);
}

#ifdef NORMALS
// dn: twice the sine of half the angle.
vec4 turnsTo(ivec2 pixel) {
  vec3 n = decodeNormal(texelFetch(normal, pixel, 0).rg);
  return vec4(distance(normals[0], n), distance(normals[1], n), distance(normals[2], n),
              distance(normals[3], n));
}
#endif

void readSamples(ivec2 pixel) {
  found = depthsAt(pixel);
#ifdef NORMALS
  for (int i = 0; i < 4; ++i) normals[i] = decodeNormal(texelFetch(normalSamples, pixel, i).rg);
#endif
  // Depth d is at distance (d p33 - p32) / (p22 - d p23) of the projection p; its derivative, divided by the
  // size of a pixel there, comes down to this.
  mat4 p = view.clipFromView;
  pixelsPerDepth = 0.5 * view.size.y * p[1][1] / max(abs(p[2][2] - found * p[2][3]), 1e-12);
}

vec4 weightsOf(vec4 apart) { return max(exp(-sharpness * apart), kLeastWeight); }

// What may be averaged, and in a its weight: bright radiance counts less, as the eye will see it.
vec4 lightAt(ivec2 pixel) {
  vec3 c = texelFetch(color, pixel, 0).rgb;
  if (encoded) return vec4(linearFromSrgb(c), 1.0);
  float weight = 1.0 / (1.0 + exposure * dot(c, vec3(0.2126, 0.7152, 0.0722)));
  return vec4(c * weight, weight);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float here = texelFetch(depth, pixel, 0).r;
  readSamples(pixel);
  vec4 own = distancesTo(here, here + dot(fitX, found - here) * placesX + dot(fitY, found - here) * placesY);
#ifdef NORMALS
  own = max(own, turnsTo(pixel));
#endif
  bool isEdge = found.x < 1.0 &&  // 1: GeometrySamples is disabled
                sharpness * max(max(own.x, own.y), max(own.z, own.w)) > 0.01;

  mat4 sums = mat4(0.0);  // a column for each sample
  vec4 weights = vec4(0.0), greatest = vec4(0.0);
  for (int i = 0; i < 9; ++i) {
    // Software rasterisers leave loops early, but run both ways of an if: pixels on one plane end here.
    if (!isEdge) break;
    ivec2 offset = ivec2(i % 3, i / 3) - 1;
    ivec2 there = pixel + offset;
    if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, textureSize(depth, 0)))) continue;
    float d = texelFetch(depth, there, 0).r;
    vec4 x = placesX - float(offset.x), y = placesY - float(offset.y);
    vec4 apart = distancesTo(d, d + planeOf(depthsAt(there) - d, x, y));
#ifdef NORMALS
    apart = max(apart, turnsTo(there));
#endif
    if (offset == ivec2(0)) {
      own = min(own, apart);
      continue;
    }
    vec4 weight = weightsOf(apart);
    greatest = max(greatest, weight);
    vec4 nearness = 1.0 - 0.25 * (x * x + y * y);
    weight *= nearness * nearness;
    weights += weight;
    sums += outerProduct(lightAt(there), weight);
  }
  if (!isEdge) discard;

  // The pixel itself comes first, as long as its surface fits as well as any: textures stay sharp.
  vec4 ownWeight = weightsOf(own);
  vec4 share = ownWeight / max(greatest, ownWeight);
  vec4 light = lightAt(pixel) * dot(share, vec4(1.0)) + sums * ((1.0 - share) / max(weights, kLeastWeight));
  vec3 mean = light.rgb / light.a;
  smoothed = vec4(encoded ? srgbFromLinear(mean) : mean, texelFetch(color, pixel, 0).a);
}
