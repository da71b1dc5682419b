#include "render/layered_shadows.hpp"

namespace lucerna::render {

void fitLayers(gpu::Device& device, gpu::Texture& texture, gpu::Format format,
               const gpu::Texture& picture, int scale, int layers, const char* label) {
  const gpu::TextureDesc desc{.kind = gpu::TextureKind::Array2D,
                              .format = format,
                              .width = (picture.width() + scale - 1) / scale,
                              .height = (picture.height() + scale - 1) / scale,
                              .layers = arrayLayersOf(layers)};
  if (layers == 0) texture = {};
  if (layers > 0 && (!texture || !(texture.desc() == desc)))
    texture = device.createTexture(desc, label);
}

gpu::Targets targetsOf(const gpu::Texture& array) {
  gpu::Targets targets;
  for (int layer = 0; layer < array.desc().layers; ++layer)
    targets.colors.push_back({&array, gpu::Load::Clear, vec4(0.f), layer});
  return targets;
}

}  // namespace lucerna::render
