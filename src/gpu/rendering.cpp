#include <algorithm>
#include <cmath>
#include <utility>

#include "gpu/device_impl.hpp"
#include "gpu/gl_format.hpp"
#include "gpu/workarounds.hpp"

namespace lucerna::gpu {
namespace {

GLenum glTopology(Topology topology) {
  switch (topology) {
    case Topology::Triangles:
      return GL_TRIANGLES;
    case Topology::TriangleStrip:
      return GL_TRIANGLE_STRIP;
    case Topology::Lines:
      return GL_LINES;
    case Topology::LineStrip:
      return GL_LINE_STRIP;
    case Topology::Points:
      break;
  }
  return GL_POINTS;
}

std::uint64_t primitivesOf(Topology topology, std::uint64_t vertices) {
  switch (topology) {
    case Topology::Triangles:
      return vertices / 3;
    case Topology::TriangleStrip:
      return vertices < 3 ? 0 : vertices - 2;
    case Topology::Lines:
      return vertices / 2;
    case Topology::LineStrip:
      return vertices < 2 ? 0 : vertices - 1;
    case Topology::Points:
      break;
  }
  return vertices;
}

// One layer of several.
template <typename Target>
bool isOneLayerOfMany(const Target& target) {
  return target.layer >= 0 && target.texture->desc().layers > 1;
}

// Another level or layer of the same texture may be read meanwhile.
template <typename Target>
bool isWhole(const Target& target) {
  return target.texture->desc().levels == 1 && !isOneLayerOfMany(target);
}

// The workaround keep-discarded-layers: invalidating one layer may lose the others.
template <typename Target>
bool mayInvalidate(const Device::Impl& impl, const Target& target) {
  return target.load == Load::Discard &&
         !(isOneLayerOfMany(target) && impl.uses(kKeepDiscardedLayers));
}

void loadColor(const Device::Impl& impl, GLint index, const ColorTarget& target) {
  const GLuint framebuffer = impl.boundFramebuffer;
  if (mayInvalidate(impl, target)) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index);
    glInvalidateNamedFramebufferData(framebuffer, 1, &attachment);
  }
  if (target.load != Load::Clear) return;
  const vec4 value = target.clear;
  switch (info(target.texture->format()).kind) {
    case FormatClass::Uint: {
      const uvec4 rounded(glm::round(glm::max(value, vec4(0.f))));
      glClearNamedFramebufferuiv(framebuffer, GL_COLOR, index, &rounded.x);
      break;
    }
    case FormatClass::Int: {
      const glm::ivec4 rounded(glm::round(value));
      glClearNamedFramebufferiv(framebuffer, GL_COLOR, index, &rounded.x);
      break;
    }
    default:
      glClearNamedFramebufferfv(framebuffer, GL_COLOR, index, &value.x);
  }
}

void loadDepth(const Device::Impl& impl, const DepthTarget& target) {
  const GLuint framebuffer = impl.boundFramebuffer;
  const bool stencil = target.texture->format() == Format::Depth32FStencil8;
  if (mayInvalidate(impl, target)) {
    const GLenum attachment = stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    glInvalidateNamedFramebufferData(framebuffer, 1, &attachment);
  }
  if (target.load != Load::Clear) return;
  if (stencil)
    glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, target.clear, target.clearStencil);
  else
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &target.clear);
}

// Clears obey the write masks, so those must be open.
RenderState withOpenMasks(RenderState state) {
  state.colorMask = 0xf;
  state.depthWrite = true;
  state.stencil.writeMask = 0xff;
  return state;
}

template <typename Binding>
Binding& named(std::vector<Binding>& bindings, std::string_view name) {
  for (Binding& binding : bindings)
    if (binding.name == name) return binding;
  bindings.emplace_back().name = name;
  return bindings.back();
}

}  // namespace

void Device::Impl::openScope() {
  CHECK(!scope.open, "a Rendering or Computing is still open: one at a time");
  scope.open = true;
}

