// Screen-space shadows in layers (render/shadow_layers.hpp), at the picture's size or half of it:
// texel (x, y) stands for the picture's pixel (scale x, scale y), scale being 1 or 2. Layer l lies
// in channel l % 4 of array layer l / 4.
#pragma once

#include "gpu/device.hpp"

namespace lucerna::render {

// How wide penumbrae are on a surface across the light, m; 0: nothing is in the light's way.
struct Penumbrae {
  static constexpr const char* kPortName = "Penumbrae";
  int layers = 0, scale = 2;
  gpu::Texture widths;  // Rgba16Float array; none of no layers
};

// As hard shadows, but with little weight where what blocks is close by: exp(-falloff (receiver -
// blocker)), at most 1, of distances from the light.
struct ShadowValues {
  static constexpr const char* kPortName = "ShadowValues";
  int layers = 0;
  gpu::Texture bytes;  // R32Uint array of the picture's size, four bytes each, shares of 255
};

// What share of its light each layer lets through: bytes of 0 to 254, as shares of 254; 255: a
// pixel has no penumbra that shows, and the mask's bit says it.
struct LayeredShadows {
  static constexpr const char* kPortName = "LayeredShadows";
  int layers = 0, scale = 2;
  gpu::Texture visibility;  // R32Uint array, four bytes each; none of no layers
};

// What share of each colour translucent surfaces let through, of lights that have a layer and meet
// some (render/layered_transmittance.glsl). Slot s lies in channel s % 4 of array layer s / 4.
struct LayeredTransmittance {
  static constexpr const char* kPortName = "LayeredTransmittance";
  int slots = 0, scale = 2;
  gpu::Buffer slotBlock;  // PaneSlotBlock: of each light
  gpu::Texture colors;    // Rgba32Uint array; none of no slots
};

inline int arrayLayersOf(int layers) {
  return (layers + 3) / 4;
}

enum class LayerResolution { Half, Full };
inline int scaleOf(LayerResolution resolution) {
  return resolution == LayerResolution::Half ? 2 : 1;
}

// An array with room for that many layers, of the size of `picture` over scale, rounded up; kept if
// it is one already.
void fitLayers(gpu::Device& device, gpu::Texture& texture, gpu::Format format,
               const gpu::Texture& picture, int scale, int layers, const char* label);

// All its layers as targets.
gpu::Targets targetsOf(const gpu::Texture& array);

}  // namespace lucerna::render
