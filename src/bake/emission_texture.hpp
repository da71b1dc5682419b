// Where an emission texture shines at all: most of a facade is dark, and is passed over by this.
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace lucerna::bake {

class EmissionTexture {
 public:
  explicit EmissionTexture(const scene::Texture& texture);
  // Linear colour, filtered.
  vec3 at(vec2 uv) const;
  // False only if it is black wherever bilinear filtering looks within the box.
  bool shines(vec2 minUv, vec2 maxUv) const;

 private:
  static constexpr int kCell = 16;  // pixels
  const scene::Texture& texture_;
  int width_, height_;        // cells
  std::vector<bool> shines_;  // of each cell
};

}  // namespace lucerna::bake
