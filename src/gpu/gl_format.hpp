// How Format looks to OpenGL.
#pragma once

#include "gpu/format.hpp"
#include "gpu/gl.hpp"
#include "image/image.hpp"

namespace lucerna::gpu {

// Sized internal format.
GLenum internalFormat(Format format);

// A pixel transfer: what glTextureSubImage and glGetTextureSubImage are told.
struct Transfer {
  GLenum layout = GL_RGBA;  // GL_RED, GL_RGBA_INTEGER, GL_DEPTH_COMPONENT, ...
  GLenum type = GL_UNSIGNED_BYTE;
};
// For an image whose pixels go up into a texture of this format.
Transfer uploadTransfer(Format format, int channels, ComponentType type);

// For reading a texture back without loss, and the image that receives it.
struct Readback {
  Transfer transfer;
  int channels = 4;
  ComponentType type = ComponentType::U8;
};
Readback readback(Format format);

}  // namespace lucerna::gpu
