// The fragment's side of drawing objects: from interpolated vertices, material and textures to the
// Surface that is shaded or stored. Goes with render/object.vert.
//   ALPHA_TEST           discard below the material's cutoff
//   TEXTURE_ENVIRONMENT  generated coordinates, cube maps, combines other than modulate
//   EACH_SAMPLE          of a multisampled target: the alpha test is made at each sample, so that the holes'
//                        edges run through pixels
//   SHADOW_VIEWS         see render/object.vert
//   BAKED_LIGHT          see render/surface.glsl
#ifdef SHADOW_VIEWS
layout(location = 6) flat in uint viewIndex;
#endif
#include "render/shadow_views.glsl"
#include "render/scene.glsl"
#include "render/surface.glsl"
#include "render/view.glsl"
#ifdef BAKED_LIGHT
#include "render/baked_light.glsl"
#endif

layout(location = 0) in vec3 positionW;
layout(location = 1) in vec3 normalW;
layout(location = 2) in vec4 tangentW;
layout(location = 3) in vec4 texCoords;
layout(location = 4) in vec4 vertexColor;
#if defined(TEXTURE_ENVIRONMENT) || defined(CUSTOM_SHADER)
layout(location = 5) in vec3 objectPositionO;
#endif

uniform sampler2D albedoTexture;
uniform sampler2D emissiveTexture;
uniform sampler2D normalTexture;
uniform sampler2D metallicRoughnessTexture;
uniform sampler2D occlusionTexture;
uniform sampler2D specularTexture;

vec2 transformed(TextureUse use, vec2 uv) {
  return use.offset.xy + mat2(use.matrix.xy, use.matrix.zw) * uv;
}

vec2 texCoordOf(TextureUse use) {
#if defined(EACH_SAMPLE) && defined(ALPHA_TEST)
  vec4 coords = interpolateAtSample(texCoords, gl_SampleID);
#else
  vec4 coords = texCoords;
#endif
  return transformed(use, use.offset.z > 0.5 ? coords.zw : coords.xy);
}

vec4 sampled(sampler2D image, TextureUse use) {
  return use.offset.w > 0.5 ? texture(image, texCoordOf(use)) : vec4(1.0);
}

// Lines and points without normals show their colour as it is.
bool hasNormal() { return dot(normalW, normalW) > 0.0; }

// The shading normal on the side that is seen; towards the eye where there is none.
vec3 shadingNormalW() {
  if (!hasNormal()) return toEyeFrom(positionW);
  vec3 n = normalize(normalW);
  vec3 normalT = material.normalUse.offset.w > 0.5
                     ? texture(normalTexture, texCoordOf(material.normalUse)).xyz * 2.0 - 1.0
                     : vec3(0.0, 0.0, 1.0);
  if (material.normalUse.offset.w > 0.5 && dot(tangentW.xyz, tangentW.xyz) > 0.0) {
    vec3 t = tangentW.xyz - n * dot(n, tangentW.xyz);
    float square = dot(t, t);
    // A tangent along the normal gives the map no direction: the surface stays as it is.
    if (square > 1e-8 * dot(tangentW.xyz, tangentW.xyz)) {
      t *= inversesqrt(square);
      vec3 b = cross(n, t) * tangentW.w;
      normalT.xy *= material.emissive.w;
      n = normalize(t * normalT.x + b * normalT.y + n * normalT.z);
    }
  }
  return gl_FrontFacing ? n : -n;
}

// The reflectance at normal incidence takes its share before the diffuse albedo does.
void readSpecularGlossiness(vec4 specularTexel, inout Surface s) {
  s.roughness = 1.0 - (1.0 - material.surface.y) * specularTexel.a;
  s.albedo *= max(1.0 - max(max(s.specular.r, s.specular.g), s.specular.b), 0.0);
}

#include "render/texture_environment.glsl"

// Albedo and opacity: of material and vertex, combined with the texture.
vec4 materialColor() {
  vec4 color = material.albedo * vertexColor;
#ifdef TEXTURE_ENVIRONMENT
  if (material.albedoUse.offset.w < 0.5) return color;
  vec4 texel = sampled(albedoTexture, albedoCube, material.albedoUse, int(material.codes.z),
                       material.albedoGeneration, shadingNormalW());
  return combined(int(material.codes.y), color, texel);
#else
  return color * sampled(albedoTexture, material.albedoUse);
#endif
}

void testAlpha(float alpha) {
#ifdef ALPHA_TEST
  if (alpha < material.transmission.w) discard;
#endif
}

vec3 emittedRadiance(vec3 normalW) {
#ifdef TEXTURE_ENVIRONMENT
  return material.emissive.rgb * sampled(emissiveTexture, emissiveCube, material.emissiveUse,
                                         int(material.codes.w), material.emissiveGeneration,
                                         normalW).rgb;
#else
  return material.emissive.rgb * sampled(emissiveTexture, material.emissiveUse).rgb;
#endif
}

Surface surfaceOf(vec4 baseColor) {
  Surface s;
  s.type = hasNormal() ? uint(material.surface.w) : kTypeUnlit;
  s.positionW = positionW;
  s.normalW = shadingNormalW();
  s.toEyeW = toEyeFrom(positionW);
  s.albedo = baseColor.rgb;
  s.emissive = emittedRadiance(s.normalW);
  float occlusion = sampled(occlusionTexture, material.occlusionUse).r;
  s.occlusion = 1.0 + material.surface.z * (occlusion - 1.0);
  vec4 specular = sampled(specularTexture, material.specularUse);
  s.specular = material.specular.rgb * specular.rgb;
  s.shininess = material.specular.w;
  vec4 metallicRoughness = sampled(metallicRoughnessTexture, material.metallicRoughnessUse);
  s.metallic = material.surface.x * metallicRoughness.b;
  s.roughness = material.surface.y * metallicRoughness.g;
  if (s.type == kTypeSpecularGlossiness) readSpecularGlossiness(specular, s);
#ifdef BAKED_LIGHT
  s.bakedIrradiance = bakedIrradianceHere();
#endif
  return s;
}
