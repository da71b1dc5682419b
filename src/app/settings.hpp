// What the user asks for: the common flags of everything that renders, as values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/math/math.hpp"
#include "core/result.hpp"
#include "gpu/context.hpp"
#include "image/image.hpp"

namespace lucerna::app {

inline constexpr int kMaxSide = 65536;  // px of an output

enum class StereoLayout { Mono, SideBySide, TopBottom, Anaglyph };

struct StereoSettings {
  StereoLayout layout = StereoLayout::Mono;
  float separation = 0.065f;  // m between the eyes
  float convergence = 3.f;    // m ahead, where both eyes see the same

  int eyes() const { return layout == StereoLayout::Mono ? 1 : 2; }
};

struct RenderSettings {
  std::string scene;
  std::string pipeline = "deferred";   // shipped name, .js or .json
  std::vector<std::string> sets;       // "Pass.param=value", "script.name=value"
  std::vector<std::string> plugins;    // shared libraries with passes
  std::string lightmap;                // folder that `lucerna bake` made; "": none
  std::vector<std::string> lightsOff;  // groups of its lights
  uvec2 size{1280, 720};               // px of the output, with two eyes of each
  int scale = 100;                     // percent: rendering size / output size
  int tile = 0;                        // px a side, a multiple of kTileGrid; 0: as the driver needs
  StereoSettings stereo;
  std::string camera;      // "": the scene's first
  std::string cameraPath;  // file; "": none
  std::string animation;   // name, index or "none"; "": the scene's choice
  std::uint64_t frames = 1;
  double time = 0, timeStep = 1.0 / 30;  // s
  std::uint64_t seed = 0;
  int threads = 0;                // 0: as many as the machine has cores
  std::optional<float> exposure;  // EV; the scene's if absent
  std::string profile;            // .csv .json .md .html; "": none
  std::string shaderFolder;       // read before the built-in shaders; "": none
  gpu::ContextKind gl = gpu::ContextKind::Auto;

  // Pixels of the rendering: `scale` percent of `size`, rounded, at least 1.
  uvec2 renderSize() const;
  // Pixels of the picture: `size`, twice as wide or high with eyes beside or above each other.
  uvec2 pictureSize() const;
};

// "1280x720".
Result<uvec2> sizeFromText(const std::string& text);

struct OutputSettings {
  std::string path;                 // .png .exr .hdr, with %04d for several frames; .mp4 .mkv
  std::vector<std::string> layers;  // of EXR; empty: colour only
  std::optional<ComponentType> exrType{};  // of EXR: Half or F32; Half if absent
  std::optional<double> fps{};             // of videos; one frame a time step if absent
  std::optional<int> crf{};                // of H.264, 0 (best) to 51; VideoSettings' own if absent
  bool lossless = false;                   // videos: FFV1 instead of H.264
};

}  // namespace lucerna::app
