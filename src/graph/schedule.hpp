// From wiring to steps and physical textures: sizes, versions, lifetimes, reuse. No GL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/validate.hpp"

namespace lucerna::graph {

inline constexpr std::size_t kNoVersion = ~std::size_t{0};

// A value of the graph: each write or update of a texture or data port makes a new version.
// Versions made by updates in place share their physical slot.
struct Version {
  std::string name{};  // "GBuffer.depth"
  PortType type;
  gpu::TextureDesc texture;   // of textures
  std::size_t physical = 0;   // index in Schedule::textures or Schedule::data
  std::size_t firstStep = 0;  // written at
  std::size_t lastStep = 0;   // last read at; the number of steps if it survives the frame
  Frequency frequency = Frequency::PerView;
  bool history = false;     // read again in the next frame
  bool persistent = false;  // the pass finds last frame's content in it
  bool standIn = false;     // a constant, filled once
};

// Holds its versions one after the other.
struct PhysicalTexture {
  gpu::TextureDesc desc;
  std::vector<std::size_t> versions{};
  bool keepsContent = false;  // between frames; never shared by other values
  bool history = false;       // there are two, this frame's and the last one's
  bool perView = false;       // there is one a view (or two)
};

// One object, kept between frames.
struct PhysicalData {
  PortType type;
  std::vector<std::size_t> versions{};
  bool history = false, perView = false;  // as above
};

struct Step {
  enum class Kind { Pass, Copy, Fill } kind = Kind::Pass;
  std::string name{};   // the row's; "(copy) GBuffer.depth", "(fill) Ao.ambientVisibility"
  std::size_t row = 0;  // Pass: index in Plan::rows
  // Pass: version of each port in the description's order. kNoVersion: unbound, an output that
  // nobody wants, or a resource.
  std::vector<std::size_t> versions{};
  // Copy: versions; Fill: `to`. A copy is made only where an update would destroy a version that
  // is still read. A fill runs once, when its texture is new.
  std::size_t from = kNoVersion, to = kNoVersion;
  vec4 fill{0.f};
  Frequency frequency = Frequency::PerView;
};

struct Schedule {
  uvec2 outputSize{0};
  std::vector<Version> versions{};
  std::vector<PhysicalTexture> textures{};
  std::vector<PhysicalData> data{};
  std::vector<Step> steps{};  // fills, per scene, per group, per view
  std::size_t output = kNoVersion;
  std::vector<std::size_t> kept{};          // as Plan::kept
  std::uint64_t bytes() const;              // of the physical textures, for one view
  std::uint64_t bytesWithoutReuse() const;  // if every version had its own
};

Schedule makeSchedule(const Plan& plan, uvec2 outputSize);

// `lucerna pipeline print` and `graph`. A diagram shows the rows from top to bottom, their ports
// and wires, and beside them one lane per physical texture with the lifetimes of what it holds.
std::string printWiring(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);
std::string toDot(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);
std::string toSvg(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);
std::string wiringJson(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule);

}  // namespace lucerna::graph
