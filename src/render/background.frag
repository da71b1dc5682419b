// The background behind one pixel. One of:
//   COLOR     one radiance everywhere
//   IMAGE     a picture stretched over the output
//   CUBE_MAP  six pictures around the eye
// variant: COLOR=1
// variant: IMAGE=1
// variant: CUBE_MAP=1
#include "render/view.glsl"

uniform vec3 radiance;   // of the colour; a factor on picture and cube map
#ifdef IMAGE
uniform sampler2D image;
#endif
#ifdef CUBE_MAP
uniform samplerCube cubeMap;
#endif

layout(location = 0) out vec4 color;

void main() {
  color = vec4(radiance, 1.0);
#ifdef IMAGE
  // At infinity: what is straight ahead of an off-axis eye lies at -clipFromView[2].xy. Pictures start
  // at the top, targets at the bottom.
  vec2 place = pictureUv(gl_FragCoord.xy) + 0.5 * view.clipFromView[2].xy;
  color.rgb *= texture(image, vec2(place.x, 1.0 - place.y)).rgb;
#endif
#ifdef CUBE_MAP
  // GL's cube maps are left-handed (render::GpuScene::textures).
  color.rgb *= texture(cubeMap, lookDirectionW(ndcOfPixel(gl_FragCoord.xy)) * vec3(1, 1, -1)).rgb;
#endif
}
