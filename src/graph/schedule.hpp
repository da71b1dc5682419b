// From wiring to steps and physical textures: sizes, versions, lifetimes, reuse. No GL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/validate.hpp"

namespace lucerna::graph {

// A value of the graph: each write or update of a texture or data port makes a new version.
// Versions made by updates in place share their physical slot.
struct Version {
  std::string name;  // "GBuffer.depth"
  PortType type;
  gpu::TextureDesc texture;                 // of textures
  std::size_t physical = 0;                 // index in Schedule::textures or Schedule::data
  std::size_t firstStep = 0, lastStep = 0;  // written at, last read at
};

struct PhysicalTexture {
  gpu::TextureDesc desc;
  std::vector<std::size_t> versions;  // that take turns in it
  bool keepsContent = false;          // history or persistent: never reused
};

struct Step {
  enum class Kind { Pass, Copy, Fill } kind = Kind::Pass;
  std::size_t row = 0;  // index in Plan::rows
  // Version (or resource name) of each port in the description's order; kNoVersion if unbound.
  std::vector<std::size_t> versions;
  std::size_t from = 0, to = 0;  // Copy: versions; Fill: `to`. A copy is made only where an update
                                 // would destroy a version that a later row still reads.
  vec4 fill{0.f};
  Frequency frequency = Frequency::PerView;
};
inline constexpr std::size_t kNoVersion = ~std::size_t{0};

struct Schedule {
  std::vector<Version> versions;
  std::vector<PhysicalTexture> textures;
  std::vector<Step> steps;  // per-scene and per-group steps stand before per-view ones
  std::size_t output = kNoVersion;
  std::vector<std::size_t> kept;
  std::uint64_t bytes() const;              // of the physical textures
  std::uint64_t bytesWithoutReuse() const;  // if every version had its own
};

Schedule makeSchedule(const Plan& plan, uvec2 outputSize);

// `lucerna pipeline print` and `graph`.
std::string printWiring(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);
std::string toDot(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);
std::string toSvg(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);
std::string wiringJson(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);

}  // namespace lucerna::graph
