#include <algorithm>
#include <array>

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
    for (const scene::CustomShader::Picture& picture : material.shader.textures)
      mark(picture.texture, picture.data ? &Uses::data : &Uses::color);
  }
  if (scene.background.kind != scene::BackgroundKind::Color)
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
  const bool cube = texture.isCube();
  gpu::Texture result =
      device.createTexture({.kind = cube ? gpu::TextureKind::Cube : gpu::TextureKind::Plain2D,
                            .format = formatFor(image, color),
                            .width = image.width(),
                            .height = image.height(),
                            .layers = cube ? 6 : 1,
                            .levels = 0},
                           texture.name);
  // GL's cube maps are left-handed: with z turned round each face is upright from inside.
  constexpr std::array<std::size_t, 6> kFaceOfLayer = {0, 1, 2, 3, 5, 4};
  for (int layer = 0; layer < result.desc().layers; ++layer) {
    const auto index = static_cast<std::size_t>(layer);
    const Image& face = cube ? *texture.faces[kFaceOfLayer[index]] : image;
    device.upload(result, pixelsFor(face), layer);
  }
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

gpu::Texture whiteTexture(gpu::Device& device, gpu::TextureKind kind) {
  const int layers = kind == gpu::TextureKind::Cube ? 6 : 1;
  gpu::Texture texture = device.createTexture(
      {.kind = kind, .format = gpu::Format::Rgba8Unorm, .layers = layers}, "white");
  device.clear(texture, vec4(1.f));
  return texture;
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
  gpuScene.white = whiteTexture(device, gpu::TextureKind::Plain2D);
  gpuScene.whiteCube = whiteTexture(device, gpu::TextureKind::Cube);
}

}  // namespace lucerna::render
