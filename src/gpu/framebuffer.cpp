// Framebuffers, cached by what is attached to them.
#include <algorithm>

#include "gpu/device_impl.hpp"

namespace lucerna::gpu {
namespace {

struct Extent {
  int width = 0, height = 0, samples = 0;
  bool operator==(const Extent&) const = default;
};

Extent extentOf(const Texture& texture, int level) {
  const TextureDesc& desc = texture.desc();
  return {std::max(desc.width >> level, 1), std::max(desc.height >> level, 1), desc.samples};
}

template <typename Target>
void checkTarget(const Target& target, const Extent& extent, bool depth) {
  CHECK(target.texture && *target.texture, "a render target is an empty texture");
  const Texture& texture = *target.texture;
  const FormatInfo& format = info(texture.format());
  CHECK(format.renderable && (format.kind == FormatClass::Depth) == depth,
        "texture '{}' of format {} as a {} target", texture.label(), format.name,
        depth ? "depth" : "colour");
  CHECK(target.layer < texture.desc().layers && target.level < texture.desc().levels,
        "layer {} level {} of texture '{}'", target.layer, target.level, texture.label());
  CHECK(extentOf(texture, target.level) == extent,
        "render target '{}' differs from the first one in size or samples", texture.label());
}

template <typename Target>
FramebufferKey::Attachment keyOf(const Target& target) {
  if (!target.texture) return {};
  const bool single =
      target.texture->desc().layers == 1 && target.texture->desc().kind != TextureKind::Array2D;
  return {target.texture->id(), single ? -1 : target.layer, target.level};
}

void attach(GLuint framebuffer, GLenum point, const FramebufferKey::Attachment& attachment) {
  if (attachment.layer < 0)
    glNamedFramebufferTexture(framebuffer, point, attachment.texture, attachment.level);
  else
    glNamedFramebufferTextureLayer(framebuffer, point, attachment.texture, attachment.level,
                                   attachment.layer);
}

std::string labels(const Targets& targets) {
  std::string text;
  for (const ColorTarget& color : targets.colors) text += "'" + color.texture->label() + "' ";
  if (targets.depth.texture) text += "'" + targets.depth.texture->label() + "'";
  return text;
}

void checkTargets(const Targets& targets, int maxColorTargets) {
  CHECK(!targets.colors.empty() || targets.depth.texture, "a rendering without any target");
  CHECK(targets.colors.size() <= static_cast<std::size_t>(maxColorTargets), "{} colour targets",
        targets.colors.size());
  if (!targets.colors.empty())
    CHECK(targets.colors[0].texture != nullptr, "the first colour target is null");
  const Extent extent = targets.colors.empty()
                            ? extentOf(*targets.depth.texture, targets.depth.level)
                            : extentOf(*targets.colors[0].texture, targets.colors[0].level);
  for (const ColorTarget& color : targets.colors) checkTarget(color, extent, false);
  if (targets.depth.texture) checkTarget(targets.depth, extent, true);
}

}  // namespace

GLuint Device::Impl::framebuffer(const Targets& targets) {
  checkTargets(targets, capabilities.maxColorTargets);
  FramebufferKey key;
  for (const ColorTarget& color : targets.colors) key.colors.push_back(keyOf(color));
  key.depth = keyOf(targets.depth);
  GLuint& id = framebuffers[key];
  if (id != 0) return id;

  glCreateFramebuffers(1, &id);
  std::vector<GLenum> drawBuffers;
  for (const FramebufferKey::Attachment& color : key.colors) {
    drawBuffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawBuffers.size()));
    attach(id, drawBuffers.back(), color);
  }
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(drawBuffers.size()), drawBuffers.data());
  if (key.depth.texture != 0) {
    const bool stencil = targets.depth.texture->format() == Format::Depth32FStencil8;
    attach(id, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, key.depth);
  }
  const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
  CHECK(status == GL_FRAMEBUFFER_COMPLETE, "the driver refuses the targets {} (status 0x{:x})",
        labels(targets), status);
  setLabel(GL_FRAMEBUFFER, id, labels(targets));
  ++objects.framebuffers;
  return id;
}

std::vector<vec2> Device::samplePositions(const Texture& texture) {
  CHECK(texture.desc().kind == TextureKind::Multisample2D, "texture '{}' is not multisampled",
        texture.label());
  CHECK(!impl_->scope.open, "samplePositions() while a Rendering is open");
  Targets targets;
  if (info(texture.format()).kind == FormatClass::Depth)
    targets.depth.texture = &texture;
  else
    targets.colors.push_back({&texture});
  impl_->boundFramebuffer = impl_->framebuffer(targets);
  glBindFramebuffer(GL_FRAMEBUFFER, impl_->boundFramebuffer);
  std::vector<vec2> positions(static_cast<std::size_t>(texture.desc().samples));
  for (std::size_t i = 0; i < positions.size(); ++i)
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), &positions[i].x);
  return positions;
}

}  // namespace lucerna::gpu
