#include "app/profile_summary.hpp"

#include <algorithm>
#include <numeric>

namespace lucerna::app {
namespace {

using Frames = std::span<const graph::FrameProfile>;

Milliseconds spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return {.mean = std::reduce(values.begin(), values.end()) / static_cast<double>(values.size()),
          .median = values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2};
}

// The cost of one pass, or of the whole, in every frame.
struct Series {
  explicit Series(std::size_t frames) : cpuMs(frames), gpuMs(frames) {}

  // Cost: graph::StepProfile or graph::FrameProfile.
  template <typename Cost>
  void add(std::size_t frame, const Cost& cost) {
    cpuMs[frame] += cost.cpuMs;
    gpuMs[frame] += cost.gpuMs;
    draws += static_cast<double>(cost.counters.draws);
    primitives += static_cast<double>(cost.counters.primitives);
    textureBytes = cost.textureBytes;
  }

  PassCost cost(const std::string& row, int view) const {
    const auto count = static_cast<double>(cpuMs.size());
    return {.row = row,
            .view = view,
            .cpu = spreadOf(cpuMs),
            .gpu = spreadOf(gpuMs),
            .draws = draws / count,
            .primitives = primitives / count,
            .textureBytes = textureBytes};
  }

  std::vector<double> cpuMs, gpuMs;
  double draws = 0, primitives = 0;
  std::uint64_t textureBytes = 0;
};

struct Pass {
  std::string row;
  int view = 0;
  Series series;
};

}  // namespace

Frames warmFrames(Frames frames) {
  return frames.subspan(frames.size() > 1 ? 1 : 0);
}

ProfileSummary summarised(Frames all) {
  const Frames frames = warmFrames(all);
  if (frames.empty()) return {};
  std::vector<Pass> passes;
  Series whole(frames.size());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    whole.add(f, frames[f]);
    for (const graph::StepProfile& step : frames[f].steps) {
      auto pass = std::ranges::find_if(
          passes, [&](const Pass& p) { return p.row == step.row && p.view == step.view; });
      if (pass == passes.end())
        pass = passes.insert(pass, {step.row, step.view, Series(frames.size())});
      pass->series.add(f, step);
    }
  }
  ProfileSummary summary;
  summary.frames = frames.size();
  summary.firstLeftOut = frames.size() < all.size();
  for (const Pass& pass : passes) summary.passes.push_back(pass.series.cost(pass.row, pass.view));
  summary.frame = whole.cost("", 0);
  return summary;
}

}  // namespace lucerna::app
