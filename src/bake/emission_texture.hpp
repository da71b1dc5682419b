// Where an emission texture shines at all: most of a facade is dark, and is passed over by this.
#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "trace/texture_reader.hpp"

namespace lucerna::bake {

class EmissionTexture {
 public:
  explicit EmissionTexture(const scene::Texture& texture);
  // Linear colour, filtered; in level 0, the picture, or when it is halved as many times.
  vec3 at(vec2 uv, int level) const {
    return vec3(trace::colorAt(levels_[static_cast<std::size_t>(level)], uv));
  }
  // Halved as long as both sides are even: no pixel counts more than another.
  int levels() const { return static_cast<int>(levels_.size()); }
  // False only if it is black wherever bilinear filtering looks within the box.
  bool shines(vec2 minUv, vec2 maxUv) const;
  // True only if it is of one colour wherever bilinear filtering looks within the box, and the box
  // has few pixels.
  bool isEven(vec2 minUv, vec2 maxUv) const;

 private:
  static constexpr int kCell = 16;  // pixels
  const scene::Texture& texture_;
  std::vector<scene::Texture> levels_;
  int width_, height_;        // cells
  std::vector<bool> shines_;  // of each cell
};

}  // namespace lucerna::bake
