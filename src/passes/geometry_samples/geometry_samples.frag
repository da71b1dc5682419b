// Stores a surface's depth, and its normal where it is asked for, in a multisampled target.
//   NORMALS                                       write the shading normal as GBuffer does
//   ALPHA_TEST, TEXTURE_ENVIRONMENT, EACH_SAMPLE  see render/object_surface.glsl
// variant: ALPHA_TEST=1 EACH_SAMPLE=1
// variant: NORMALS=1
// variant: NORMALS=1 ALPHA_TEST=1 EACH_SAMPLE=1
#include "render/normal_encoding.glsl"
#include "render/object_surface.glsl"

#ifdef NORMALS
layout(location = 0) out vec2 normal;
#endif

void main() {
#ifdef ALPHA_TEST
  testAlpha(materialColor().a);
#endif
#ifdef NORMALS
  normal = encodeNormal(normalize(mat3(view.viewFromWorld) * shadingNormalW()));
#endif
}
