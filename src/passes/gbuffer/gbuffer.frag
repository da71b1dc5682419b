// Stores a surface in the G-buffer instead of shading it.
//   ALPHA_TEST           discard below the material's cutoff
//   TEXTURE_ENVIRONMENT  see render/texture_environment.glsl
//   BAKED_LIGHT          with its baked irradiance
// variant: ALPHA_TEST=1
// variant: TEXTURE_ENVIRONMENT=1
// variant: BAKED_LIGHT=1
#include "render/gbuffer.glsl"
#include "render/object_surface.glsl"

layout(location = 0) out vec2 normal;
layout(location = 1) out vec4 albedo;
layout(location = 2) out vec4 specular;
layout(location = 3) out uvec4 materialTexel;
layout(location = 4) out vec3 emissive;
#ifdef BAKED_LIGHT
layout(location = 5) out vec4 bakedIrradiance;
#endif

void main() {
  vec4 baseColor = materialColor();
  testAlpha(baseColor.a);
  Surface s = surfaceOf(baseColor);
  if (material.codes.x > 0.5) s.type = kTypeCustom;
  normal = encodeNormal(normalize(mat3(view.viewFromWorld) * s.normalW));
  albedo = vec4(s.albedo, 1.0);
  specular = vec4(s.specular, s.occlusion);
  materialTexel = packMaterial(s);
  emissive = s.emissive;
#ifdef BAKED_LIGHT
  bakedIrradiance = vec4(s.bakedIrradiance, 1.0);
#endif
}
