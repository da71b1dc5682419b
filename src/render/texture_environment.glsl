// What OpenGL's fixed functions did with textures: generated coordinates, cube maps and the texture
// environment. Formulas in docs/dev/materials-and-light.md, names in scene/material.hpp. Compiled in
// for materials that use it (TEXTURE_ENVIRONMENT), so that others pay nothing.
#ifdef TEXTURE_ENVIRONMENT

// scene::Coordinates
const int kCoordinatesMesh = 0;
const int kCoordinatesObjectLinear = 1;
const int kCoordinatesEyeLinear = 2;
const int kCoordinatesSphereMap = 3;
const int kCoordinatesReflection = 4;

// scene::Combine; replace keeps the opacity where the picture has no alpha channel.
const int kCombineDecal = 1;
const int kCombineBlend = 2;
const int kCombineAdd = 3;
const int kCombineReplace = 4;
const int kCombineReplaceColor = 5;

uniform samplerCube albedoCube;
uniform samplerCube emissiveCube;

// The ray from the eye, reflected at the surface.
vec3 reflectedRayW(vec3 normalW) { return reflect(-toEyeFrom(positionW), normalW); }

vec2 sphereMapCoordinates(vec3 rayV) {
  float m = 2.0 * length(vec3(rayV.xy, rayV.z + 1.0));
  return rayV.xy / max(m, 1e-6) + 0.5;
}

// (s, t) as OpenGL generates them; its t grows upwards in the picture, our v downwards.
vec2 generatedCoordinates(int kind, TextureGeneration planes, vec3 normalW) {
  if (kind == kCoordinatesSphereMap)
    return sphereMapCoordinates(mat3(view.viewFromWorld) * reflectedRayW(normalW));
  vec4 p = kind == kCoordinatesObjectLinear ? vec4(objectPositionO, 1.0)
                                            : view.viewFromWorld * vec4(positionW, 1.0);
  return vec2(dot(planes.planeS, p), dot(planes.planeT, p));
}

vec4 sampled(sampler2D image, samplerCube cube, TextureUse use, int kind, TextureGeneration planes,
             vec3 normalW) {
  if (use.offset.w < 0.5) return vec4(1.0);
  // GL's cube maps are left-handed (render::GpuScene::textures).
  if (kind == kCoordinatesReflection)
    return texture(cube, reflectedRayW(normalW) * vec3(1.0, 1.0, -1.0));
  if (kind == kCoordinatesMesh) return texture(image, texCoordOf(use));
  vec2 st = generatedCoordinates(kind, planes, normalW);
  return texture(image, transformed(use, vec2(st.x, 1.0 - st.y)));
}

// Material colour and texel: OpenGL 2.1, table 3.22.
vec4 combined(int combine, vec4 color, vec4 texel) {
  if (combine == kCombineDecal) return vec4(mix(color.rgb, texel.rgb, texel.a), color.a);
  if (combine == kCombineBlend)
    return vec4(mix(color.rgb, material.blendColor.rgb, texel.rgb), color.a * texel.a);
  if (combine == kCombineAdd)
    return vec4(min(color.rgb + texel.rgb, 1.0), color.a * texel.a);
  if (combine == kCombineReplace) return texel;
  if (combine == kCombineReplaceColor) return vec4(texel.rgb, color.a);
  return color * texel;
}

#endif
