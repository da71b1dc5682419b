// The run-time face of a pass, whether it was declared by a C++ struct, a script or a plugin.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "graph/description.hpp"

namespace lucerna::gpu {
class Device;
}

namespace lucerna::graph {

// The small context that execute receives beside its parameters and ports.
struct PassContext {
  gpu::Device& device;
  double time = 0;      // s, of the scene
  double timeStep = 0;  // s since the last frame
  std::uint64_t frame = 0;
  int view = 0;  // index of the view being drawn
  int viewCount = 1;
  uvec2 outputSize{0};  // pixels of what is drawn of the view: all of it, or a tile
  std::uint64_t seed = 0;
  std::vector<std::filesystem::path> written{};  // files; who writes one adds it
};

// One bound port: exactly one pointer is set, none if unbound. For data, `data` points to the T
// that the port's type names.
struct BoundPort {
  const PortDescription* port = nullptr;
  gpu::Texture* texture = nullptr;
  void* data = nullptr;
  bool isNew = false;  // an update without input: this pass makes the value
};

class PassInstance {
 public:
  virtual ~PassInstance() = default;
  // Called before the first execute, when the row's values changed, and whenever the pipeline is
  // set: the description may depend on files that changed.
  virtual void setParams(const ParamValues& values) = 0;
  // The graph has opened the debug group and the timer. Ports in the order of the description.
  virtual void execute(PassContext& context, std::span<const BoundPort> ports) = 0;
};

class PassType {
 public:
  virtual ~PassType() = default;
  // The description for the given values; missing values take their default, unknown ones are
  // ignored. Needs no GL.
  virtual PassDescription describe(const ParamValues& values) const = 0;
  virtual std::unique_ptr<PassInstance> create(gpu::Device& device) const = 0;
};

}  // namespace lucerna::graph
