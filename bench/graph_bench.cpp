// What the graph costs: an empty pass per frame with profiling off, and recompiling a pipeline of
// 20 passes with a change of one row. Medians of many runs, milliseconds of CPU time.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "gpu/context.hpp"
#include "graph/executor.hpp"

using namespace lucerna;
using namespace lucerna::graph;

namespace {

class Empty {
 public:
  struct Params {
    float amount = 1, other = 2;
    int count = 3;
  };
  struct Ports {
    In<gpu::Texture> in;
    Out<gpu::Texture> out;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Empty", "Does nothing.");
    d.param("amount", &Params::amount).range(0, 10);
    d.param("other", &Params::other).range(0, 10);
    d.param("count", &Params::count).range(0, 10);
    d.read("color", &Ports::in).texture(gpu::Format::Rgba16Float).optional();
    d.write("color", &Ports::out).texture(gpu::Format::Rgba16Float).passesThrough("color");
  }
  explicit Empty(gpu::Device&) {}
  void execute(PassContext&, const Params&, const Ports&) {}
};

Pipeline pipelineOf(int passes) {
  Pipeline pipeline{.name = "bench"};
  for (int i = 0; i < passes; ++i)
    pipeline.passes.push_back(
        {.name = fmt::format("P{}", i), .type = "Empty", .reads = {}, .params = {}});
  return pipeline;
}

template <typename Work>
double medianMs(int runs, Work work) {
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work(i);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count());
  }
  std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
  return times[static_cast<std::size_t>(runs / 2)];
}

void require(const Status& status) {
  if (status) return;
  std::fprintf(stderr, "%s\n", status.error().message.c_str());
  std::exit(1);
}

}  // namespace

int main() {
  auto context = gpu::Context::create();
  if (!context) return std::fprintf(stderr, "%s\n", context.error().message.c_str()), 4;
  auto device = gpu::Device::create(**context);
  if (!device) return std::fprintf(stderr, "%s\n", device.error().message.c_str()), 4;
  Registry registry;
  registry.add<Empty>();
  Executor executor(**device, registry);
  const std::vector<Imports> views(1);
  const auto frame = [&](int) { require(executor.execute({.views = views}, nullptr)); };

  double frameMs[2];
  const int counts[2] = {20, 200};
  for (int i = 0; i < 2; ++i) {
    require(executor.setPipeline(pipelineOf(counts[i]), {64, 64}));
    medianMs(100, frame);
    frameMs[i] = medianMs(2000, frame);
  }
  std::printf("frame of %3d empty passes    %8.4f ms\n", counts[0], frameMs[0]);
  std::printf("frame of %3d empty passes    %8.4f ms\n", counts[1], frameMs[1]);
  std::printf("one empty pass               %8.2f us\n",
              1000 * (frameMs[1] - frameMs[0]) / (counts[1] - counts[0]));

  Pipeline pipeline = pipelineOf(20);
  const auto recompile = [&](int i) {
    pipeline.passes[10].enabled = i % 2 == 0;
    require(executor.setPipeline(pipeline, {1280, 720}));
  };
  recompile(0);
  recompile(1);
  std::printf("recompile of 20 passes       %8.3f ms\n", medianMs(500, recompile));
  require(executor.setPipeline(pipelineOf(10), {1280, 720}));
  std::printf("10 passes at 1280x720        %8.1f MiB, without reuse %.1f MiB\n",
              static_cast<double>(executor.schedule().bytes()) / (1 << 20),
              static_cast<double>(executor.schedule().bytesWithoutReuse()) / (1 << 20));
  return 0;
}
