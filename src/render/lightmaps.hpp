// The resource "lightmaps": baked light on the GPU. Objects find theirs by Mesh::lightmap; shaders,
// by render/baked_light.glsl.
//
// Texels are Rgb9E5: 4 bytes, half as many as half floats take, each off by at most 1/512 of its
// largest channel, where a step of eight bits sRGB is 1/110 or more; R11G11B10Float is off by 1/64
// in blue, which shows as bands. Its drift under sums does not matter: the sums are made on the
// CPU in F32, and the GPU has the result. Above 65,408 is cut.
#pragma once

#include <span>

#include "gpu/device.hpp"
#include "image/image.hpp"
#include "render/gpu_scene.hpp"

namespace lucerna::render {

struct Lightmaps {
  static constexpr const char* kPortName = "Lightmaps";
  gpu::Texture maps;  // array of Rgb9E5, a layer a map, no mipmaps; none: nothing was baked
};

// A part of one map.
struct MapPart {
  int map = 0;
  ivec2 first{0}, size{0};  // texels, (0, 0) the map's top left
};

// maps: F32 RGB irradiance, squares of one size; none makes Lightmaps without any. Errors
// (ErrorKind::NoGl): the driver's textures are too small for them, or have too few layers.
Status upload(gpu::Device& device, Lightmaps& lightmaps, std::span<const Image> maps);
// Parts of them that have changed; the maps are as many and as large as were uploaded.
void update(gpu::Device& device, Lightmaps& lightmaps, std::span<const Image> maps,
            std::span<const MapPart> parts);

// Whether drawing the scene may ask for BAKED_LIGHT: it has maps, and places in them. Null: no.
bool bakesLight(const GpuScene& gpuScene, const Lightmaps* lightmaps);
// For programs with BAKED_LIGHT.
void bindLightmaps(gpu::Rendering& rendering, const Lightmaps& lightmaps);

}  // namespace lucerna::render
