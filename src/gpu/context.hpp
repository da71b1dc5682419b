// A headless OpenGL 4.5 core context: EGL surfaceless first, then EGL devices; never a hidden
// window.
#pragma once

#include <memory>
#include <string>

#include "core/result.hpp"

namespace lucerna::gpu {

enum class ContextKind { Auto, Egl };

class Context {
 public:
  // Makes a context and makes it current on this thread. Errors (ErrorKind::NoGl) say what was
  // tried.
  static Result<std::unique_ptr<Context>> create(ContextKind kind = ContextKind::Auto);
  ~Context();
  const std::string& platform() const {
    return platform_;
  }  // "EGL surfaceless", "EGL device 0", ...

 private:
  Context() = default;
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string platform_;
};

}  // namespace lucerna::gpu
