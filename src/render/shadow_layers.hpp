// Which lights share a layer of screen-space shadows, as ShadowLayers finds it.
#pragma once

#include <vector>

#include "gpu/device.hpp"

namespace lucerna::render {

struct ShadowLayers {
  static constexpr const char* kPortName = "ShadowLayers";
  std::vector<int> ofLight;  // of the LightList; -1: none
  int count = 0;             // layers in use
  int beyond = 0;            // lights that throw shadows and have no layer
  gpu::Buffer block;         // ShadowLayerBlock: ofLight
};

}  // namespace lucerna::render
