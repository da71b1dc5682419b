#include "gpu/gl_format.hpp"

#include <array>

#include "core/check.hpp"

namespace lucerna::gpu {
namespace {

// Order of the enumeration Format.
constexpr std::array<GLenum, 25> kInternalFormats = {GL_R8,
                                                     GL_RG8,
                                                     GL_RGBA8,
                                                     GL_SRGB8_ALPHA8,
                                                     GL_R8UI,
                                                     GL_RGBA8UI,
                                                     GL_R16,
                                                     GL_RG16,
                                                     GL_RGBA16,
                                                     GL_R16F,
                                                     GL_RG16F,
                                                     GL_RGBA16F,
                                                     GL_R32F,
                                                     GL_RG32F,
                                                     GL_RGBA32F,
                                                     GL_R11F_G11F_B10F,
                                                     GL_RGB9_E5,
                                                     GL_R16UI,
                                                     GL_R32UI,
                                                     GL_RG32UI,
                                                     GL_RGBA32UI,
                                                     GL_R32I,
                                                     GL_DEPTH_COMPONENT32F,
                                                     GL_DEPTH_COMPONENT24,
                                                     GL_DEPTH32F_STENCIL8};

constexpr std::array<GLenum, 4> kLayouts = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
constexpr std::array<GLenum, 4> kIntegerLayouts = {GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER,
                                                   GL_RGBA_INTEGER};

bool isInteger(FormatClass kind) {
  return kind == FormatClass::Uint || kind == FormatClass::Int;
}

GLenum layoutOf(const FormatInfo& format, int channels) {
  if (format.kind == FormatClass::Depth) return GL_DEPTH_COMPONENT;
  const auto index = static_cast<std::size_t>(channels - 1);
  return isInteger(format.kind) ? kIntegerLayouts.at(index) : kLayouts.at(index);
}

// In integer formats the 32 bits of an F32 component are the integer.
GLenum componentType(ComponentType type, FormatClass kind) {
  switch (type) {
    case ComponentType::U8:
      return GL_UNSIGNED_BYTE;
    case ComponentType::U16:
      return GL_UNSIGNED_SHORT;
    case ComponentType::Half:
      return GL_HALF_FLOAT;
    case ComponentType::F32:
      break;
  }
  return kind == FormatClass::Uint ? GL_UNSIGNED_INT : kind == FormatClass::Int ? GL_INT : GL_FLOAT;
}

ComponentType componentOf(const FormatInfo& format) {
  const bool packed = format.format == Format::R11G11B10Float || format.format == Format::Rgb9E5;
  if (packed || format.kind == FormatClass::Depth) return ComponentType::F32;
  switch (format.bytes / format.channels) {
    case 1:
      return ComponentType::U8;
    case 2:
      return format.kind == FormatClass::Float ? ComponentType::Half : ComponentType::U16;
    default:
      return ComponentType::F32;
  }
}

}  // namespace

GLenum internalFormat(Format format) {
  return kInternalFormats.at(static_cast<std::size_t>(format));
}

Transfer uploadTransfer(Format format, int channels, ComponentType type) {
  const FormatInfo& target = info(format);
  CHECK(target.kind != FormatClass::Depth || (channels == 1 && type == ComponentType::F32),
        "{} takes one F32 channel", target.name);
  CHECK(!isInteger(target.kind) || type == componentOf(target),
        "{} takes integers of its own width ({} bytes)", target.name,
        bytesPer(componentOf(target)));
  if (format == Format::Rgb9E5 && channels == 1 && type == ComponentType::F32)
    return {GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV};
  return {layoutOf(target, channels), componentType(type, target.kind)};
}

Readback readback(Format format) {
  const FormatInfo& source = info(format);
  const ComponentType type = componentOf(source);
  return {
      {layoutOf(source, source.channels), componentType(type, source.kind)}, source.channels, type};
}

}  // namespace lucerna::gpu
