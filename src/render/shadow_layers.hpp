// Which lights share a layer of screen-space shadows, as ShadowLayers finds it.
#pragma once

#include <vector>

#include "gpu/device.hpp"

namespace lucerna::render {

// Of the passes that make layered shadows: with the faults of system C as published mended, or not.
enum class LayeredVariant { Mended, Published };

struct ShadowLayers {
  static constexpr const char* kPortName = "ShadowLayers";
  std::vector<int> ofLight;  // of the LightList; -1: none
  int count = 0;             // layers in use
  int beyond = 0;            // lights that throw shadows and have no layer
  bool shared = false;       // lights of one layer overlap: their penumbrae are averaged
  gpu::Buffer block;         // ShadowLayerBlock: ofLight
};

}  // namespace lucerna::render
