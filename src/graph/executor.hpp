// Runs a pipeline on a Device, frame after frame.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.hpp"
#include "graph/schedule.hpp"

namespace lucerna::graph {

// Pointers to the resources of the registry for one frame, by name.
class Imports {
 public:
  template <PortData T>
  void set(std::string name, const T& data) {
    entries_.insert_or_assign(std::move(name), Entry{typeid(T), const_cast<T*>(&data)});
  }
  // Null if absent; a wrong type asserts.
  void* find(std::string_view name, std::type_index type) const;

 private:
  struct Entry {
    std::type_index type = typeid(void);
    void* data = nullptr;
  };
  std::map<std::string, Entry, std::less<>> entries_;
};

struct FrameInput {
  double time = 0, timeStep = 0;
  std::uint64_t frame = 0, seed = 0;
  bool cut = false;                  // history is void: first frame, camera cut, new scene
  bool sceneChanged = true;          // per-scene passes run again
  Imports shared{};                  // resources that all views share
  std::span<const Imports> views{};  // one a view: its perView resources
};

// One step's cost in one frame.
struct StepProfile {
  std::string row;  // "GBuffer"; copies and fills are named "(copy) GBuffer.depth"
  int view = 0;
  double cpuMs = 0, gpuMs = 0;
  gpu::Counters counters;
  std::uint64_t textureBytes = 0;  // of the textures it wrote
};
// One frame's cost; all but `frame` is empty while profiling is off.
struct FrameProfile {
  std::uint64_t frame = 0;
  std::vector<StepProfile> steps;
  double cpuMs = 0, gpuMs = 0;  // sums over the steps
  gpu::Counters counters;       // sums over the steps
  // Of all textures that the pipeline holds: less than the steps' sum, for they share.
  std::uint64_t textureBytes = 0;
};

class Executor {
 public:
  // The registry must outlive the executor.
  Executor(gpu::Device& device, const Registry& registry);
  ~Executor();

  // Validates, makes the passes and textures. Rows that stay keep their instance, textures their
  // pool. On an error (ErrorKind::Pipeline, all faults in one message) nothing is rendered until
  // the next success. Warnings are logged once.
  Status setPipeline(const Pipeline& pipeline, uvec2 outputSize,
                     const std::vector<std::string>& kept = {});
  // Changes one value of the pipeline. Cheap for parameters that rebuild nothing or shaders; those
  // that change ports do what setPipeline does. Errors (ErrorKind::Usage; ErrorKind::Pipeline if
  // the new ports do not fit) change nothing.
  Status setParam(const std::string& row, const std::string& param, const Value& value);

  // Runs all steps; after each view's steps calls onView(view, output), if any, while its textures
  // are alive. A shader that does not compile is an error (ErrorKind::Pipeline), as is what a pass
  // reported to the device (a file that cannot be written: ErrorKind::Failed); its view is not
  // handed over. An error of onView's ends the frame, too. All resources that the pipeline reads
  // must be given (asserted).
  using OnView = std::function<Status(int view, const gpu::Texture& output)>;
  Status execute(const FrameInput& input, const OnView& onView);
  // A kept value of the view just drawn, as named in setPipeline; valid inside onView. Null if that
  // is not a texture.
  const gpu::Texture* kept(std::string_view name) const;
  // The same of a port that carries data.
  template <PortData T>
  const T* keptData(std::string_view name) const {
    return static_cast<const T*>(keptData(name, typeid(T)));
  }

  // Files that passes wrote in the last frame.
  const std::vector<std::filesystem::path>& written() const;

  void setProfiling(bool on);
  const FrameProfile& profile() const;  // of the last frame

  // Of the last success; empty after a failure.
  const Plan& plan() const;
  const std::vector<std::string>& warnings() const;  // of the pipeline; logged when they change
  const Schedule& schedule() const;

 private:
  const void* keptData(std::string_view name, std::type_index type) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lucerna::graph
