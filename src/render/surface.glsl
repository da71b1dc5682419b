// A point of a surface as it is shaded, stored in the G-buffer and read back.
//   BAKED_LIGHT  with its baked light

// Material types, as the G-buffer stores them.
const uint kTypeNothing = 0u;
const uint kTypePhong = 1u;
const uint kTypeMetallicRoughness = 2u;
const uint kTypeCustom = 3u;
const uint kTypeUnlit = 4u;
const uint kTypeSpecularGlossiness = 5u;

struct Surface {
  uint type;
  vec3 positionW;
  vec3 normalW;        // unit, on the side that is seen
  vec3 toEyeW;         // unit
  vec3 albedo;
  vec3 emissive;       // radiance
  float occlusion;     // of ambient light, 1: none
  vec3 specular;       // Phong: of the highlight; specular-glossiness: at normal incidence
  float shininess;     // Phong
  float metallic;
  float roughness;
#ifdef BAKED_LIGHT
  vec3 bakedIrradiance;
#endif
};
