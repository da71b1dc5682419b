#include "render/layered_shadows.hpp"

namespace lucerna::render {

void fitLayers(gpu::Device& device, gpu::Texture& texture, gpu::Format format,
               const gpu::Texture& picture, int layers, const char* label) {
  const gpu::TextureDesc desc{.kind = gpu::TextureKind::Array2D,
                              .format = format,
                              .width = (picture.width() + 1) / 2,
                              .height = (picture.height() + 1) / 2,
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
