// --profile: what every pass of every frame cost, as CSV or JSON, and a table of means.
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "graph/executor.hpp"

namespace lucerna::app {

class ProfileLog {
 public:
  // gpuClock: how gpu_ms was measured, "gpu-timer" or "cpu-after-finish".
  explicit ProfileLog(std::string gpuClock) : gpuClock_(std::move(gpuClock)) {}

  void add(const graph::FrameProfile& frame) { frames_.push_back(frame); }
  bool empty() const { return frames_.empty(); }
  const std::string& gpuClock() const { return gpuClock_; }

  // One line a pass, view and frame, then one for the whole frame, whose pass is "(frame)" and
  // whose view is empty:
  // frame,pass,view,cpu_ms,gpu_ms,draws,primitives,texture_bytes,gpu_clock
  std::string csv() const;
  std::string json() const;
  // Means per pass over the frames; without the first if there are several, which compiles shaders.
  std::string table() const;
  // By the extension. Errors: ErrorKind::Usage for another extension.
  Status write(const std::string& path) const;
  static Status checkPath(const std::string& path);

 private:
  std::string gpuClock_;
  std::vector<graph::FrameProfile> frames_;
};

}  // namespace lucerna::app
