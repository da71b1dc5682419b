// --profile as something to read: Markdown for a text, HTML for a browser.
#pragma once

#include <string>

#include "app/profile.hpp"

namespace lucerna::app {

// A table: mean and median times, counts and memory of every pass, with a bar of its GPU time.
std::string profileMarkdown(const ProfileLog& log);

// A page that stands alone: the same table, GPU time by pass and frame by frame as drawings (SVG).
std::string profileHtml(const ProfileLog& log);

}  // namespace lucerna::app
