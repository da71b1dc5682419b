// Deferred against forward shading: the same scene, lights and shading code, frames taken in turn.
//
// builtin:atrium with 4, 16 and 64 lights and no transparent objects, 640x360. Prints one table:
// the median time of a frame by the CPU clock with the GPU's work finished, and how alike the two
// tone mapped pictures are. Exits with 1 if they differ by more than 45 dB PSNR allows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "app/frame.hpp"
#include "core/log.hpp"
#include "image/metrics.hpp"
#include "quick.hpp"

namespace {

using namespace lucerna;
using Clock = std::chrono::steady_clock;

constexpr int kWarmUp = 2;
constexpr int kFrames = 7;

struct Way {
  const char* pipeline;
  std::unique_ptr<graph::Executor> executor = nullptr;
  std::vector<double> milliseconds = {};
  gpu::Counters counters = {};
  Image picture = {};
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// One frame by this way's executor.
Status frame(app::Session& session, Way& way, bool counts) {
  std::swap(session.executor, way.executor);
  session.device->finish();
  session.device->resetCounters();
  const auto start = Clock::now();
  const Status status = app::runFrame(
      session, nullptr, [&](app::Session& s, int, const gpu::Texture& output) -> Status {
        s.device->finish();
        if (counts)
          way.milliseconds.push_back(
              std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        way.counters = s.device->counters();
        way.picture = converted(s.device->download(output), ComponentType::F32, 3);
        return {};
      });
  std::swap(session.executor, way.executor);
  return status;
}

Status compare(int lights) {
  app::RenderSettings settings;
  settings.scene = fmt::format("builtin:atrium?lights={}", lights);
  settings.size = {640, 360};
  LUCERNA_TRY(session, app::openSession(settings));
  // The executors below have their pipelines already, and each draws one view.
  session->rebuild = false;
  session->plan = app::planViews(settings.renderSize(), 1, 0, 0);

  std::array<Way, 2> ways{Way{.pipeline = "deferred"}, Way{.pipeline = "forward"}};
  for (Way& way : ways) {
    LUCERNA_TRY(pipeline, app::readPipeline(session->registry, way.pipeline,
                                            {"Transparency.enabled=false"}, settings.seed));
    way.executor = std::make_unique<graph::Executor>(*session->device, session->registry);
    LUCERNA_TRY_VOID(way.executor->setPipeline(pipeline, settings.renderSize()));
  }
  for (int i = 0; i < kWarmUp + kFrames; ++i)
    for (Way& way : ways) LUCERNA_TRY_VOID(frame(*session, way, i >= kWarmUp));

  const double deferred = median(ways[0].milliseconds), forward = median(ways[1].milliseconds);
  const double psnr = pixelMetrics(ways[0].picture, ways[1].picture).psnr;
  fmt::print("{:>6} {:>12.1f} {:>11.1f} {:>8.2f} {:>9.1f} {:>15} {:>14}\n", lights, deferred,
             forward, forward / deferred, psnr, ways[0].counters.primitives,
             ways[1].counters.primitives);
  if (psnr < 45) return error(ErrorKind::Failed, "{} lights: the pictures differ", lights);
  return {};
}

}  // namespace

int main(int count, char** words) {
  log::setLevel(log::Level::Error);
  fmt::print("builtin:atrium, 640x360, median of {} interleaved frames\n", kFrames);
  fmt::print("{:>6} {:>12} {:>11} {:>8} {:>9} {:>15} {:>14}\n", "lights", "deferred/ms",
             "forward/ms", "ratio", "PSNR/dB", "deferred prims", "forward prims");
  const bool quick = isQuick(count, words);
  for (const int lights : quick ? std::vector{4} : std::vector{4, 16, 64}) {
    if (const Status status = compare(lights); !status) {
      fmt::print(stderr, "{}\n", status.error().message);
      return 1;
    }
  }
  return 0;
}
