// What a surface sends to the eye. The one place that shades: TiledLighting, Forward and Transparency
// call shade() with the same Surface, so they agree.
//   BAKED_LIGHT  see render/surface.glsl
#include "render/lights.glsl"
#include "render/tile_lights.glsl"
#include "render/surface.glsl"

const float kPi = 3.14159265358979;
// Below this a point light's highlight is smaller than a pixel and D overflows.
const float kLowestRoughness = 0.045;

// Radiance for unit irradiance E on a surface facing the light:
//   Phong  (rd (n.l) + rs (v.r)^h) / pi    for n.l > 0; the division turns E into system A's IL
vec3 reflectedPhong(Surface s, vec3 toLightW, float cosLight) {
  vec3 reflectedW = 2.0 * cosLight * s.normalW - toLightW;
  float cosReflected = dot(s.toEyeW, reflectedW);
  float highlight = cosReflected > 0.0 ? pow(cosReflected, s.shininess) : 0.0;
  return (s.albedo * cosLight + s.specular * highlight) / kPi;
}

//   metallic-roughness  ((1 - F)(1 - metallic) albedo / pi + D V F) (n.l)
// D: Trowbridge-Reitz; V: Smith, height-correlated (Heitz, JCGT 3(2), 2014, eq. 99, over 4 n.l n.v);
// F: Schlick 1994; the mix of both lobes as in glTF 2.0 appendix B. Alpha is roughness squared.
// Specular-glossiness differs in F0, which it states, and is never metallic.
vec3 reflectedMetallicRoughness(Surface s, vec3 toLightW, float cosLight) {
  float roughness = max(s.roughness, kLowestRoughness);
  float alpha = roughness * roughness;
  float alpha2 = alpha * alpha;
  vec3 halfwayW = normalize(toLightW + s.toEyeW);
  float cosEye = max(dot(s.normalW, s.toEyeW), 1e-4);
  float cosHalf = clamp(dot(s.normalW, halfwayW), 0.0, 1.0);
  float cosDifference = clamp(dot(s.toEyeW, halfwayW), 0.0, 1.0);

  // 1 - cosHalf^2 (1 - alpha2), without cancellation near cosHalf = 1.
  vec3 sine = cross(s.normalW, halfwayW);
  float spread = dot(sine, sine) + cosHalf * cosHalf * alpha2;
  float distribution = alpha2 / (kPi * spread * spread);
  float visibility = 0.5 / (cosLight * sqrt(cosEye * cosEye * (1.0 - alpha2) + alpha2) +
                            cosEye * sqrt(cosLight * cosLight * (1.0 - alpha2) + alpha2));
  vec3 f0 = s.type == kTypeSpecularGlossiness ? s.specular
                                              : mix(vec3(0.04), s.albedo, s.metallic);
  float x = 1.0 - cosDifference;
  vec3 fresnel = f0 + (1.0 - f0) * (x * x * x * x * x);

  vec3 diffuse = (1.0 - fresnel) * (1.0 - s.metallic) * s.albedo / kPi;
  return (diffuse + distribution * visibility * fresnel) * cosLight;
}

vec3 reflectedLight(Surface s, uint lightIndex) {
  LightSample light = sampleLight(lights[lightIndex], s.positionW);
  float cosLight = dot(s.normalW, light.toLightW);
  if (cosLight <= 0.0) return vec3(0.0);  // specular terms, too
  vec3 reflectance = s.type == kTypePhong
                         ? reflectedPhong(s, light.toLightW, cosLight)
                         : reflectedMetallicRoughness(s, light.toLightW, cosLight);
  return reflectance * light.irradiance;
}

// There is no environment to reflect yet: what would be reflected as highlight counts as diffuse.
vec3 ambientReflectance(Surface s) {
  return s.type == kTypeSpecularGlossiness ? s.albedo + s.specular : s.albedo;
}

#ifdef BAKED_LIGHT
// Share of light from all around that a highlight gives back, the mean of all directions to the eye: 1 less
// what D V loses, as light that meets microfacets twice is left out. Within 0.015 of the integral.
float highlightShare(float roughness) {
  float alpha2 = pow(roughness, 4.0);
  return 1.0 - 1.9 * alpha2 / (1.0 + 2.2 * alpha2);
}

// No direction is left of baked light: what a highlight would reflect of it counts as diffuse.
vec3 reflectedBakedLight(Surface s) {
  vec3 albedo = s.albedo;
  float share = highlightShare(s.roughness);
  if (s.type == kTypeMetallicRoughness) albedo *= mix(1.0, share, s.metallic);
  if (s.type == kTypeSpecularGlossiness) albedo += s.specular * share;
  return albedo * s.bakedIrradiance / kPi;
}
#endif

// Factor on the ambient light; each pass that shades has it as a parameter.
uniform float ambientScale = 1.0;

#ifdef LIGHT_VISIBILITY
// Share of a light (index as in LightBlock) that reaches the surface, of each colour. Who defines the
// macro before including this defines the function after.
vec3 lightVisibility(Surface s, uint light);
#endif

vec3 arrivingLight(Surface s, uint light) {
  vec3 reflected = reflectedLight(s, light);
#ifdef LIGHT_VISIBILITY
  if (reflected != vec3(0.0)) reflected *= lightVisibility(s, light);
#endif
  return reflected;
}

vec3 shade(Surface s) {
  if (s.type == kTypeUnlit) return s.albedo;
  vec3 radiance = s.emissive + ambientScale * ambientLight.rgb * ambientReflectance(s) * s.occlusion;
#ifdef BAKED_LIGHT
  radiance += reflectedBakedLight(s);
#endif
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  // One plain loop: where pixels leave an inner loop at different lights, llvmpipe (Mesa 22.3) takes
  // the index for equal in all of them and reads the wrong light.
  for (uint i = firstLightAt(pixel); i < lightCount.x; i = lightAfterAt(pixel, i))
    if (mayLight(lights[i], s.positionW, s.normalW)) radiance += arrivingLight(s, i);
  return radiance;
}
