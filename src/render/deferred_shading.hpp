// What passes that shade the G-buffer over the whole picture have in common: their ports, declared
// and bound in one place, and programs with and without ambient visibility
// (render/read_gbuffer.glsl).
#pragma once

#include <string>

#include "gpu/device.hpp"
#include "graph/pass_info.hpp"
#include "render/light_list.hpp"
#include "render/view_data.hpp"

namespace lucerna::render {

struct DeferredPorts {
  graph::In<ViewData> view;
  graph::In<LightList> lights;
  graph::In<gpu::Texture> depth, normal, albedo, specular, material, emissive, ambientVisibility;
  graph::InOut<gpu::Texture> color;
};

// Ports: derived from DeferredPorts. depthHalo: px of depth read around the pixel.
template <typename Params, typename Ports>
void describeDeferred(graph::PassInfo<Params, Ports>& d, int depthHalo,
                      const std::string& colorHelp) {
  using gpu::Format;
  using Texture = graph::In<gpu::Texture>;
  const auto read = [&](const char* name, Texture DeferredPorts::* member, Format format,
                        const char* help) {
    auto port = d.read(name, static_cast<Texture Ports::*>(member));
    port.texture(format).help(help);
    if (member == &DeferredPorts::depth) {
      port.halo(depthHalo);
    } else {
      port.sameSizeAs("depth");
    }
    return port;
  };
  d.read("view", static_cast<graph::In<ViewData> Ports::*>(&DeferredPorts::view))
      .help("The view that the G-buffer was drawn from.");
  d.read("lights", static_cast<graph::In<LightList> Ports::*>(&DeferredPorts::lights))
      .help("Lights that are on, and the ambient light.");
  read("depth", &DeferredPorts::depth, Format::Depth32F, "Reversed depth.");
  read("normal", &DeferredPorts::normal, Format::Rg16Unorm, "View-space normal, octahedral.");
  read("albedo", &DeferredPorts::albedo, Format::Srgb8Alpha8, "Diffuse or base colour.");
  read("specular", &DeferredPorts::specular, Format::Srgb8Alpha8,
       "Specular and occlusion of ambient light.");
  read("material", &DeferredPorts::material, Format::Rgba8Uint,
       "Type, shininess or roughness, metallic.");
  read("emissive", &DeferredPorts::emissive, Format::R11G11B10Float, "Radiance.");
  read("ambientVisibility", &DeferredPorts::ambientVisibility, Format::R8Unorm,
       "Share of the ambient light that arrives.")
      .optional();
  d.update("color", static_cast<graph::InOut<gpu::Texture> Ports::*>(&DeferredPorts::color))
      .texture(Format::Rgba16Float)
      .sizeOf("depth")
      .sameSizeAs("depth")
      .optional()
      .whenDisabled(vec4(0.f, 0.f, 0.f, 1.f))
      .help(colorHelp);
}

// A fragment shader over the whole picture that knows AMBIENT_VISIBILITY.
class DeferredProgram {
 public:
  DeferredProgram(gpu::Device& device, std::string fragment);
  const gpu::Program& of(const DeferredPorts& ports) const {
    return ports.ambientVisibility ? *occluded_ : *plain_;
  }

 private:
  gpu::ProgramPtr plain_, occluded_;
};

// Draws onto `color`, made black if it is new, with everything bound that the ports hold.
gpu::Rendering beginDeferred(gpu::Device& device, const DeferredPorts& ports);
// The triangle lies at depth 0 and passes where something nearer was drawn, so that empty pixels
// cost nothing. Depth is tested and read, never written.
gpu::RenderState deferredState(gpu::Blend blend = gpu::Blend::Off);

}  // namespace lucerna::render
