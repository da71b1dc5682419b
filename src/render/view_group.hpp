// The resource "views": the pictures that one frame draws together, both eyes of a stereo pair for
// instance. What is made once for all of them is made for their union.
#pragma once

#include <vector>

#include "scene/view.hpp"

namespace lucerna::render {

struct ViewGroup {
  static constexpr const char* kPortName = "Views";
  std::vector<scene::View> views;  // of whole pictures, whatever tiles they are drawn in
};

}  // namespace lucerna::render
