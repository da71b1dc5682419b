// The typed front end: a pass is a class with Params, Ports, describe() and execute(); this turns
// it into a PassType.
//
//   class Example {
//    public:
//     struct Params { float radius = 0.5f; };
//     struct Ports { In<Texture> depth; Out<Texture> mask; };
//     static void describe(PassInfo<Params, Ports>& d) {
//       d.pass("Example", "One sentence.");
//       d.param("radius", &Params::radius).range(0, 10).unit("m").help("...");
//       d.read("depth", &Ports::depth).texture(Format::Depth32F);
//       d.write("mask",
//       &Ports::mask).texture(Format::R8Unorm).sizeOf("depth").whenDisabled(vec4(1));
//     }
//     explicit Example(gpu::Device& device);
//     void execute(PassContext& context, const Params& params, const Ports& ports);
//   };
//
// describe() runs once with default Params and again with the row's: d.values() gives them, so that
// ports may depend on parameters.
#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "graph/pass.hpp"
#include "graph/ports.hpp"

namespace lucerna::graph {

// Typed data that ports carry names itself: `static constexpr const char* kPortName = "DrawLists";`
template <typename T>
concept PortData = requires {
  { T::kPortName } -> std::convertible_to<const char*>;
};

// The number of a choice's name; none if it is no name of this parameter.
std::optional<std::int64_t> choiceIndex(const ParamDescription& description, const Value& value);

// Builders point into the description: use them in the statement that made them.
class ParamBuilder {
 public:
  explicit ParamBuilder(ParamDescription& d) : d_(&d) {}
  ParamBuilder& range(double min, double max) {
    d_->min = min, d_->max = max;
    return *this;
  }
  ParamBuilder& unit(std::string unit) {
    d_->unit = std::move(unit);
    return *this;
  }
  ParamBuilder& help(std::string help) {
    d_->help = std::move(help);
    return *this;
  }
  ParamBuilder& rebuilds(Rebuild rebuild) {
    d_->rebuild = rebuild;
    return *this;
  }
  // Of an enum member, in the order of its values (0, 1, ...); of a std::string, any order.
  ParamBuilder& choices(std::vector<std::string> names);
  ParamBuilder& color() {
    d_->type = ParamType::Color;
    return *this;
  }
  ParamBuilder& file() {  // of a std::string
    d_->type = ParamType::File;
    return *this;
  }
  ParamBuilder& writesFile() {  // of a std::string; ParamDescription says more
    d_->writesFile = true;
    return *this;
  }

 private:
  ParamDescription* d_;
};

class PortBuilder {
 public:
  explicit PortBuilder(PortDescription& d) : d_(&d) {}
  template <typename... Formats>
  PortBuilder& texture(Formats... formats) {
    return spec(gpu::TextureKind::Plain2D, {formats...});
  }
  template <typename... Formats>
  PortBuilder& textureArray(int layers, Formats... formats) {
    spec(gpu::TextureKind::Array2D, {formats...});
    d_->type.texture->layers = layers;
    return *this;
  }
  PortBuilder& spec(gpu::TextureKind kind, std::vector<gpu::Format> formats);
  PortBuilder& samples(int count) {
    d_->type.texture->samples = count;
    return *this;
  }
  PortBuilder& levels(int count) {
    d_->type.texture->levels = count;
    return *this;
  }
  // Outputs: size of an input (times scale), of the output, or absolute.
  PortBuilder& sizeOf(std::string input, float scale = 1.f);
  PortBuilder& sizeOfOutput(float scale = 1.f);
  PortBuilder& size(int width, int height);
  PortBuilder& sameSizeAs(std::string input);  // In, InOut: another size is a fault
  PortBuilder& whenDisabled(vec4 fill);
  PortBuilder& passesThrough(std::string input);  // when disabled
  // PortDescription::optional says what it means for each direction.
  PortBuilder& optional() {
    d_->optional = true;
    return *this;
  }
  PortBuilder& history() {
    d_->history = true;
    return *this;
  }
  PortBuilder& persistent() {
    d_->persistent = true;
    return *this;
  }
  PortBuilder& halo(int pixels) {
    d_->halo = pixels;
    return *this;
  }
  PortBuilder& help(std::string help) {
    d_->help = std::move(help);
    return *this;
  }

 private:
  PortDescription* d_;
};

template <typename Params, typename Ports>
class PassInfo {
 public:
  explicit PassInfo(const Params& values) : values_(values) {}

  const Params& values() const { return values_; }
  void pass(std::string type, std::string summary);
  void runs(Frequency frequency) { description_.frequency = frequency; }
  void needs(std::string_view feature) { description_.features.emplace_back(feature); }
  // What the values ask for and the pass cannot give.
  void fault(DescriptionFault fault) { description_.faults.push_back(std::move(fault)); }

  // Member: bool, int, float, std::string, vec2, vec3, vec4 or an enum with choices().
  template <typename Member>
  ParamBuilder param(std::string name, Member Params::* member);

  template <typename T>
  PortBuilder read(std::string name, In<T> Ports::* member);
  template <typename T>
  PortBuilder write(std::string name, Out<T> Ports::* member);
  template <typename T>
  PortBuilder update(std::string name, InOut<T> Ports::* member);

  const PassDescription& description() const { return description_; }
  void assign(Params& params, const ParamValues& values) const;
  void bind(Ports& ports, std::span<const BoundPort> bound) const;

 private:
  template <typename T, typename Member>
  PortBuilder port(std::string name, Direction direction, Member member);

  Params values_;
  PassDescription description_;
  std::vector<std::function<void(Params&, const Value&)>> setters_;     // as description_.params
  std::vector<std::function<void(Ports&, const BoundPort&)>> binders_;  // as description_.ports
};

// A PassType of a class as described above.
template <typename Pass>
std::unique_ptr<PassType> makePassType();

}  // namespace lucerna::graph

#include "graph/pass_info_impl.hpp"
