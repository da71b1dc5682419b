#include "gpu/format.hpp"

#include <array>

#include "core/check.hpp"

namespace lucerna::gpu {
namespace {

using enum Format;
using enum FormatClass;

constexpr std::array kFormats = {
    FormatInfo{R8Unorm, "R8Unorm", 1, 1, Unorm, true},
    FormatInfo{Rg8Unorm, "Rg8Unorm", 2, 2, Unorm, true},
    FormatInfo{Rgba8Unorm, "Rgba8Unorm", 4, 4, Unorm, true},
    FormatInfo{Srgb8Alpha8, "Srgb8Alpha8", 4, 4, Unorm, true},
    FormatInfo{R8Uint, "R8Uint", 1, 1, Uint, true},
    FormatInfo{Rgba8Uint, "Rgba8Uint", 4, 4, Uint, true},
    FormatInfo{R16Unorm, "R16Unorm", 1, 2, Unorm, true},
    FormatInfo{Rg16Unorm, "Rg16Unorm", 2, 4, Unorm, true},
    FormatInfo{Rgba16Unorm, "Rgba16Unorm", 4, 8, Unorm, true},
    FormatInfo{R16Float, "R16Float", 1, 2, Float, true},
    FormatInfo{Rg16Float, "Rg16Float", 2, 4, Float, true},
    FormatInfo{Rgba16Float, "Rgba16Float", 4, 8, Float, true},
    FormatInfo{R32Float, "R32Float", 1, 4, Float, true},
    FormatInfo{Rg32Float, "Rg32Float", 2, 8, Float, true},
    FormatInfo{Rgba32Float, "Rgba32Float", 4, 16, Float, true},
    FormatInfo{R11G11B10Float, "R11G11B10Float", 3, 4, Float, true},
    FormatInfo{Rgb9E5, "Rgb9E5", 3, 4, Float, false},
    FormatInfo{R16Uint, "R16Uint", 1, 2, Uint, true},
    FormatInfo{R32Uint, "R32Uint", 1, 4, Uint, true},
    FormatInfo{Rg32Uint, "Rg32Uint", 2, 8, Uint, true},
    FormatInfo{Rgba32Uint, "Rgba32Uint", 4, 16, Uint, true},
    FormatInfo{R32Int, "R32Int", 1, 4, Int, true},
    FormatInfo{Depth32F, "Depth32F", 1, 4, Depth, true},
    FormatInfo{Depth24, "Depth24", 1, 4, Depth, true},
    FormatInfo{Depth32FStencil8, "Depth32FStencil8", 1, 8, Depth, true},
};

}  // namespace

std::span<const FormatInfo> allFormats() {
  return kFormats;
}

const FormatInfo& info(Format format) {
  const FormatInfo& result = kFormats.at(static_cast<std::size_t>(format));
  CHECK(result.format == format, "the format table is out of order at {}", result.name);
  return result;
}

std::optional<Format> formatFromName(std::string_view name) {
  for (const FormatInfo& format : kFormats)
    if (format.name == name) return format.format;
  return std::nullopt;
}

}  // namespace lucerna::gpu
