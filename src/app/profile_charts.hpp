// The drawings of a profile's page, as SVG. Private to this folder.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/profile_summary.hpp"

namespace lucerna::app {

// Two bars a pass: GPU in the pass's colour, CPU in grey. names: as summary.passes.
std::string passChart(const ProfileSummary& summary, std::span<const std::string> names);

// A column a frame (or for several, if there are many), the passes' GPU times on top of each other.
// frames: those that the summary sums up are drawn.
std::string frameChart(std::span<const graph::FrameProfile> frames, const ProfileSummary& summary,
                       std::span<const std::string> names);

}  // namespace lucerna::app