void Device::Impl::closeScope() {
  scope = {};
  // Drivers look at what a program reads also while targets are cleared, when its textures may be
  // gone.
  if (boundProgram != 0) glUseProgram(0);
  boundProgram = 0;
}

void Commands::use(const Program& program, const RenderState& state) {
  Device::Impl& impl = device_->impl();
  Scope& scope = impl.scope;
  if (scope.program != &program || impl.state.depthWrite != state.depthWrite) scope.dirty = true;
  impl.apply(state);
  scope.program = &program;
  scope.topology = state.topology;
}

void Commands::texture(std::string_view name, const Texture& texture, const Sampler& sampler) {
  CHECK(texture, "sampler '{}' is given an empty texture", name);
  const FormatClass kind = info(texture.format()).kind;
  CHECK((kind != FormatClass::Uint && kind != FormatClass::Int) ||
            sampler.filter == Filter::Nearest || texture.desc().kind == TextureKind::Multisample2D,
        "sampler '{}': integer texture '{}' cannot be filtered; use kNearest", name,
        texture.label());
  Scope& scope = device_->impl().scope;
  Scope::BoundTexture& slot = named(scope.textures, name);
  const GLuint object = device_->impl().sampler(sampler);
  if (slot.texture == texture.id() && slot.sampler == object) return;
  slot.texture = texture.id();
  slot.sampler = object;
  scope.dirty = true;
}

void Commands::buffer(std::string_view block, const Buffer& buffer) {
  this->buffer(block, buffer, 0, buffer.bytes());
}

void Commands::buffer(std::string_view block, const Buffer& buffer, std::size_t offset,
                      std::size_t bytes) {
  CHECK(buffer, "block '{}' is given an empty buffer", block);
  CHECK(offset % kBlockAlignment == 0 && offset + bytes <= buffer.bytes(),
        "block '{}': bytes {} to {} of a buffer of {}", block, offset, offset + bytes,
        buffer.bytes());
  Scope& scope = device_->impl().scope;
  Scope::BoundBuffer& slot = named(scope.buffers, block);
  if (slot.buffer == buffer.id() && slot.offset == offset && slot.bytes == bytes) return;
  slot.buffer = buffer.id();
  slot.offset = offset;
  slot.bytes = bytes;
  scope.dirty = true;
}

void Commands::image(std::string_view name, const Texture& texture, int level) {
  CHECK(texture && level < texture.desc().levels, "image '{}': level {} of texture '{}'", name,
        level, texture.label());
  const FormatInfo& format = info(texture.format());
  CHECK(format.kind != FormatClass::Depth && format.format != Format::Srgb8Alpha8 &&
            format.format != Format::Rgb9E5,
        "image '{}': format {} has no loads and stores", name, format.name);
  Scope& scope = device_->impl().scope;
  Scope::BoundImage& slot = named(scope.images, name);
  slot.texture = texture.id();
  slot.format = internalFormat(texture.format());
  slot.level = level;
  scope.dirty = true;
}

bool Commands::prepare() {
  Device::Impl& impl = device_->impl();
  CHECK(impl.scope.program, "a draw or dispatch before use()");
  if (!impl.scope.program->usable()) return false;
  if (impl.boundProgram != impl.programId()) {
    impl.boundProgram = impl.programId();
    glUseProgram(impl.boundProgram);
  }
  if (impl.scope.dirty) impl.bindForProgram();
  return true;
}

Rendering Device::render(const Targets& targets) {
  return Rendering(*this, targets);
}

