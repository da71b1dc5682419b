// RenderState and bindings made real, with as few calls as the difference needs.
#include "gpu/state.hpp"

#include <algorithm>
#include <array>

#include "gpu/device_impl.hpp"

namespace lucerna::gpu {
namespace {

constexpr std::array<GLenum, 8> kCompare = {GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
                                            GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
constexpr std::array<GLenum, 6> kStencilOps = {GL_KEEP,      GL_ZERO,      GL_REPLACE,
                                               GL_INCR_WRAP, GL_DECR_WRAP, GL_INVERT};

GLenum gl(Compare compare) {
  return kCompare[static_cast<std::size_t>(compare)];
}
GLenum gl(StencilOp op) {
  return kStencilOps[static_cast<std::size_t>(op)];
}

void enable(GLenum what, bool on) {
  on ? glEnable(what) : glDisable(what);
}

// GL writes depth only while it tests it.
bool depthEnabled(const RenderState& s) {
  return s.depthTest || s.depthWrite;
}
Compare depthCompare(const RenderState& s) {
  return s.depthTest ? s.depthCompare : Compare::Always;
}

// Alpha is accumulated as coverage, so that what was blended can itself be composed.
void setBlend(Blend blend) {
  enable(GL_BLEND, blend != Blend::Off);
  glBlendEquation(blend == Blend::Min ? GL_MIN : blend == Blend::Max ? GL_MAX : GL_FUNC_ADD);
  switch (blend) {
    case Blend::Off:
      // Mesa 22.3 counts a factor of dual-source blending against the number of targets also while
      // blending is off, and refuses to draw.
      glBlendFunc(GL_ONE, GL_ZERO);
      break;
    case Blend::Alpha:
      glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      break;
    case Blend::Premultiplied:
      glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      break;
    case Blend::Transmit:
      glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ONE, GL_SRC1_ALPHA);
      break;
    case Blend::Multiply:
      glBlendFunc(GL_DST_COLOR, GL_ZERO);
      break;
    case Blend::Add:
    case Blend::Min:
    case Blend::Max:
      glBlendFunc(GL_ONE, GL_ONE);
      break;
  }
}

void setStencil(const Stencil& s) {
  enable(GL_STENCIL_TEST, s.test);
  glStencilFunc(gl(s.compare), s.reference, s.readMask);
  glStencilMask(s.writeMask);
  glStencilOp(gl(s.fail), gl(s.depthFail), gl(s.pass));
}

void setDepthBias(float bias, float slopeBias) {
  const bool on = bias != 0.f || slopeBias != 0.f;
  enable(GL_POLYGON_OFFSET_FILL, on);
  enable(GL_POLYGON_OFFSET_LINE, on);
  glPolygonOffset(slopeBias, bias);
}

void setClipDistances(int before, int after) {
  for (int i = 0; i < std::max(before, after); ++i)
    enable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i), i < after);
}

}  // namespace

void Device::Impl::apply(const RenderState& wanted) {
  const RenderState& now = state;
  if (depthEnabled(wanted) != depthEnabled(now)) enable(GL_DEPTH_TEST, depthEnabled(wanted));
  if (depthCompare(wanted) != depthCompare(now)) glDepthFunc(gl(depthCompare(wanted)));
  if (wanted.depthWrite != now.depthWrite) glDepthMask(wanted.depthWrite);
  if (wanted.blend != now.blend) setBlend(wanted.blend);
  if (wanted.cull != now.cull) {
    enable(GL_CULL_FACE, wanted.cull != Cull::None);
    glCullFace(wanted.cull == Cull::Front ? GL_FRONT : GL_BACK);
  }
  if (wanted.frontIsClockwise != now.frontIsClockwise)
    glFrontFace(wanted.frontIsClockwise ? GL_CW : GL_CCW);
  if (wanted.wireframe != now.wireframe)
    glPolygonMode(GL_FRONT_AND_BACK, wanted.wireframe ? GL_LINE : GL_FILL);
  if (wanted.colorMask != now.colorMask)
    glColorMask((wanted.colorMask & 1) != 0, (wanted.colorMask & 2) != 0,
                (wanted.colorMask & 4) != 0, (wanted.colorMask & 8) != 0);
  if (wanted.clipDistances != now.clipDistances)
    setClipDistances(now.clipDistances, wanted.clipDistances);
  if (wanted.depthBias != now.depthBias || wanted.depthSlopeBias != now.depthSlopeBias)
    setDepthBias(wanted.depthBias, wanted.depthSlopeBias);
  if (!(wanted.stencil == now.stencil)) setStencil(wanted.stencil);
  state = wanted;
}

namespace {

template <typename Binding>
const Binding& bound(const std::vector<Binding>& bindings, const std::string& name,
                     const char* kind, const ProgramDesc& program) {
  for (const Binding& binding : bindings)
    if (binding.name == name) return binding;
  CHECK(false, "{} '{}' of {}{} was not bound in this scope", kind, name, program.fragment,
        program.compute);
}

}  // namespace

void Device::Impl::bindForProgram() {
  const Program& program = *scope.program;
  const Program::Reflection& needs = *program.reflection_;
  for (const auto& slot : needs.samplers) {
    const auto& source = bound(scope.textures, slot.name, "sampler", program.desc_);
    CHECK(std::ranges::find(scope.colorTargets, source.texture) == scope.colorTargets.end() &&
              (source.texture != scope.depthTarget || !state.depthWrite),
          "sampler '{}' reads a texture that is being drawn to", slot.name);
    const std::pair wanted(source.texture, source.sampler);
    if (units.size() <= slot.unit) units.resize(slot.unit + 1);
    if (units[slot.unit] == wanted) continue;
    glBindTextureUnit(slot.unit, source.texture);
    glBindSampler(slot.unit, source.sampler);
    units[slot.unit] = wanted;
  }
  for (const auto& slot : needs.images) {
    const auto& source = bound(scope.images, slot.name, "image", program.desc_);
    glBindImageTexture(slot.unit, source.texture, source.level, GL_TRUE, 0, GL_READ_WRITE,
                       source.format);
  }
  const auto bindBlocks = [&](const std::vector<Program::Reflection::Slot>& slots, GLenum target) {
    for (const auto& slot : slots) {
      const auto& source = bound(scope.buffers, slot.name, "block", program.desc_);
      // Drivers round the size of a block up to 16 bytes.
      CHECK((source.bytes + 15) / 16 * 16 >= static_cast<std::size_t>(slot.bytes),
            "block '{}' reads {} bytes, its buffer has {}", slot.name, slot.bytes, source.bytes);
      glBindBufferRange(target, slot.unit, source.buffer, static_cast<GLintptr>(source.offset),
                        static_cast<GLsizeiptr>(source.bytes));
    }
  };
  bindBlocks(needs.uniformBlocks, GL_UNIFORM_BUFFER);
  bindBlocks(needs.storageBlocks, GL_SHADER_STORAGE_BUFFER);
  scope.dirty = false;
}

}  // namespace lucerna::gpu
