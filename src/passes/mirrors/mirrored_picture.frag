// Shows the picture that a mirror reflects, at the same pixels, on the faces of a mirror that lie in its plane.
//   ALPHA_TEST, TEXTURE_ENVIRONMENT  see render/object_surface.glsl
// variant: ALPHA_TEST=1
// variant: TEXTURE_ENVIRONMENT=1
#include "render/object_surface.glsl"

uniform sampler2D mirroredPicture;
uniform float reflectivity;
uniform vec4 mirrorPlaneW;
uniform float tolerance;  // m

layout(location = 0) out vec4 color;

void main() {
#ifdef ALPHA_TEST
  testAlpha(materialColor().a);
#endif
  if (abs(dot(mirrorPlaneW, vec4(positionW, 1.0))) > tolerance) discard;
  color = vec4(texelFetch(mirroredPicture, ivec2(gl_FragCoord.xy), 0).rgb, reflectivity);
}
