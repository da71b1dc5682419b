// Where a pixel of the G-buffer lies and how its surface is turned.
#include "render/normal_encoding.glsl"
#include "render/view.glsl"

uniform sampler2D depth;  // reversed
uniform sampler2D normal;

#include "render/plane_normal.glsl"

struct SurfacePixel {
  vec3 positionW;
  vec3 normalW;       // unit, for shading
  vec3 planeNormalW;  // unit, of its true plane
};

SurfacePixel surfaceAt(ivec2 pixel) {
  SurfacePixel s;
  s.positionW = positionWOf(pixel);
  s.normalW = mat3(view.worldFromView) * decodeNormal(texelFetch(normal, pixel, 0).rg);
  s.planeNormalW = planeNormalOf(pixel, s.positionW, s.normalW);
  return s;
}
