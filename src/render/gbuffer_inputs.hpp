// The G-buffer as what deferred shading reads (render/read_gbuffer.glsl): declared and bound in one
// place for the passes that shade it.
#pragma once

#include "gpu/device.hpp"
#include "graph/pass_info.hpp"

namespace lucerna::render {

struct GBufferInputs {
  graph::In<gpu::Texture> depth, normal, albedo, specular, material, emissive;
};

// Ports: derived from GBufferInputs.
// depthHalo: px of depth read around the pixel.
template <typename Params, typename Ports>
void readGBuffer(graph::PassInfo<Params, Ports>& d, int depthHalo = 0) {
  using gpu::Format;
  const auto read = [&](const char* name, graph::In<gpu::Texture> GBufferInputs::* member,
                        Format format, const char* help) {
    auto port = d.read(name, static_cast<graph::In<gpu::Texture> Ports::*>(member));
    port.texture(format).help(help);
    if (member == &GBufferInputs::depth) {
      port.halo(depthHalo);
    } else {
      port.sameSizeAs("depth");
    }
  };
  read("depth", &GBufferInputs::depth, Format::Depth32F, "Reversed depth.");
  read("normal", &GBufferInputs::normal, Format::Rg16Unorm, "View-space normal, octahedral.");
  read("albedo", &GBufferInputs::albedo, Format::Srgb8Alpha8, "Diffuse or base colour.");
  read("specular", &GBufferInputs::specular, Format::Srgb8Alpha8,
       "Specular and occlusion of ambient light.");
  read("material", &GBufferInputs::material, Format::Rgba8Uint,
       "Type, shininess or roughness, metallic.");
  read("emissive", &GBufferInputs::emissive, Format::R11G11B10Float, "Radiance.");
}

inline void bindGBuffer(gpu::Commands& commands, const GBufferInputs& inputs) {
  commands.texture("depth", *inputs.depth, gpu::kNearest);
  commands.texture("normal", *inputs.normal, gpu::kNearest);
  commands.texture("albedo", *inputs.albedo, gpu::kNearest);
  commands.texture("specular", *inputs.specular, gpu::kNearest);
  commands.texture("material", *inputs.material, gpu::kNearest);
  commands.texture("emissive", *inputs.emissive, gpu::kNearest);
}

}  // namespace lucerna::render
