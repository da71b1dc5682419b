// The common flags of everything that renders.
#pragma once

#include "app/settings.hpp"
#include "command_line.hpp"

namespace lucerna::cli {

// Scene, camera, size, time, seed, threads: what drawing and tracing share. settings must outlive
// the parse, here and below.
void addSceneFlags(CLI::App& command, app::RenderSettings& settings);
// These, and what drawing alone takes.
void addRenderFlags(CLI::App& command, app::RenderSettings& settings);

// --plugin
void addPluginFlag(CLI::App& command, std::vector<std::string>& plugins);

// An option that may be given several times, one value each.
CLI::Option* addRepeatable(CLI::App& command, const std::string& name,
                           std::vector<std::string>& values, const std::string& help);

}  // namespace lucerna::cli
