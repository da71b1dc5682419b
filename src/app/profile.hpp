// --profile: what every pass of every frame cost, as CSV, JSON, Markdown or HTML.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/view_plan.hpp"
#include "core/math/math.hpp"
#include "core/result.hpp"
#include "graph/executor.hpp"

namespace lucerna::app {

// What was measured, and how.
struct ProfileSubject {
  std::string scene{}, pipeline{}, renderer{};
  uvec2 size{0};           // px of the output, with two eyes of each
  ViewPlan plan{};         // what was drawn for it
  std::string gpuClock{};  // how gpu_ms was measured: "gpu-timer" or "cpu-after-finish"

  // "1280 x 720 pixels, rendered at 2560 x 1440"
  std::string sizeText() const;
};

class ProfileLog {
 public:
  explicit ProfileLog(ProfileSubject subject = {}) : subject_(std::move(subject)) {}

  // How the frames were drawn is known when one is.
  void setSubject(ProfileSubject subject) { subject_ = std::move(subject); }

  void add(const graph::FrameProfile& frame) { frames_.push_back(frame); }
  bool empty() const { return frames_.empty(); }
  const ProfileSubject& subject() const { return subject_; }
  std::span<const graph::FrameProfile> frames() const { return frames_; }

  // One line a pass, view and frame, then one for the whole frame, whose pass is "(frame)" and
  // whose view is empty:
  // frame,pass,view,cpu_ms,gpu_ms,draws,primitives,texture_bytes,gpu_clock
  std::string csv() const;
  std::string json() const;
  // Means per pass (profile_summary.hpp), for a terminal.
  std::string table() const;
  // By the extension. Errors: ErrorKind::Usage for another extension.
  Status write(const std::string& path) const;
  static Status checkPath(const std::string& path);

 private:
  ProfileSubject subject_;
  std::vector<graph::FrameProfile> frames_;
};

}  // namespace lucerna::app
