#include "gpu/context.hpp"

#include <epoxy/egl.h>

#include <array>
#include <utility>
#include <vector>

#include "core/text.hpp"

namespace lucerna::gpu {
namespace {

// A display to try, by the name that messages give it.
struct Candidate {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
};

const char* eglErrorName(EGLint code) {
  switch (code) {
    case EGL_SUCCESS:
      return "EGL_SUCCESS";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    case EGL_BAD_SURFACE:
      return "EGL_BAD_SURFACE";
    default:
      return "an unknown EGL error";
  }
}

std::string failed(const char* call) {
  return fmt::format("{} failed ({})", call, eglErrorName(eglGetError()));
}

bool hasExtension(EGLDisplay display, const char* name) {
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  return extensions && epoxy_extension_in_string(extensions, name);
}

// Surfaceless Mesa first, then every EGL device.
std::vector<Candidate> candidates(std::vector<std::string>& attempts) {
  std::vector<Candidate> found;
  const bool platforms = hasExtension(EGL_NO_DISPLAY, "EGL_EXT_platform_base");
  if (platforms && hasExtension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    found.push_back({"EGL surfaceless", eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                                 EGL_DEFAULT_DISPLAY, nullptr)});
  else
    attempts.emplace_back("EGL surfaceless: EGL_MESA_platform_surfaceless is not offered");
  if (!platforms || !hasExtension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
      !hasExtension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    attempts.emplace_back("EGL devices: EGL_EXT_platform_device is not offered");
    return found;
  }
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(devices.size(), devices.data(), &count))
    attempts.push_back("EGL devices: " + failed("eglQueryDevicesEXT"));
  for (EGLint i = 0; i < count; ++i)
    found.push_back({fmt::format("EGL device {}", i),
                     eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT,
                                              devices[static_cast<std::size_t>(i)], nullptr)});
  return found;
}

// A surfaceless 4.5 core debug context, made current; or why not.
Result<EGLContext> makeContext(EGLDisplay display) {
  const auto why = [](std::string text) { return Error{ErrorKind::NoGl, std::move(text)}; };
  if (display == EGL_NO_DISPLAY) return why(failed("eglGetPlatformDisplay"));
  if (!eglInitialize(display, nullptr, nullptr)) return why(failed("eglInitialize"));
  if (!hasExtension(display, "EGL_KHR_surfaceless_context"))
    return why("EGL_KHR_surfaceless_context is not offered");
  if (!eglBindAPI(EGL_OPENGL_API)) return why(failed("eglBindAPI(EGL_OPENGL_API)"));
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!hasExtension(display, "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
      return why(failed("eglChooseConfig"));
  }
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_OPENGL_DEBUG,
                               EGL_TRUE,
                               EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return why(failed("eglCreateContext (OpenGL 4.5 core)"));
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    Error error = why(failed("eglMakeCurrent"));
    eglDestroyContext(display, context);
    return error;
  }
  return context;
}

}  // namespace

Result<std::unique_ptr<Context>> Context::create(ContextKind) {
  std::vector<std::string> attempts;
  if (!epoxy_has_egl())
    return error(ErrorKind::NoGl,
                 "no OpenGL: libEGL.so.1 is missing; install the packages libegl1 and "
                 "libgl1-mesa-dri, or the driver of your GPU");
  for (const Candidate& candidate : candidates(attempts)) {
    Result<EGLContext> context = makeContext(candidate.display);
    if (!context) {
      attempts.push_back(candidate.name + ": " + context.error().message);
      continue;
    }
    std::unique_ptr<Context> result(new Context);
    result->display_ = candidate.display;
    result->context_ = *context;
    result->platform_ = candidate.name;
    return result;
  }
  return error(ErrorKind::NoGl,
               "no OpenGL 4.5 core context; tried\n  {}\nInstall libegl1 and libgl1-mesa-dri (the "
               "software rasteriser), or the driver of your GPU.",
               join(attempts, "\n  "));
}

// The display stays initialised: it is one per process, and eglTerminate would pull it from under
// other contexts of the same display.
Context::~Context() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace lucerna::gpu
