// The values of the graph that go into a picture file, and their form there.
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "gpu/device.hpp"
#include "graph/validate.hpp"
#include "image/image_file.hpp"
#include "scene/view.hpp"

namespace lucerna::app {

enum class LayerKind { Color, Depth, Normal, Albedo };

std::vector<std::string> layerNames();  // "color", "depth", "normal", "albedo"
Result<LayerKind> layerFromName(const std::string& name);

// A layer and the port that it is read from ("GBuffer.depth").
struct LayerSource {
  LayerKind kind = LayerKind::Color;
  std::string port;
};

// Where the plan's layers come from: colour from the last linear HDR value on the way to the output
// (what the tone map reads), the others from the last pass that writes a port of their name. Errors
// (ErrorKind::Usage) name the layer that this pipeline does not make.
Result<std::vector<LayerSource>> findLayers(const graph::Pipeline& pipeline,
                                            const graph::Plan& plan,
                                            const std::vector<LayerKind>& kinds);

// The picture of a layer (F32, top row first): colour and albedo linear RGB; depth in metres along
// the view direction, infinite where nothing is; normal a unit vector in world space, zero where
// nothing is. depth: for Normal, which pixels are covered; may be null.
ExrLayer readLayer(gpu::Device& device, LayerKind kind, const gpu::Texture& texture,
                   const gpu::Texture* depth, const scene::View& view);

}  // namespace lucerna::app
