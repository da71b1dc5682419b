// The common flags of everything that renders.
#pragma once

#include "app/settings.hpp"
#include "command_line.hpp"

namespace lucerna::cli {

// settings must outlive the parse.
void addRenderFlags(CLI::App& command, app::RenderSettings& settings);

// --plugin
void addPluginFlag(CLI::App& command, std::vector<std::string>& plugins);

// An option that may be given several times, one value each.
CLI::Option* addRepeatable(CLI::App& command, const std::string& name,
                           std::vector<std::string>& values, const std::string& help);

}  // namespace lucerna::cli
