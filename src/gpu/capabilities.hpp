// What a driver offers, as plain data: `lucerna pipeline check --caps FILE` reads it from JSON, a
// Device fills it from GL.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "gpu/format.hpp"

namespace lucerna::gpu {

// Named features a pass may ask for.
inline constexpr std::string_view kFeatureCompute = "compute";
inline constexpr std::string_view kFeatureMultisample = "multisample-textures";
inline constexpr std::string_view kFeatureDualSourceBlend = "dual-source-blend";
inline constexpr std::string_view kFeatureMultiDrawIndirect = "multi-draw-indirect";
inline constexpr std::string_view kFeatureLayeredVertex = "layer-from-vertex-shader";
inline constexpr std::string_view kFeatureClipControl = "clip-control";

struct Capabilities {
  std::string name;  // "OpenGL 4.5 baseline", or the driver's renderer string
  std::set<std::string, std::less<>> features;
  std::set<Format> renderable;  // formats usable as targets
  int maxTextureSide = 16384;
  int maxTextureLayers = 2048;
  int maxColorTargets = 8;
  int maxSamples = 4;
  bool softwareRasterizer = false;  // llvmpipe, softpipe, SwiftShader: timer queries lie

  static Capabilities baseline();  // OpenGL 4.5 as DESIGN section 3 states it
  // {"name", "features": [...], "renderable": [...], "maxTextureSide",
  // "maxTextureLayers", "maxColorTargets", "maxSamples", "softwareRasterizer"}, or that under "gl",
  // as `lucerna doctor --json` prints it. features and renderable are required, the others keep
  // their defaults. The error (ErrorKind::Input) tells every fault; `name` is what it calls the
  // text, usually its path.
  static Result<Capabilities> fromJson(const std::string& text, const std::string& name);
  std::string toJson() const;
};

}  // namespace lucerna::gpu
