#include "bake/estimate.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <mutex>
#include <numeric>
#include <vector>

#include "bake/assemble.hpp"
#include "bake/seconds.hpp"
#include "bake/unit_light.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/random.hpp"

namespace lucerna::bake {
namespace {

std::uint64_t residentBytes() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/proc/self/statm", "r"),
                                                             std::fclose);
  unsigned long long all = 0, resident = 0;
  if (!file || std::fscanf(file.get(), "%llu %llu", &all, &resident) != 2) return 0;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::vector<std::uint32_t> shuffled(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  Random random(1);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  return order;
}

struct Measured {
  double seconds = 0., texels = 0.;
  std::uint64_t bytes = 0, litTexels = 0;  // litTexels: of groups that switch
};

std::uint64_t litTexels(const UnitLight& light) {
  std::uint64_t count = 0;
  for (const BlockLight& block : light.blocks)
    for (const GroupLight& group : block.groups) {
      if (group.group == 0) continue;
      for (std::size_t i = 0; i + 2 < group.rgb.size(); i += 3)
        count += (group.rgb[i] | group.rgb[i + 1] | group.rgb[i + 2]) != 0 ? 1 : 0;
    }
  return count;
}

// The unit's blocks one by one, until it is late.
template <typename Late>
Measured lit(const Plan& plan, const LightScene& scene, const Unit& unit, Late late) {
  Measured sum;
  const auto start = Clock::now();
  UnitLighter lighter(plan, scene);
  for (std::uint32_t i = unit.firstBlock; i < unit.firstBlock + unit.blocks && !late(); ++i) {
    const auto texels = static_cast<std::uint32_t>(plan.blocks[i].size.x * plan.blocks[i].size.y);
    const UnitLight light = lighter.light({.firstBlock = i, .blocks = 1, .texels = texels});
    sum.texels += texels;
    sum.bytes += toBytes(light).size();
    sum.litTexels += litTexels(light);
  }
  sum.seconds = secondsSince(start);
  return sum;
}

std::vector<Measured> measure(const Plan& plan, const LightScene& scene, double seconds) {
  const std::vector<std::uint32_t> order = shuffled(plan.units.size());
  std::vector<Measured> found;
  std::mutex adding;
  std::atomic<bool> begun = false;
  const auto start = Clock::now();
  const auto late = [&] {
    return (begun.exchange(true) && secondsSince(start) > seconds) || Progress::cancelled();
  };
  parallelFor(order.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Measured one = lit(plan, scene, plan.units[order[i]], late);
      if (one.texels == 0.) return;
      const std::scoped_lock lock(adding);
      found.push_back(one);
    }
  });
  return found;
}

// The ratio estimator: time by texels. Its variance after Cochran, "Sampling Techniques", 1977,
// section 6.3, with the correction for a sample that is a good part of all.
void extrapolate(const Plan& plan, const std::vector<Measured>& found, Estimate& result) {
  Measured sum;
  for (const Measured& one : found) {
    sum.seconds += one.seconds;
    sum.texels += one.texels;
    sum.bytes += one.bytes;
    sum.litTexels += one.litTexels;
  }
  const auto threads = std::min<double>(threadCount(), static_cast<double>(plan.units.size()));
  const double factor = static_cast<double>(plan.texels()) / sum.texels;
  const double ratio = sum.seconds / sum.texels;
  const auto count = static_cast<double>(found.size());
  double squares = 0.;
  for (const Measured& one : found) squares += std::pow(one.seconds - ratio * one.texels, 2.);
  const double left = 1. - count / static_cast<double>(plan.units.size());
  result.units = found.size();
  result.lightSeconds = sum.seconds * factor / threads;
  if (count > 1.)
    result.deviation = std::sqrt(squares * left * count / (count - 1.)) * factor / threads;
  const auto all = [&](std::uint64_t some) {
    return static_cast<std::uint64_t>(static_cast<double>(some) * factor);
  };
  result.logBytes = all(sum.bytes);
  result.litBytes = all(kLitBytes * sum.litTexels);
}

// The most that finishing takes: of the maps half floats, bits, what their seams need, and on each
// thread a file that grows; or, when the maps are written, some groups and the patch of one.
std::uint64_t finishBytes(const Plan& plan, std::uint64_t litBytes) {
  const auto side = static_cast<std::uint64_t>(plan.settings.pack.side);
  const auto maps = static_cast<std::uint64_t>(plan.packed.packing.maps);
  const auto writers = std::min<std::uint64_t>(maps, static_cast<std::uint64_t>(threadCount()));
  const std::uint64_t map = side * side, bits = map * maps / 2, seams = map * maps;
  return bits + seams +
         std::max(6 * map * maps + 6 * map * writers, 3 * std::min(litBytes, mostGroupBytes(plan)));
}

}  // namespace

Result<Estimate> estimate(const Plan& plan, double seconds) {
  Estimate result;
  const std::uint64_t planned = residentBytes();
  const auto start = Clock::now();
  const LightScene scene(plan);
  LUCERNA_TRY_VOID(scene.emitters.status);
  result.emitterCells = scene.emitters.cells;
  result.prepareSeconds = secondsSince(start);
  const std::vector<Measured> found = measure(plan, scene, seconds);
  if (Progress::cancelled() || found.empty()) return error(ErrorKind::Cancelled, "cancelled");
  result.lightBytes = residentBytes();
  extrapolate(plan, found, result);
  result.finishBytes = planned == 0 ? 0 : planned + finishBytes(plan, result.litBytes);
  return result;
}

}  // namespace lucerna::bake