Rendering::Rendering(Device& device, const Targets& targets) : Commands(device) {
  Device::Impl& impl = device.impl();
  impl.openScope();
  const GLuint framebuffer = impl.framebuffer(targets);
  if (framebuffer != impl.boundFramebuffer) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    impl.boundFramebuffer = framebuffer;
    ++impl.counters.targetSwitches;
  }
  impl.apply(withOpenMasks(impl.state));
  for (std::size_t i = 0; i < targets.colors.size(); ++i) {
    loadColor(impl, static_cast<GLint>(i), targets.colors[i]);
    if (isWhole(targets.colors[i]))
      impl.scope.colorTargets.push_back(targets.colors[i].texture->id());
  }
  if (targets.depth.texture) {
    loadDepth(impl, targets.depth);
    if (isWhole(targets.depth)) impl.scope.depthTarget = targets.depth.texture->id();
  }

  const bool color = !targets.colors.empty();
  const Texture& first = color ? *targets.colors[0].texture : *targets.depth.texture;
  const int level = color ? targets.colors[0].level : targets.depth.level;
  const Rect& view = targets.viewport;
  if (view.width > 0)
    glViewport(view.x, view.y, view.width, view.height);
  else
    glViewport(0, 0, std::max(first.width() >> level, 1), std::max(first.height() >> level, 1));
}

Rendering::~Rendering() {
  if (!device_) return;
  glDisable(GL_SCISSOR_TEST);
  device_->impl().closeScope();
}

void Rendering::setScissor(Rect rect) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(rect.x, rect.y, rect.width, rect.height);
}

void Rendering::draw(const VertexInput& input, std::uint32_t first, std::uint32_t count,
                     std::uint32_t instances, std::int32_t baseVertex, std::uint32_t baseInstance) {
  if (!prepare()) return;
  Device::Impl& impl = device_->impl();
  const Topology topology = impl.scope.topology;
  glBindVertexArray(input.id());
  if (input.indexed())
    glDrawElementsInstancedBaseVertexBaseInstance(
        glTopology(topology), static_cast<GLsizei>(count), GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(first * sizeof(std::uint32_t)),
        static_cast<GLsizei>(instances), baseVertex, baseInstance);
  else
    glDrawArraysInstancedBaseInstance(glTopology(topology), static_cast<GLint>(first) + baseVertex,
                                      static_cast<GLsizei>(count), static_cast<GLsizei>(instances),
                                      baseInstance);
  ++impl.counters.draws;
  impl.counters.primitives += primitivesOf(topology, count) * instances;
}

void Rendering::multiDraw(const VertexInput& input, const Buffer& commands, std::uint32_t first,
                          std::uint32_t count, std::uint64_t primitives) {
  if (count == 0 || !prepare()) return;
  CHECK(input.indexed(), "multiDraw needs an indexed input");
  CHECK((std::uint64_t{first} + count) * sizeof(IndexedDrawCommand) <= commands.bytes(),
        "commands {} to {} of a buffer of {} bytes", first, std::uint64_t{first} + count,
        commands.bytes());
  Device::Impl& impl = device_->impl();
  glBindVertexArray(input.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
  glMultiDrawElementsIndirect(glTopology(impl.scope.topology), GL_UNSIGNED_INT,
                              reinterpret_cast<const void*>(first * sizeof(IndexedDrawCommand)),
                              static_cast<GLsizei>(count), sizeof(IndexedDrawCommand));
  impl.counters.draws += count;
  impl.counters.primitives += primitives;
}

void Rendering::fullscreen() {
  if (!prepare()) return;
  Device::Impl& impl = device_->impl();
  CHECK(impl.scope.topology == Topology::Triangles, "fullscreen() draws a triangle");
  glBindVertexArray(impl.emptyInput);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++impl.counters.draws;
  ++impl.counters.primitives;
}

Computing Device::compute() {
  return Computing(*this);
}

Computing::Computing(Device& device) : Commands(device) {
  device.impl().openScope();
}

Computing::~Computing() {
  if (device_) device_->impl().closeScope();
}

void Computing::use(const Program& program) {
  Commands::use(program, device_->impl().state);
}

void Computing::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  if (x == 0 || y == 0 || z == 0 || !prepare()) return;
  glDispatchCompute(x, y, z);
  ++device_->impl().counters.dispatches;
}

}  // namespace lucerna::gpu
