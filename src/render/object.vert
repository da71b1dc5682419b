// Places the scene's vertices: the vertex shader of everything that draws a render::DrawList.
//   TEXTURE_ENVIRONMENT  for materials with generated coordinates (render/texture_environment.glsl)
//   CUSTOM_SHADER        for materials with a shader of their own (render/custom_shader.glsl)
//   BAKED_LIGHT          gives where baked light lies (render/baked_light.glsl)
//   SHADOW_VIEWS         instances say which view they are drawn in
//   SHADOW_LAYERS        and that chooses the layer
// variant: TEXTURE_ENVIRONMENT=1
// variant: BAKED_LIGHT=1
// variant: SHADOW_VIEWS=1
// variant: SHADOW_VIEWS=1 SHADOW_LAYERS=1
#ifdef SHADOW_LAYERS
#extension GL_ARB_shader_viewport_layer_array : require
#endif
#ifdef SHADOW_VIEWS
layout(location = 6) flat out uint viewIndex;
layout(location = 7) flat out vec4 depthPlaneW;
layout(std430) readonly buffer DrawViewBlock { uint drawViews[]; };  // of the list's objects
#endif
#include "render/shadow_views.glsl"
#include "render/scene.glsl"
#include "render/view.glsl"

layout(location = 0) in vec3 positionO;
layout(location = 1) in vec3 normalO;
layout(location = 2) in vec4 tangentO;     // w: handedness; all 0 where the mesh has none
layout(location = 3) in vec2 texCoord0;
layout(location = 4) in vec2 texCoord1;
layout(location = 5) in vec4 color;        // linear
layout(location = 6) in uint listIndex;    // once an instance, reached through baseInstance
#ifdef BAKED_LIGHT
layout(location = 7) in vec3 lightmap;     // u, v and the map; -1: none
#endif

layout(std430) readonly buffer DrawOrderBlock { uint drawOrder[]; };  // the list's objects

// Two programs that draw the same object must give the same depth.
invariant gl_Position;

layout(location = 0) out vec3 positionW;
layout(location = 1) out vec3 normalW;
layout(location = 2) out vec4 tangentW;    // w: handedness in the world; all 0 where there is none
layout(location = 3) out vec4 texCoords;   // set 0 in xy, set 1 in zw
layout(location = 4) out vec4 vertexColor;
#if defined(TEXTURE_ENVIRONMENT) || defined(CUSTOM_SHADER)
layout(location = 5) out vec3 objectPositionO;
#endif
#ifdef BAKED_LIGHT
layout(location = 6) out vec3 lightmapCoords;
#endif

void main() {
  ObjectValues object = objects[drawOrder[listIndex]];
#ifdef SHADOW_VIEWS
  viewIndex = drawViews[listIndex];
  depthPlaneW = shadowViews[viewIndex].depthPlaneW;
#endif
#ifdef SHADOW_LAYERS
  gl_Layer = int(shadowViews[viewIndex].place.x);
#endif
  mat3 normalMatrix =
      mat3(object.normalMatrix0.xyz, object.normalMatrix1.xyz, object.normalMatrix2.xyz);
  vec4 position = object.worldFromObject * vec4(positionO, 1.0);
  positionW = position.xyz;
  normalW = normalMatrix * normalO;
  // Unequal scales would weight the corners of a triangle differently.
  normalW *= inversesqrt(max(dot(normalW, normalW), 1e-30));
  // A mirror image turns the bitangent round.
  float handedness = object.info.x == 1u ? -tangentO.w : tangentO.w;
  tangentW = vec4(mat3(object.worldFromObject) * tangentO.xyz, handedness);
  texCoords = vec4(texCoord0, texCoord1);
  vertexColor = color;
#if defined(TEXTURE_ENVIRONMENT) || defined(CUSTOM_SHADER)
  objectPositionO = positionO;
#endif
#ifdef BAKED_LIGHT
  lightmapCoords = lightmap;
#endif
  gl_Position = windowPosition(view.viewFromWorld * position);
  gl_ClipDistance[0] = dot(view.clipPlaneW, position);
}
