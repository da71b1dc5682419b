// Reading the G-buffer back into a Surface.
//   AMBIENT_VISIBILITY  a texture says how much of the ambient light arrives
//   BAKED_LIGHT         a texture holds the baked irradiance
#include "render/gbuffer.glsl"

uniform sampler2D depth;
uniform sampler2D normal;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform usampler2D material;
uniform sampler2D emissive;
#ifdef AMBIENT_VISIBILITY
uniform sampler2D ambientVisibility;
#endif
#ifdef BAKED_LIGHT
uniform sampler2D bakedIrradiance;
#endif

// pixel: texel of the G-buffer; its depth must not be 0 (nothing drawn).
Surface readSurface(ivec2 pixel) {
  Surface s;
  float reversedDepth = texelFetch(depth, pixel, 0).r;
  vec3 positionV = positionVOf(ndcOfPixel(vec2(pixel) + 0.5), reversedDepth);
  s.positionW = worldOfView(positionV);
  s.normalW = mat3(view.worldFromView) * decodeNormal(texelFetch(normal, pixel, 0).rg);
  s.toEyeW = toEyeFrom(s.positionW);
  s.albedo = texelFetch(albedo, pixel, 0).rgb;
  vec4 specularTexel = texelFetch(specular, pixel, 0);
  s.specular = specularTexel.rgb;
  s.occlusion = specularTexel.a;
#ifdef AMBIENT_VISIBILITY
  s.occlusion *= texelFetch(ambientVisibility, pixel, 0).r;
#endif
  s.emissive = texelFetch(emissive, pixel, 0).rgb;
  unpackMaterial(texelFetch(material, pixel, 0), s);
#ifdef BAKED_LIGHT
  s.bakedIrradiance = texelFetch(bakedIrradiance, pixel, 0).rgb;
#endif
  return s;
}
