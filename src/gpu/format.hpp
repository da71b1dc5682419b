// Texel formats as values: no GL here, so that validation runs without a driver.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace lucerna::gpu {

enum class Format : std::uint8_t {
  R8Unorm,
  Rg8Unorm,
  Rgba8Unorm,
  Srgb8Alpha8,
  R8Uint,
  Rgba8Uint,
  R16Unorm,
  Rg16Unorm,
  Rgba16Unorm,
  R16Float,
  Rg16Float,
  Rgba16Float,
  R32Float,
  Rg32Float,
  Rgba32Float,
  R11G11B10Float,
  Rgb9E5,
  R16Uint,
  R32Uint,
  Rg32Uint,
  Rgba32Uint,
  R32Int,
  Depth32F,
  Depth24,
  Depth32FStencil8,
};

enum class FormatClass { Float, Unorm, Uint, Int, Depth };

struct FormatInfo {
  Format format;
  std::string_view name;  // "Rgba16Float": the one spelling in C++, JSON, docs
  int channels;
  int bytes;  // per texel
  FormatClass kind;
  bool renderable;  // as a colour or depth target in GL 4.5
};

const FormatInfo& info(Format format);
std::span<const FormatInfo> allFormats();  // in the order of the enumeration
std::optional<Format> formatFromName(std::string_view name);

}  // namespace lucerna::gpu
