// The irradiance that one light gives at the points of a texture, and whether it may reach a surface
// there that faces it.
#include "render/lights.glsl"

uniform sampler2D points;
uniform int lightIndex;

layout(location = 0) out vec4 result;

void main() {
  vec3 positionW = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;
  LightSample light = sampleLight(lights[lightIndex], positionW);
  bool reached = mayLight(lights[lightIndex], positionW, light.toLightW);
  result = vec4(light.irradiance, reached ? 1.0 : 0.0);
}
