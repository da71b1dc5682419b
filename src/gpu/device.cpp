#include "gpu/device.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/log.hpp"
#include "core/text.hpp"
#include "gpu/context.hpp"
#include "gpu/device_impl.hpp"
#include "gpu/gl_format.hpp"
#include "gpu/workarounds.hpp"

namespace lucerna::gpu {
namespace {

constexpr std::size_t kMaxDebugMessages = 100;  // a fault in every draw would fill the memory

std::string glText(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text ? text : "unknown";
}

GLint glInteger(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

bool isSoftware(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "SwiftShader"})
    if (renderer.find(name) != std::string::npos) return true;
  return false;
}

// Shader compilers report through Device::program(); everything else of weight is collected.
void GLAPIENTRY onDebugMessage(GLenum source, GLenum, GLuint, GLenum severity, GLsizei length,
                               const GLchar* message, const void* user) {
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER || source == GL_DEBUG_SOURCE_APPLICATION) return;
  if (severity != GL_DEBUG_SEVERITY_HIGH && severity != GL_DEBUG_SEVERITY_MEDIUM) return;
  auto& impl = *static_cast<Device::Impl*>(const_cast<void*>(user));
  if (impl.debugMessages.size() >= kMaxDebugMessages) return;
  std::string text(message, length < 0 ? std::char_traits<char>::length(message)
                                       : static_cast<std::size_t>(length));
  while (text.ends_with('\n')) text.pop_back();
  if (!impl.groups.empty()) text = join(impl.groups, " / ") + ": " + text;
  log::debug("OpenGL: {}", text);
  impl.debugMessages.push_back(std::move(text));
}

// Whether a target of this format makes a complete framebuffer: drivers answer glGetInternalformat
// wrongly for some.
bool isRenderable(const FormatInfo& format) {
  GLuint texture = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, internalFormat(format.format), 4, 4);
  glCreateFramebuffers(1, &framebuffer);
  const GLenum point = format.format == Format::Depth32FStencil8 ? GL_DEPTH_STENCIL_ATTACHMENT
                       : format.kind == FormatClass::Depth       ? GL_DEPTH_ATTACHMENT
                                                                 : GL_COLOR_ATTACHMENT0;
  glNamedFramebufferTexture(framebuffer, point, texture, 0);
  const bool complete =
      glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &texture);
  return complete;
}

Capabilities readCapabilities() {
  Capabilities result = Capabilities::baseline();
  result.name = glText(GL_RENDERER);
  if (epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array"))
    result.features.emplace(kFeatureLayeredVertex);
  result.renderable.clear();
  for (const FormatInfo& format : allFormats())
    if (format.renderable && isRenderable(format)) result.renderable.insert(format.format);
  result.maxTextureSide = glInteger(GL_MAX_TEXTURE_SIZE);
  result.maxTextureLayers = glInteger(GL_MAX_ARRAY_TEXTURE_LAYERS);
  result.maxColorTargets = std::min(glInteger(GL_MAX_DRAW_BUFFERS), 8);
  result.maxSamples = std::min(
      {glInteger(GL_MAX_COLOR_TEXTURE_SAMPLES), glInteger(GL_MAX_DEPTH_TEXTURE_SAMPLES), 4});
  result.softwareRasterizer = isSoftware(result.name);
  return result;
}

// What never changes again; the rest is RenderState, whose defaults are made to agree with GL here.
void setFixedState() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  glDisable(GL_DITHER);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glEnable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_ALWAYS);
}

}  // namespace

Device::Device() : impl_(std::make_unique<Impl>()) {}

