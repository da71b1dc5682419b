// The G-buffer's layout: what GBuffer writes and everyone else reads.
//   normal    Rg16Unorm       view space, octahedral
//   albedo    Srgb8Alpha8     rgb albedo, a 1
//   specular  Srgb8Alpha8     rgb specular of Phong and specular-glossiness, a occlusion of ambient
//                             light (linear)
//   material  Rgba8Uint       r type, g shininess 0..255 (Phong) or roughness, b metallic, a 0
//   emissive  R11G11B10Float  radiance
//   bakedIrradiance  Rgba16Float  irradiance, 1; only where GBuffer's parameter `baked` asks for it
#include "render/normal_encoding.glsl"
#include "render/surface.glsl"
#include "render/view.glsl"

uvec4 packMaterial(Surface s) {
  float gloss = s.type == kTypePhong ? s.shininess : s.roughness * 255.0;
  return uvec4(s.type, uint(clamp(gloss, 0.0, 255.0) + 0.5),
               uint(clamp(s.metallic, 0.0, 1.0) * 255.0 + 0.5), 0u);
}

// Sets what the material texel holds.
void unpackMaterial(uvec4 texel, inout Surface s) {
  s.type = texel.r;
  s.shininess = float(texel.g);
  s.roughness = float(texel.g) / 255.0;
  s.metallic = float(texel.b) / 255.0;
}
