// One component of the G-buffer as sRGB-encoded colour.
#include "render/read_gbuffer.glsl"
#include "render/srgb.glsl"

uniform int component;   // in the order of ShowGBuffer::Component
uniform float scale;     // m

layout(location = 0) out vec4 color;

// Phong blue, metallic-roughness orange, specular-glossiness red, unlit white, custom shader green.
vec3 typeColor(uint type) {
  if (type == kTypePhong) return vec3(0.25, 0.45, 0.85);
  if (type == kTypeMetallicRoughness) return vec3(0.9, 0.55, 0.2);
  if (type == kTypeSpecularGlossiness) return vec3(0.85, 0.25, 0.25);
  if (type == kTypeUnlit) return vec3(0.9);
  return vec3(0.3, 0.75, 0.35);
}

vec3 shown(Surface s) {
  switch (component) {
    case 0: return vec3(scale / (scale + -(view.viewFromWorld * vec4(s.positionW, 1.0)).z));
    case 1: return mat3(view.viewFromWorld) * s.normalW * 0.5 + 0.5;
    case 2: return srgbFromLinear(s.albedo);
    case 3: return srgbFromLinear(s.specular);
    case 4: return vec3(s.occlusion);
    case 5: return typeColor(s.type);
    case 6: return vec3(s.shininess / 255.0);
    case 7: return vec3(s.metallic);
    case 8: return srgbFromLinear(clamp(s.emissive, 0.0, 1.0));
    default: return fract(s.positionW / scale);
  }
}

void main() { color = vec4(shown(readSurface(ivec2(gl_FragCoord.xy))), 1.0); }