Result<std::unique_ptr<Device>> Device::create(Context& context,
                                               std::shared_ptr<ShaderSources> sources) {
  const int version = epoxy_gl_version();
  if (version < 45)
    return error(ErrorKind::NoGl,
                 "{}: OpenGL {}.{} ({}), but 4.5 is needed; install a newer driver, or "
                 "libgl1-mesa-dri for the software rasteriser",
                 context.platform(), version / 10, version % 10, glText(GL_RENDERER));
  std::unique_ptr<Device> device(new Device);
  Impl& impl = *device->impl_;
  impl.capabilities = readCapabilities();
  const char* disabled = std::getenv("LUCERNA_NO_WORKAROUNDS");
  impl.workarounds = workaroundsFor(impl.capabilities, disabled ? disabled : "");
  impl.anisotropy =
      !impl.uses(kNoAnisotropy) && (epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic") ||
                                    epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"));
  impl.description = fmt::format("{} | {} | {}; workarounds: {}", glText(GL_VENDOR),
                                 glText(GL_RENDERER), glText(GL_VERSION), join(impl.workarounds));
  // Only now: probing formats may have raised messages that mean nothing.
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(onDebugMessage, &impl);
  if (impl.uses(kNoPerformanceMessages))
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_PERFORMANCE, GL_DONT_CARE, 0, nullptr,
                          GL_FALSE);
  setFixedState();
  glCreateVertexArrays(1, &impl.emptyInput);
  impl.sources = sources ? std::move(sources) : std::make_shared<ShaderSources>();
  impl.sources->add(embeddedShaders_gpu());
  if (const char* root = std::getenv("LUCERNA_SHADERS")) impl.sources->setRoot(root);
  return device;
}

Device::~Device() {
  Impl& impl = *impl_;
  CHECK(impl.objects.textures == 0 && impl.objects.buffers == 0 && impl.objects.vertexInputs == 0,
        "{} textures, {} buffers and {} vertex inputs outlive their device", impl.objects.textures,
        impl.objects.buffers, impl.objects.vertexInputs);
  for (const Timer& timer : impl.timers) {
    glDeleteQueries(1, &timer.begin);
    glDeleteQueries(1, &timer.end);
  }
  for (const auto& [desc, program] : impl.programs) {
    glDeleteProgram(program->id_);
    program->id_ = 0;  // who still holds it has an unusable program
  }
  for (const auto& [key, framebuffer] : impl.framebuffers) glDeleteFramebuffers(1, &framebuffer);
  for (const auto& [value, sampler] : impl.samplers) glDeleteSamplers(1, &sampler);
  glDeleteVertexArrays(1, &impl.emptyInput);
  glDebugMessageCallback(nullptr, nullptr);
}

const Capabilities& Device::capabilities() const {
  return impl_->capabilities;
}
std::string Device::description() const {
  return impl_->description;
}
ShaderSources& Device::shaderSources() {
  return *impl_->sources;
}
const Counters& Device::counters() const {
  return impl_->counters;
}
void Device::resetCounters() {
  impl_->counters = {};
}
ObjectCounts Device::objectCounts() const {
  return impl_->objects;
}
void Device::barrier() {
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}
void Device::finish() {
  glFinish();
}

std::vector<Error> Device::takeErrors() {
  return std::exchange(impl_->errors, {});
}
void Device::reportError(Error error) {
  // Once in each batch is enough.
  if (std::ranges::find(impl_->errors, error.message, &Error::message) == impl_->errors.end())
    impl_->errors.push_back(std::move(error));
}
std::vector<std::string> Device::takeDebugMessages() {
  return std::exchange(impl_->debugMessages, {});
}

void Device::pushGroup(std::string_view name) {
  impl_->groups.emplace_back(name.substr(0, 200));
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0,
                   static_cast<GLsizei>(impl_->groups.back().size()), impl_->groups.back().data());
}

void Device::popGroup() {
  CHECK(!impl_->groups.empty(), "popGroup() without pushGroup()");
  impl_->groups.pop_back();
  glPopDebugGroup();
}

bool Device::Impl::uses(std::string_view workaround) const {
  return std::ranges::find(workarounds, workaround) != workarounds.end();
}

// An empty label would erase what tools show.
void Device::Impl::setLabel(GLenum kind, GLuint id, std::string_view label) const {
  const std::string_view shown = label.substr(0, 200);
  if (!shown.empty()) glObjectLabel(kind, id, static_cast<GLsizei>(shown.size()), shown.data());
}

}  // namespace lucerna::gpu
