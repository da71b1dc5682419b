// Which layer of screen-space shadows each light has (render/shadow_layers.hpp).

layout(std430) readonly buffer ShadowLayerBlock { int lightLayers[]; };  // -1: none
