// Triangles for tests, each with corners of its own.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::bake {

struct TriangleSoup {
  std::vector<vec3> positions;
  std::vector<std::uint32_t> indices;

  void add(vec3 a, vec3 b, vec3 c) {
    for (const vec3 p : {a, b, c}) {
      indices.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(p);
    }
  }
};

}  // namespace lucerna::bake
