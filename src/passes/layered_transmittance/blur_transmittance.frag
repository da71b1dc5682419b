// One axis of a separable, anisotropic Gaussian over the colours of four slots: along x, or the second.
//   ALONG_X    the first axis
//   HALF_SIZE  a texel stands for two pixels along each axis
// variant: ALONG_X=1 HALF_SIZE=1
// variant: HALF_SIZE=1
#include "render/layered_transmittance.glsl"
#include "render/penumbra_blur.glsl"
#include "render/surface_pixel.glsl"
#include "render/tangent_plane.glsl"

uniform usampler2DArray colors;
uniform sampler2DArray widths;  // of penumbrae, m
uniform int colorLayer;         // of these arrays
uniform int widthLayer;
uniform int taps;               // on either side of the pixel
uniform float maximumRadius;    // px of the picture
uniform float edgeStop;         // m

layout(location = 0) out uvec4 blurred;

#ifdef ALONG_X
const bool kAlongX = true;
#else
const bool kAlongX = false;
#endif

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy), pixel = kScale * texel;
  ivec2 last = textureSize(colors, 0).xy - 1;
  vec4 ownWidths = texelFetch(widths, ivec3(texel, widthLayer), 0);
  uvec4 own = texelFetch(colors, ivec3(texel, colorLayer), 0);
  float widest = max(max(ownWidths.x, ownWidths.y), max(ownWidths.z, ownWidths.w));
  blurred = own;
  // Software rasterisers leave loops early, but run both ways of an if.
  for (bool once = widest > 0.0; once; once = false) {
    SurfacePixel s = surfaceAt(pixel);
    vec3 positionV = (view.viewFromWorld * vec4(s.positionW, 1.0)).xyz;
    vec3 normalV = mat3(view.viewFromWorld) * s.planeNormalW;
    vec3 axis = max(ellipseAxis(positionV, normalV, kAlongX), vec3(-1e6, -1e6, 1e-6));
    float length1 = max(length(axis.xy), 1e-6);  // texels of a metre
    TangentPlane tangent = tangentPlaneAt(positionV, normalV, max(edgeStop, 1.0 / axis.z));

    float inherent = kInherent / (kOfDisc * length1);
    vec4 squared = max(ownWidths * ownWidths - inherent * inherent, 0.0), exponents;
    for (int l = 0; l < 4; ++l) exponents[l] = gaussianExponent(squared[l]);
    vec4 ends = 0.25 * squared;
    float apart = tapsApart(widest, length1, maximumRadius / float(kScale), taps);
    vec2 direction = axis.xy / length1;
    // Of the four slots, each.
    vec4 red = vec4(0.0), green = vec4(0.0), blue = vec4(0.0), weights = vec4(0.0);
    for (int i = -taps; i <= taps; ++i) {
      ivec2 tap = clamp(texel + ivec2(round(float(i) * apart * direction)), ivec2(0), last);
      float metres = float(i) * apart / length1, away = metres * metres;
      float onSurface = i == 0 || onPlane(tangent, kScale * tap, texelFetch(depth, kScale * tap, 0).r) ? 1.0 : 0.0;
      uvec4 bits = texelFetch(colors, ivec3(tap, colorLayer), 0);
      // Where a pixel has not a slot's light there is none to blur.
      vec4 weight = onSurface * vec4(bits >> 30) * vec4(lessThanEqual(vec4(away), ends)) * exp2(exponents * away);
      vec4 r = vec4(bits & kColorMask), g = vec4(bits >> 10 & kColorMask), b = vec4(bits >> 20 & kColorMask);
      red += weight * r * r;
      green += weight * g * g;
      blue += weight * b * b;
      weights += weight;
    }
    vec4 each = 1.0 / (kColorSteps * kColorSteps * max(weights, 1e-6));
    for (int l = 0; l < 4; ++l) {
      // Too narrow for texels: the maps say it.
      bool sharp = !kAlongX && ownWidths[l] > 0.0 && kOfDisc * ownWidths[l] * axis.z <= 0.5 * kInherent;
      uint color = packedColor(min(each[l] * vec3(red[l], green[l], blue[l]), 1.0));
      blurred[l] = sharp ? 0u : isKnown(own[l]) ? color : own[l];
    }
  }
}
