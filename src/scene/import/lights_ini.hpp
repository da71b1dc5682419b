// The light configuration of system B: lights.ini (thesis, appendix C.1, listings C.1 and C.2).
// Format and keys: docs/user/lights-ini.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "scene/bake_hints.hpp"

namespace lucerna::scene {

// A section LIGHTn: what the lights of the n-th object made of edges have in common.
struct LightGroupIni {
  int line = 0;                     // of its header
  bool blink = false;               // switches by itself, apart from other groups
  vec3 color{1.f};                  // what a white surface shows, undimmed; 0 and up
  float cut = -1.f;                 // degrees, half-angle up to 90; below 0: a point light
  float spot = 0.f;                 // exponent of the cosine to the axis
  vec3 attenuation{0.f, 0.f, 1.f};  // constant, linear (1/m), quadratic (1/m^2); not all 0
};

struct LightsIni {
  std::string file;  // its name, for messages
  std::map<std::uint32_t, LightGroupIni> groups;
  BakeHints bake;                     // the thesis' values where the file gives none
  std::vector<std::string> warnings;  // what was passed over, each with file and line
};

// `name` stands for the file in warnings.
LightsIni parseLightsIni(std::string_view text, const std::string& name);

// NAME.lights.ini beside the scene file NAME.obj, else lights.ini in its folder; nothing if there
// is neither. ErrorKind::Input: it cannot be read, is no text or larger than 1 MiB.
Result<std::optional<LightsIni>> readLightsIni(const std::filesystem::path& scene);

}  // namespace lucerna::scene
