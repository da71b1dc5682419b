#include "gpu/texture.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "gpu/device_impl.hpp"
#include "gpu/gl_format.hpp"

namespace lucerna::gpu {
namespace {

GLenum target(TextureKind kind) {
  switch (kind) {
    case TextureKind::Plain2D:
      return GL_TEXTURE_2D;
    case TextureKind::Array2D:
      return GL_TEXTURE_2D_ARRAY;
    case TextureKind::Cube:
      return GL_TEXTURE_CUBE_MAP;
    case TextureKind::CubeArray:
      return GL_TEXTURE_CUBE_MAP_ARRAY;
    case TextureKind::Multisample2D:
      break;
  }
  return GL_TEXTURE_2D_MULTISAMPLE;
}

int fullChain(const TextureDesc& desc) {
  return std::bit_width(static_cast<unsigned>(std::max(desc.width, desc.height)));
}

void checkDesc(const TextureDesc& desc, const Capabilities& capabilities,
               const std::string& label) {
  const int limit = capabilities.maxTextureSide;
  CHECK(desc.width >= 1 && desc.height >= 1 && desc.width <= limit && desc.height <= limit,
        "texture '{}' is {}x{}; sides are 1 to {} here", label, desc.width, desc.height, limit);
  const bool cube = desc.kind == TextureKind::Cube || desc.kind == TextureKind::CubeArray;
  CHECK(!cube || (desc.width == desc.height && desc.layers % 6 == 0),
        "cube texture '{}' is {}x{} with {} layers", label, desc.width, desc.height, desc.layers);
  CHECK(desc.layers <= capabilities.maxTextureLayers, "texture '{}': {} layers; at most {} here",
        label, desc.layers, capabilities.maxTextureLayers);
  CHECK(desc.layers >= 1 && desc.levels <= fullChain(desc), "texture '{}': {} layers, {} levels",
        label, desc.layers, desc.levels);
  CHECK(desc.kind == TextureKind::Multisample2D
            ? desc.levels == 1 && desc.samples <= capabilities.maxSamples
            : desc.samples == 1,
        "texture '{}': {} samples, {} levels", label, desc.samples, desc.levels);
}

void checkLayer(const Texture& texture, int layer) {
  CHECK(texture && layer >= 0 && layer < texture.desc().layers, "layer {} of texture '{}' with {}",
        layer, texture.label(), texture.desc().layers);
}

bool isLayered(const TextureDesc& desc) {
  return desc.layers > 1 || desc.kind == TextureKind::Array2D;
}

}  // namespace

std::uint64_t TextureDesc::bytes() const {
  const int count = levels == 0 ? fullChain(*this) : levels;
  std::uint64_t texels = 0;
  for (int level = 0; level < count; ++level)
    texels += static_cast<std::uint64_t>(std::max(width >> level, 1)) *
              static_cast<std::uint64_t>(std::max(height >> level, 1));
  return texels * static_cast<std::uint64_t>(layers) * static_cast<std::uint64_t>(samples) *
         static_cast<std::uint64_t>(info(format).bytes);
}

OutOfMemory::OutOfMemory(const std::string& label, const TextureDesc& desc, std::string_view remedy)
    : std::runtime_error(fmt::format(
          "the driver has no memory for the texture '{}' of {} x {}{} pixels, {:.0f} MiB; {}",
          label, desc.width, desc.height, desc.layers > 1 ? fmt::format(" x {}", desc.layers) : "",
          static_cast<double>(desc.bytes()) / (1 << 20), remedy)) {}

void Texture::swap(Texture& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(id_, other.id_);
  std::swap(desc_, other.desc_);
  std::swap(label_, other.label_);
}

Texture::~Texture() {
  if (id_ == 0) return;
  Device::Impl& impl = device_->impl();
  impl.forgetTexture(id_);
  glDeleteTextures(1, &id_);
  --impl.objects.textures;
  impl.objects.textureBytes -= desc_.bytes();
}

void Device::Impl::forgetTexture(GLuint texture) {
  for (auto& unit : units)
    if (unit.first == texture) unit = {};
  std::erase_if(framebuffers, [&](const auto& entry) {
    const auto uses = [&](const FramebufferKey::Attachment& a) { return a.texture == texture; };
    const FramebufferKey& key = entry.first;
    if (!uses(key.depth) && std::none_of(key.colors.begin(), key.colors.end(), uses)) return false;
    if (boundFramebuffer == entry.second) boundFramebuffer = 0;  // GL falls back to 0 as well
    glDeleteFramebuffers(1, &entry.second);
    --objects.framebuffers;
    return true;
  });
}

Texture Device::createTexture(const TextureDesc& wanted, std::string label,
                              std::string_view remedy) {
  TextureDesc desc = wanted;
  if (desc.kind == TextureKind::Cube) desc.layers = 6;
  if (desc.levels == 0) desc.levels = fullChain(desc);
  checkDesc(desc, capabilities(), label);
  Texture texture;
  texture.device_ = this;
  texture.desc_ = desc;
  texture.label_ = std::move(label);
  glCreateTextures(target(desc.kind), 1, &texture.id_);
  const GLenum format = internalFormat(desc.format);
  if (desc.kind == TextureKind::Multisample2D)
    glTextureStorage2DMultisample(texture.id_, desc.samples, format, desc.width, desc.height,
                                  GL_TRUE);
  else if (desc.kind == TextureKind::Array2D || desc.kind == TextureKind::CubeArray)
    glTextureStorage3D(texture.id_, desc.levels, format, desc.width, desc.height, desc.layers);
  else
    glTextureStorage2D(texture.id_, desc.levels, format, desc.width, desc.height);
  ++impl_->objects.textures;
  impl_->objects.textureBytes += desc.bytes();
  if (glGetError() == GL_OUT_OF_MEMORY) throw OutOfMemory(texture.label_, desc, remedy);
  impl_->setLabel(GL_TEXTURE, texture.id_, texture.label_);
  return texture;
}

void Device::upload(const Texture& texture, const Image& image, int layer) {
  CHECK(image.width() == texture.width() && image.height() == texture.height(),
        "texture '{}' is {}x{}, the image {}x{}", texture.label(), texture.width(),
        texture.height(), image.width(), image.height());
  uploadPart(texture, image, layer, ivec2(0));
}

void Device::uploadPart(const Texture& texture, const Image& image, int layer, ivec2 first) {
  checkLayer(texture, layer);
  CHECK(first.x >= 0 && first.y >= 0 && first.x + image.width() <= texture.width() &&
            first.y + image.height() <= texture.height(),
        "texture '{}' is {}x{}, the part {}x{} at {}, {}", texture.label(), texture.width(),
        texture.height(), image.width(), image.height(), first.x, first.y);
  const Transfer transfer = uploadTransfer(texture.format(), image.channels(), image.type());
  if (isLayered(texture.desc()))
    glTextureSubImage3D(texture.id(), 0, first.x, first.y, layer, image.width(), image.height(), 1,
                        transfer.layout, transfer.type, image.bytes().data());
  else
    glTextureSubImage2D(texture.id(), 0, first.x, first.y, image.width(), image.height(),
                        transfer.layout, transfer.type, image.bytes().data());
  impl_->counters.uploads += image.bytes().size();
}

void Device::generateMipmaps(const Texture& texture) {
  glGenerateTextureMipmap(texture.id());
}

namespace {

// Hands the value to clear(layout, type, texel) as the format wants it.
template <typename Clear>
void clearWith(const Texture& texture, vec4 value, const Clear& clear) {
  const FormatInfo& format = info(texture.format());
  if (format.kind == FormatClass::Uint || format.kind == FormatClass::Int) {
    const glm::ivec4 rounded = glm::round(value);
    clear(GL_RGBA_INTEGER, GL_INT, &rounded);
  } else if (format.format == Format::Depth32FStencil8) {
    const struct {
      float depth;
      std::uint32_t stencil;
    } both{value.x, 0};
    clear(GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, &both);
  } else if (format.kind == FormatClass::Depth) {
    clear(GL_DEPTH_COMPONENT, GL_FLOAT, &value.x);
  } else {
    // Unlike the clear of a render target, glClearTexImage stores sRGB values as they come.
    if (format.format == Format::Srgb8Alpha8)
      for (int i = 0; i < 3; ++i) value[i] = srgbFromLinear(value[i]);
    clear(GL_RGBA, GL_FLOAT, &value);
  }
}

}  // namespace

void Device::clear(const Texture& texture, vec4 value) {
  clearWith(texture, value, [&](GLenum layout, GLenum type, const void* texel) {
    for (int level = 0; level < texture.desc().levels; ++level)
      glClearTexImage(texture.id(), level, layout, type, texel);
  });
}

void Device::clear(const Texture& texture, vec4 value, int layer, Rect rect) {
  checkLayer(texture, layer);
  clearWith(texture, value, [&](GLenum layout, GLenum type, const void* texel) {
    glClearTexSubImage(texture.id(), 0, rect.x, rect.y, layer, rect.width, rect.height, 1, layout,
                       type, texel);
  });
}

Image Device::download(const Texture& texture, int layer, bool flip, int level) {
  checkLayer(texture, layer);
  CHECK(texture.desc().samples == 1, "texture '{}' is multisampled: resolve it first",
        texture.label());
  const Readback source = readback(texture.format());
  CHECK(level >= 0 && level < texture.desc().levels, "texture '{}' has no level {}",
        texture.label(), level);
  Image image(std::max(texture.width() >> level, 1), std::max(texture.height() >> level, 1),
              source.channels, source.type);
  glGetTextureSubImage(texture.id(), level, 0, 0, layer, image.width(), image.height(), 1,
                       source.transfer.layout, source.transfer.type,
                       static_cast<GLsizei>(image.bytes().size()), image.bytes().data());
  return flip ? flippedVertically(image) : image;
}

void Device::copy(const Texture& from, const Texture& to) {
  CHECK(from.desc() == to.desc(), "textures '{}' and '{}' differ in size or format", from.label(),
        to.label());
  const GLenum kind = target(from.desc().kind);
  for (int level = 0; level < from.desc().levels; ++level)
    glCopyImageSubData(from.id(), kind, level, 0, 0, 0, to.id(), kind, level, 0, 0, 0,
                       std::max(from.width() >> level, 1), std::max(from.height() >> level, 1),
                       from.desc().layers);
}

GLuint Device::Impl::sampler(const Sampler& value) {
  for (const auto& [known, id] : samplers)
    if (known == value) return id;
  const auto wrap = [](Address address) -> GLint {
    switch (address) {
      case Address::Repeat:
        return GL_REPEAT;
      case Address::MirroredRepeat:
        return GL_MIRRORED_REPEAT;
      case Address::ClampToEdge:
        return GL_CLAMP_TO_EDGE;
      case Address::ClampToBorder:
        break;
    }
    return GL_CLAMP_TO_BORDER;
  };
  const bool nearest = value.filter == Filter::Nearest;
  const bool trilinear = value.filter == Filter::Trilinear;
  GLuint id = 0;
  glCreateSamplers(1, &id);
  glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER,
                      nearest || value.magnifyNearest ? GL_NEAREST : GL_LINEAR);
  glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER,
                      nearest     ? GL_NEAREST
                      : trilinear ? GL_LINEAR_MIPMAP_LINEAR
                                  : GL_LINEAR);
  glSamplerParameteri(id, GL_TEXTURE_WRAP_S, wrap(value.u));
  glSamplerParameteri(id, GL_TEXTURE_WRAP_T, wrap(value.v));
  glSamplerParameterfv(id, GL_TEXTURE_BORDER_COLOR, &value.border.x);
  if (trilinear && anisotropy) glSamplerParameterf(id, GL_TEXTURE_MAX_ANISOTROPY_EXT, 4.f);
  if (value.compareGreaterEqual) {
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  }
  samplers.emplace_back(value, id);
  ++objects.samplers;
  return id;
}

}  // namespace lucerna::gpu
