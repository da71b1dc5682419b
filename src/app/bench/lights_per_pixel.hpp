// How many lights overlap in a picture.
#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "scene/view.hpp"

namespace lucerna::app::bench {

// Of each pixel that shows a surface, row by row: how many lights would reach it if nothing were in
// their way: it faces them within their reach and cone. size: px.
std::vector<double> lightsPerPixel(const scene::Scene& scene, const scene::View& view, uvec2 size);

}  // namespace lucerna::app::bench
