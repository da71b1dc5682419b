// GPU timers: pairs of timestamp queries, which nest; or the CPU clock around a finished pipe on
// software rasterisers, whose queries measure only the recording of commands.
#include "gpu/device_impl.hpp"
#include "gpu/workarounds.hpp"

namespace lucerna::gpu {

using Clock = std::chrono::steady_clock;

bool Device::timersUseCpuClock() const {
  return impl_->uses(kTimersOnCpuClock);
}

void Device::beginTimer(std::string_view name) {
  impl_->openTimers.push_back(impl_->timers.size());
  Timer& timer = impl_->timers.emplace_back();
  timer.name = name;
  if (timersUseCpuClock()) {
    glFinish();
    timer.start = Clock::now();
    return;
  }
  glCreateQueries(GL_TIMESTAMP, 1, &timer.begin);
  glCreateQueries(GL_TIMESTAMP, 1, &timer.end);
  impl_->objects.queries += 2;
  glQueryCounter(timer.begin, GL_TIMESTAMP);
}

void Device::endTimer() {
  CHECK(!impl_->openTimers.empty(), "endTimer() without beginTimer()");
  Timer& timer = impl_->timers[impl_->openTimers.back()];
  impl_->openTimers.pop_back();
  if (!timersUseCpuClock()) {
    glQueryCounter(timer.end, GL_TIMESTAMP);
    return;
  }
  glFinish();
  timer.milliseconds =
      std::chrono::duration<double, std::milli>(Clock::now() - timer.start).count();
}

std::vector<std::pair<std::string, double>> Device::takeTimes() {
  CHECK(impl_->openTimers.empty(), "takeTimes() while a timer runs");
  std::vector<std::pair<std::string, double>> times;
  for (Timer& timer : impl_->timers) {
    if (timer.begin != 0) {
      GLuint64 begin = 0, end = 0;  // nanoseconds
      glGetQueryObjectui64v(timer.begin, GL_QUERY_RESULT, &begin);
      glGetQueryObjectui64v(timer.end, GL_QUERY_RESULT, &end);
      timer.milliseconds = static_cast<double>(end - begin) * 1e-6;
      glDeleteQueries(1, &timer.begin);
      glDeleteQueries(1, &timer.end);
      impl_->objects.queries -= 2;
    }
    times.emplace_back(std::move(timer.name), timer.milliseconds);
  }
  impl_->timers.clear();
  return times;
}

}  // namespace lucerna::gpu
