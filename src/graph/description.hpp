// What a pass is, as run-time data: the validator, panels, `--set`, JSON and JS, `lucerna pass
// show`, generated docs and parameter sweeps all walk this. A typed pass makes it through PassInfo
// (graph/pass_info.hpp).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include "gpu/format.hpp"
#include "gpu/texture.hpp"
#include "graph/value.hpp"

namespace lucerna::graph {

// File: a path, in pipelines relative to their own file (Pipeline::folder).
enum class ParamType { Bool, Int, Float, Choice, Text, Color, Vector, File };

// What changing a parameter costs: nothing (read each frame), new shaders, or a new description
// (ports, sizes or formats depend on it).
enum class Rebuild { Nothing, Shaders, Ports };

struct ParamDescription {
  std::string name{};
  ParamType type = ParamType::Float;
  Value defaultValue{};
  std::optional<double> min{}, max{};  // of numbers, inclusive
  std::string unit{};                  // "m", "rad", "px", "EV", ...; "" for pure numbers
  std::vector<std::string> choices{};  // of Choice
  std::size_t size = 1;                // numbers in a Color (3) or Vector
  Rebuild rebuild = Rebuild::Nothing;
  bool writesFile = false;  // of Text: a file that the row writes, %04d being the frame's number
  std::string help{};
};

enum class Direction { In, Out, InOut };

// A texture that an input accepts or an output makes.
struct TextureSpec {
  gpu::TextureKind kind = gpu::TextureKind::Plain2D;
  // In: accepted formats, empty = any. Out: exactly one, the format made.
  std::vector<gpu::Format> formats{};
  int layers = 1, levels = 1, samples = 1;  // of outputs
};

// What a port carries: a texture, or typed data (draw lists, lights, ...) known by its C++ type.
struct PortType {
  std::optional<TextureSpec> texture{};
  std::type_index data = typeid(void);
  std::string dataName{};                             // "DrawLists"
  std::function<std::shared_ptr<void>()> makeData{};  // a new default-constructed one
  std::string text() const;                           // for messages: "a 2D texture (Depth32F)"
};

// Size of an output, as a relation.
struct SizeRule {
  enum class Kind { Output, Port, Absolute } kind = Kind::Output;
  std::string port{};         // Kind::Port: an input of the same pass
  float scale = 1.f;          // of the size referred to, rounded up, at least 1
  int width = 1, height = 1;  // Kind::Absolute
};

// What readers get from an output whose pass is disabled.
struct StandIn {
  enum class Kind { None, Fill, PassThrough } kind = Kind::None;
  vec4 fill{0.f};
  std::string input{};  // PassThrough: the input whose value the output repeats
};

inline constexpr int kWholeImage = -1;

struct PortDescription {
  std::string name{};  // inputs and outputs are separate name spaces: a filter reads and
                       // writes "color"; InOut is both
  Direction direction = Direction::In;
  PortType type{};
  SizeRule size{};  // Out, and InOut that is made
  std::string
      sameSizeAs{};   // In, InOut: the input whose size this one must have; "" if any will do
  StandIn standIn{};  // Out; InOut repeats its input if it has one
  // In: may stay unbound. Out: not made when nobody reads it. InOut: made like an output where
  // there is nothing to update.
  bool optional = false;
  bool history = false;  // In: last frame's value of the port it is bound to; unbound after a cut
  bool persistent = false;  // Out: kept between frames (a cache of the pass)
  int halo = 0;             // In: pixels read around the one written; kWholeImage
  std::string help{};

  // Whether the pass may be its first maker.
  bool makes() const {
    return direction == Direction::Out || (direction == Direction::InOut && optional);
  }
};

enum class Frequency { PerScene, PerViewGroup, PerView };

const char* nameOf(ParamType type);       // "float"
const char* nameOf(Direction direction);  // "in", "out", "inout"
const char* nameOf(Rebuild rebuild);      // "nothing"
const char* nameOf(Frequency frequency);  // "per view"

// What the values of a row ask for and the pass cannot give: a file that cannot be read, say.
struct DescriptionFault {
  std::string param{};
  std::string found{}, wanted{}, remedy{};
};

struct PassDescription {
  std::string type{};     // "ScreenSpaceAo"
  std::string summary{};  // one sentence
  std::vector<ParamDescription> params{};
  std::vector<PortDescription> ports{};
  Frequency frequency = Frequency::PerView;
  std::vector<std::string> features{};     // gpu::kFeature... names
  std::vector<DescriptionFault> faults{};  // with one, ports and parameters may be missing

  const ParamDescription* param(std::string_view name) const;
  const PortDescription* input(std::string_view name) const;   // In or InOut
  const PortDescription* output(std::string_view name) const;  // Out or InOut
};

}  // namespace lucerna::graph
