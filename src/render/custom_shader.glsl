// The interface of a material's own shader (scene::CustomShader; "shader" of a material in a scene JSON).
// Such a file is a fragment shader that includes this one and defines
//
//   vec3 radianceOf(Surface s)   what the surface sends to the eye, linear, at the scene's brightness
//
// main(), the outputs, alpha test, opacity and depth test stand here or around it. It may use
//
//   s.positionW, s.normalW, s.toEyeW, s.albedo, s.emissive, ...   render/surface.glsl: the surface as
//                                the material and its textures describe it, metres, world space
//   shade(s)                     s lit by the ambient light, baked light and all lights; s may be changed before
//   objectPositionO              the point in the object's own space, m
//   texCoords, vertexColor       as the mesh has them: set 0 in xy, set 1 in zw
//   view, lights, material       render/view.glsl, render/lights.glsl, render/scene.glsl
//   time                         s, of the scene
//
// and uniforms of its own: float, vec2, vec3, vec4 ("parameters"), sampler2D, samplerCube ("textures").
#ifndef CUSTOM_SHADER
#define CUSTOM_SHADER 1  // the vertex shader gives objectPositionO
#endif
#include "render/forward_output.glsl"
#include "render/object_surface.glsl"
#include "render/shading.glsl"

uniform float time = 0.0;

vec3 radianceOf(Surface s);

void main() {
  vec4 baseColor = materialColor();
  testAlpha(baseColor.a);
  writeRadiance(radianceOf(surfaceOf(baseColor)), baseColor.a);
}
