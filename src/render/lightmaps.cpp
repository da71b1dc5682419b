#include "render/lightmaps.hpp"

#include <algorithm>
#include <bit>

#include "core/parallel.hpp"
#include "image/rgb9e5.hpp"

namespace lucerna::render {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

// One channel of F32 with the texels' bits, as Device::upload() takes them.
Image packed(const Image& map, ivec2 first, ivec2 size) {
  Image texels(size.x, size.y, 1, ComponentType::F32);
  parallelFor(static_cast<std::size_t>(size.y), kRowsAtOnce,
              [&](std::size_t begin, std::size_t end) {
                for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                  for (int x = 0; x < size.x; ++x) {
                    const float* color = map.pixel<float>(first.x + x, first.y + y);
                    *texels.pixel<float>(x, y) =
                        std::bit_cast<float>(toRgb9e5({color[0], color[1], color[2]}));
                  }
              });
  return texels;
}

}  // namespace

Status upload(gpu::Device& device, Lightmaps& lightmaps, std::span<const Image> maps) {
  lightmaps.maps = {};
  if (maps.empty()) return {};
  const int side = maps[0].width();
  const int limit = device.capabilities().maxTextureSide;
  if (side > limit)
    return error(ErrorKind::NoGl,
                 "the lightmaps have {} texels a side and this driver's textures at most {}; bake "
                 "the scene into smaller maps",
                 side, limit);
  const auto layers = static_cast<std::size_t>(device.capabilities().maxTextureLayers);
  if (maps.size() > layers)
    return error(ErrorKind::NoGl,
                 "the lightmap has {} maps and this driver's textures at most {} layers; bake the "
                 "scene into larger maps (--size) or at less density",
                 maps.size(), layers);
  lightmaps.maps = device.createTexture({.kind = gpu::TextureKind::Array2D,
                                         .format = gpu::Format::Rgb9E5,
                                         .width = side,
                                         .height = side,
                                         .layers = static_cast<int>(maps.size())},
                                        "lightmaps", "bake the scene at less density");
  for (std::size_t i = 0; i < maps.size(); ++i)
    device.upload(lightmaps.maps, packed(maps[i], ivec2(0), ivec2(side)), static_cast<int>(i));
  return {};
}

void update(gpu::Device& device, Lightmaps& lightmaps, std::span<const Image> maps,
            std::span<const MapPart> parts) {
  for (const MapPart& part : parts)
    device.uploadPart(lightmaps.maps,
                      packed(maps[static_cast<std::size_t>(part.map)], part.first, part.size),
                      part.map, part.first);
}

bool bakesLight(const GpuScene& gpuScene, const Lightmaps* lightmaps) {
  return lightmaps && lightmaps->maps && gpuScene.lightmapCoords;
}

void bindLightmaps(gpu::Rendering& rendering, const Lightmaps& lightmaps) {
  rendering.texture("lightmaps", lightmaps.maps, gpu::kLinear);
}

}  // namespace lucerna::render
