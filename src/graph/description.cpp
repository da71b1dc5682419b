#include "graph/description.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"

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

const char* nameOf(gpu::FormatClass kind) {
  switch (kind) {
    case gpu::FormatClass::Float:
      return "any float";
    case gpu::FormatClass::Unorm:
      return "any unorm";
    case gpu::FormatClass::Uint:
      return "any unsigned integer";
    case gpu::FormatClass::Int:
      return "any integer";
    case gpu::FormatClass::Depth:
      return "any depth";
  }
  return "";
}

// A class stands for its formats where all of them are there.
std::vector<std::string> formatNames(const std::vector<gpu::Format>& formats) {
  const auto isThere = [&](gpu::Format format) {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  };
  const auto isWhole = [&](gpu::FormatClass kind) {
    return std::ranges::all_of(gpu::allFormats(), [&](const gpu::FormatInfo& info) {
      return info.kind != kind || isThere(info.format);
    });
  };
  std::vector<std::string> names;
  for (const gpu::Format format : formats) {
    const gpu::FormatInfo& info = gpu::info(format);
    const bool whole = formats.size() > 1 && isWhole(info.kind);
    std::string name = whole ? nameOf(info.kind) : std::string(info.name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  }
  return names;
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
    case ParamType::File:
      return "file";
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
  const std::string formats = join(formatNames(texture->formats), " or ");
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
