// Parts of upload() (render/gpu_scene.hpp), one a file.
#pragma once

#include "render/gpu_scene.hpp"

namespace lucerna::render {

// meshes, vertices, indices, lightmapCoords, listIndices, input.
void uploadGeometry(gpu::Device& device, GpuScene& gpuScene);
// The vertices of meshes whose version is another than on the GPU.
void uploadBentMeshes(gpu::Device& device, GpuScene& gpuScene);

// textures, linearTextures, samplers, white, whiteCube.
void uploadTextures(gpu::Device& device, GpuScene& gpuScene);

}  // namespace lucerna::render
