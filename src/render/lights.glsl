// The scene's lights at a point: the formulas of scene/light.hpp, which is their definition.
#include "render/blocks.glsl"

layout(std430) readonly buffer LightBlock {
  vec4 ambientLight;   // rgb: a white surface shows it
  uvec4 lightCount;    // x
  LightValues lights[];
};

const float kNearestDistance = 0.01;  // m; keeps 1/d^2 finite at the light itself

struct LightSample {
  vec3 toLightW;       // unit
  vec3 irradiance;     // at a surface that faces the light
};

// attenuationAt() of scene/light.hpp; directional lights carry (1, 0, 0) and no reach.
float attenuationAt(LightValues light, float distance) {
  float d = max(distance, kNearestDistance);
  float ratio = distance * light.intensity.w;
  float window = max(1.0 - ratio * ratio * ratio * ratio, 0.0);
  vec3 a = light.attenuation.xyz;
  return window * window / (a.x + a.y * d + a.z * d * d);
}

// coneFactor() of scene/light.hpp.
float coneFactor(LightValues light, float cosAngle) {
  float ramp = clamp((cosAngle - light.attenuation.w) * light.shape.x, 0.0, 1.0);
  float power = light.axis.w > 0.0 ? pow(max(cosAngle, 1e-6), light.axis.w) : 1.0;
  return ramp * ramp * power;
}

LightSample sampleLight(LightValues light, vec3 positionW) {
  vec3 toLight = light.position.xyz - positionW * light.position.w;
  float distance = length(toLight);
  LightSample result;
  result.toLightW = toLight / max(distance, 1e-6);
  float strength = attenuationAt(light, distance) *
                   coneFactor(light, -dot(result.toLightW, light.axis.xyz));
  result.irradiance = light.intensity.rgb * strength;
  return result;
}

// False only if the light gives nothing to this surface: out of its reach, behind the surface, or
// outside its cone. Much cheaper than sampling it.
bool mayLight(LightValues light, vec3 positionW, vec3 normalW) {
  vec3 toLight = light.position.xyz - positionW * light.position.w;
  float squared = dot(toLight, toLight);
  return dot(toLight, normalW) > 0.0 &&
         squared * light.intensity.w * light.intensity.w < 1.0 &&
         -dot(toLight, light.axis.xyz) > light.attenuation.w * sqrt(squared);
}
