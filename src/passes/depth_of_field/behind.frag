// A quarter as large: of this, what blurred things in front hide is made up.
#include "passes/depth_of_field/circle.glsl"
#include "passes/depth_of_field/width.glsl"

uniform sampler2D color;
uniform sampler2D depth;

// rgb times a; a: its share of the pixels.
layout(location = 0) out vec4 behind;        // what does not lie before the plane in focus
layout(location = 1) out vec4 narrow;        // what does, in narrow circles
layout(location = 2) out float narrowRadius;  // of these, px, times a

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * 4;
  ivec2 end = min(first + 4, textureSize(depth, 0));
  behind = narrow = vec4(0.0);
  narrowRadius = 0.0;
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      float near = -circleAt(texelFetch(depth, ivec2(x, y), 0).r);
      vec4 light = vec4(finite(texelFetch(color, ivec2(x, y), 0).rgb), 1.0) / 16.0;
      if (near <= kSharp) {
        behind += light;
      } else if (!isWide(near)) {
        narrow += light;
        narrowRadius += near / 16.0;
      }
    }
}
