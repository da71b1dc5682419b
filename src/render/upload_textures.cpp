#include <algorithm>
#include <array>

#include "core/log.hpp"
#include "render/upload.hpp"

namespace lucerna::render {
namespace {

// Which copies of a texture the scene needs.
struct Uses {
  bool color = false, data = false;
};

std::vector<Uses> textureUses(const scene::Scene& scene) {
  std::vector<Uses> uses(scene.textures.size());
  const auto mark = [&](std::uint32_t texture, bool Uses::* use) {
    if (texture != scene::kNoTexture) uses[texture].*use = true;
  };
  for (const scene::Material& material : scene.materials) {
    mark(material.albedoTexture.texture, &Uses::color);
    mark(material.emissiveTexture.texture, &Uses::color);
    mark(material.specularTexture.texture, &Uses::color);
    mark(material.normalTexture.texture, &Uses::data);
    mark(material.metallicRoughnessTexture.texture, &Uses::data);
    mark(material.occlusionTexture.texture, &Uses::data);
  }
  if (scene.background.kind == scene::BackgroundKind::Image)
    mark(scene.background.texture, &Uses::color);
  return uses;
}

bool isFloat(const Image& image) {
  return image.type() == ComponentType::F32 || image.type() == ComponentType::Half;
}

// Floating-point pictures are linear already.
gpu::Format formatFor(const Image& image, bool color) {
  if (isFloat(image)) return gpu::Format::Rgba16Float;
  return color ? gpu::Format::Srgb8Alpha8 : gpu::Format::Rgba8Unorm;
}

Image pixelsFor(const Image& image) {
  return converted(image, isFloat(image) ? ComponentType::F32 : ComponentType::U8, 4);
}

gpu::Texture textureOf(gpu::Device& device, const scene::Texture& texture, bool color) {
  const Image& image = *texture.image;
  gpu::Texture result = device.createTexture({.format = formatFor(image, color),
                                              .width = image.width(),
                                              .height = image.height(),
                                              .levels = 0},
                                             texture.name);
  device.upload(result, pixelsFor(image));
  device.generateMipmaps(result);
  return result;
}

gpu::Address addressOf(scene::Wrap wrap) {
  switch (wrap) {
    case scene::Wrap::Repeat:
      return gpu::Address::Repeat;
    case scene::Wrap::MirroredRepeat:
      return gpu::Address::MirroredRepeat;
    case scene::Wrap::ClampToEdge:
      return gpu::Address::ClampToEdge;
  }
  return gpu::Address::Repeat;
}

gpu::Texture whiteTexture(gpu::Device& device) {
  gpu::Texture texture = device.createTexture({.format = gpu::Format::Rgba8Unorm}, "white");
  device.clear(texture, vec4(1.f));
  return texture;
}

// Faces that a cube map can be made of: all there, square, one size and kind.
bool cubeFits(const scene::Scene& scene) {
  const auto& faces = scene.background.faces;
  if (std::ranges::any_of(faces, [](std::uint32_t face) { return face == scene::kNone; }))
    return false;
  const Image& first = *scene.textures[faces[0]].image;
  return std::ranges::all_of(faces, [&](std::uint32_t face) {
    const Image& image = *scene.textures[face].image;
    return image.width() == first.width() && image.height() == first.width() &&
           isFloat(image) == isFloat(first);
  });
}

gpu::Texture backgroundCube(gpu::Device& device, const scene::Scene& scene) {
  if (scene.background.kind != scene::BackgroundKind::CubeMap) return {};
  if (!cubeFits(scene)) {
    log::warning(
        "{}: the background's cube map needs six square pictures of one size and kind; its colour "
        "is shown instead. Make the faces equal, or name a flat picture.",
        scene.name);
    return {};
  }
  // GL's cube maps are left-handed: seen with z turned round, each face is what a camera at the
  // origin sees along its axis, upright.
  constexpr std::array<int, 6> kFaceOfLayer = {0, 1, 2, 3, 5, 4};
  const Image& first = *scene.textures[scene.background.faces[0]].image;
  gpu::Texture cube = device.createTexture({.kind = gpu::TextureKind::Cube,
                                            .format = formatFor(first, true),
                                            .width = first.width(),
                                            .height = first.height(),
                                            .layers = 6,
                                            .levels = 0},
                                           "background");
  for (int layer = 0; layer < 6; ++layer) {
    const std::uint32_t face = scene.background.faces[kFaceOfLayer[layer]];
    device.upload(cube, pixelsFor(*scene.textures[face].image), layer);
  }
  device.generateMipmaps(cube);
  return cube;
}

}  // namespace

void uploadTextures(gpu::Device& device, GpuScene& gpuScene) {
  const scene::Scene& scene = *gpuScene.scene;
  const std::vector<Uses> uses = textureUses(scene);
  gpuScene.textures.clear();
  gpuScene.linearTextures.clear();
  gpuScene.samplers.clear();
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const scene::Texture& texture = scene.textures[i];
    const bool both = uses[i].color && uses[i].data;
    const bool any = uses[i].color || uses[i].data;
    gpuScene.textures.push_back(any ? textureOf(device, texture, uses[i].color) : gpu::Texture{});
    gpuScene.linearTextures.push_back(both ? textureOf(device, texture, false) : gpu::Texture{});
    gpuScene.samplers.push_back({.filter = gpu::Filter::Trilinear,
                                 .magnifyNearest = texture.nearest,
                                 .u = addressOf(texture.wrapS),
                                 .v = addressOf(texture.wrapT)});
  }
  gpuScene.white = whiteTexture(device);
  gpuScene.backgroundCube = backgroundCube(device, scene);
}

}  // namespace lucerna::render
