// The fragment's side of drawing objects: from interpolated vertices, material and textures to the
// Surface that is shaded or stored. Goes with render/object.vert.
#include "render/scene.glsl"
#include "render/surface.glsl"
#include "render/view.glsl"

layout(location = 0) in vec3 positionW;
layout(location = 1) in vec3 normalW;
layout(location = 2) in vec4 tangentW;
layout(location = 3) in vec4 texCoords;
layout(location = 4) in vec4 vertexColor;
layout(location = 5) flat in uint materialIndex;

uniform sampler2D albedoTexture;
uniform sampler2D emissiveTexture;
uniform sampler2D normalTexture;
uniform sampler2D metallicRoughnessTexture;
uniform sampler2D occlusionTexture;

// Derivatives are taken of the interpolated coordinates: pixels beside the triangle's edge read the
// material as zero on llvmpipe (loads from storage blocks are masked), so that derivatives of
// transformed coordinates would pick the wrong mip level along every edge.
vec4 sampledAlways(sampler2D image, TextureUse use) {
  vec4 dx = dFdx(texCoords), dy = dFdy(texCoords);
  bool second = use.offset.z > 0.5;
  mat2 rotateAndScale = mat2(use.matrix.xy, use.matrix.zw);
  vec2 uv = use.offset.xy + rotateAndScale * (second ? texCoords.zw : texCoords.xy);
  return textureGrad(image, uv, rotateAndScale * (second ? dx.zw : dx.xy),
                     rotateAndScale * (second ? dy.zw : dy.xy));
}

vec4 sampled(sampler2D image, TextureUse use) {
  return use.offset.w > 0.5 ? sampledAlways(image, use) : vec4(1.0);
}

// Albedo and opacity: material, texture and vertex colour multiplied.
vec4 baseColorOf(MaterialValues material) {
  return material.albedo * vertexColor * sampled(albedoTexture, material.albedoUse);
}

// The shading normal on the side that is seen.
vec3 shadingNormalW(MaterialValues material) {
  vec3 n = normalize(normalW);
  if (material.normalUse.offset.w > 0.5 && dot(tangentW.xyz, tangentW.xyz) > 0.0) {
    vec3 t = normalize(tangentW.xyz - n * dot(n, tangentW.xyz));
    vec3 b = cross(n, t) * tangentW.w;
    vec3 normalT = sampledAlways(normalTexture, material.normalUse).xyz * 2.0 - 1.0;
    normalT.xy *= material.emissive.w;
    n = normalize(t * normalT.x + b * normalT.y + n * normalT.z);
  }
  return gl_FrontFacing ? n : -n;
}

Surface surfaceOf(MaterialValues material, vec4 baseColor) {
  Surface s;
  s.type = uint(material.surface.w);
  s.positionW = positionW;
  s.normalW = shadingNormalW(material);
  s.toEyeW = toEyeFrom(positionW);
  s.albedo = baseColor.rgb;
  s.emissive = material.emissive.rgb * sampled(emissiveTexture, material.emissiveUse).rgb;
  float occlusion = sampled(occlusionTexture, material.occlusionUse).r;
  s.occlusion = 1.0 + material.surface.z * (occlusion - 1.0);
  s.specular = material.specular.rgb;
  s.shininess = material.specular.w;
  vec4 metallicRoughness = sampled(metallicRoughnessTexture, material.metallicRoughnessUse);
  s.metallic = material.surface.x * metallicRoughness.b;
  s.roughness = material.surface.y * metallicRoughness.g;
  return s;
}
