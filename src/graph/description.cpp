#include "graph/description.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lucerna::graph {
namespace {

std::string kindText(const TextureSpec& spec) {
  switch (spec.kind) {
    case gpu::TextureKind::Plain2D:
      return "a 2D texture";
    case gpu::TextureKind::Array2D:
      return fmt::format("a 2D array texture of {} layers", spec.layers);
    case gpu::TextureKind::Cube:
      return "a cube texture";
    case gpu::TextureKind::CubeArray:
      return fmt::format("a cube array texture of {} faces", spec.layers);
    case gpu::TextureKind::Multisample2D:
      return fmt::format("a 2D texture of {} samples a pixel", spec.samples);
  }
  return "a texture";
}

template <typename Predicate>
const PortDescription* findPort(const std::vector<PortDescription>& ports, Predicate matches) {
  const auto found = std::find_if(ports.begin(), ports.end(), matches);
  return found == ports.end() ? nullptr : &*found;
}

}  // namespace

const char* nameOf(ParamType type) {
  switch (type) {
    case ParamType::Bool:
      return "bool";
    case ParamType::Int:
      return "int";
    case ParamType::Float:
      return "float";
    case ParamType::Choice:
      return "choice";
    case ParamType::Text:
      return "text";
    case ParamType::Color:
      return "color";
    case ParamType::Vector:
      return "vector";
  }
  return "";
}

const char* nameOf(Direction direction) {
  switch (direction) {
    case Direction::In:
      return "in";
    case Direction::Out:
      return "out";
    case Direction::InOut:
      return "inout";
  }
  return "";
}

const char* nameOf(Rebuild rebuild) {
  switch (rebuild) {
    case Rebuild::Nothing:
      return "nothing";
    case Rebuild::Shaders:
      return "shaders";
    case Rebuild::Ports:
      return "ports";
  }
  return "";
}

const char* nameOf(Frequency frequency) {
  switch (frequency) {
    case Frequency::PerScene:
      return "per scene";
    case Frequency::PerViewGroup:
      return "per view group";
    case Frequency::PerView:
      return "per view";
  }
  return "";
}

std::string PortType::text() const {
  if (!texture) return fmt::format("{} data", dataName);
  std::string formats;
  for (const gpu::Format format : texture->formats)
    formats += fmt::format("{}{}", formats.empty() ? "" : " or ", gpu::info(format).name);
  return formats.empty() ? kindText(*texture) : fmt::format("{} ({})", kindText(*texture), formats);
}

const ParamDescription* PassDescription::param(std::string_view name) const {
  const auto found = std::find_if(params.begin(), params.end(),
                                  [&](const ParamDescription& p) { return p.name == name; });
  return found == params.end() ? nullptr : &*found;
}

const PortDescription* PassDescription::input(std::string_view name) const {
  return findPort(ports, [&](const PortDescription& p) {
    return p.name == name && p.direction != Direction::Out;
  });
}

const PortDescription* PassDescription::output(std::string_view name) const {
  return findPort(ports, [&](const PortDescription& p) {
    return p.name == name && p.direction != Direction::In;
  });
}

}  // namespace lucerna::graph
