// What passes cost over many frames: means and medians.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "graph/executor.hpp"

namespace lucerna::app {

struct Milliseconds {
  double mean = 0, median = 0;
};

struct PassCost {
  std::string row;
  int view = 0;
  Milliseconds cpu, gpu;
  double draws = 0, primitives = 0;  // means
  std::uint64_t textureBytes = 0;    // of the last frame that ran it
};

// A frame that did not run a pass counts as 0.
struct ProfileSummary {
  std::vector<PassCost> passes;  // in the order of their first run
  PassCost frame;                // of whole frames; no row
  std::size_t frames = 0;        // that are summed up
  bool firstLeftOut = false;
};

// The frames that a summary looks at: without the first if there are several, which compiles
// shaders.
std::span<const graph::FrameProfile> warmFrames(std::span<const graph::FrameProfile> frames);
ProfileSummary summarised(std::span<const graph::FrameProfile> frames);

}  // namespace lucerna::app
