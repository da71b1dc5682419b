// One number for a colour, to tell which of two is more light.
#pragma once

#include "core/math/math.hpp"

namespace lucerna::bake {

inline float brightness(vec3 color) {
  return color.x + color.y + color.z;
}

}  // namespace lucerna::bake
