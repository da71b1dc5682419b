#include "bake/emission_texture.hpp"

#include <algorithm>
#include <cmath>

#include "trace/texture_reader.hpp"

namespace lucerna::bake {
namespace {

bool isBlack(const Image& image, int x, int y) {
  const int channels = std::min(image.channels(), 3);
  const std::size_t size = bytesPer(image.type());
  const std::byte* pixel =
      image.bytes().data() +
      (static_cast<std::size_t>(y) * image.width() + x) * image.channels() * size;
  for (std::size_t i = 0; i < static_cast<std::size_t>(channels) * size; ++i)
    if (pixel[i] != std::byte{0}) return false;
  return true;
}

int wrapped(int value, int count) {
  const int rest = value % count;
  return rest < 0 ? rest + count : rest;
}

}  // namespace

EmissionTexture::EmissionTexture(const scene::Texture& texture)
    : texture_(texture),
      width_((texture.image->width() + kCell - 1) / kCell),
      height_((texture.image->height() + kCell - 1) / kCell),
      shines_(static_cast<std::size_t>(width_) * height_) {
  for (int y = 0; y < texture.image->height(); ++y)
    for (int x = 0; x < texture.image->width(); ++x)
      if (!isBlack(*texture.image, x, y))
        shines_[static_cast<std::size_t>(y / kCell) * width_ + x / kCell] = true;
}

vec3 EmissionTexture::at(vec2 uv) const {
  return vec3(trace::colorAt(texture_, uv));
}

bool EmissionTexture::shines(vec2 minUv, vec2 maxUv) const {
  // Mirrored and clamped pictures are not worth the trouble.
  if (texture_.wrapS != scene::Wrap::Repeat || texture_.wrapT != scene::Wrap::Repeat) return true;
  const Image& image = *texture_.image;
  const vec2 size(image.width(), image.height());
  if (!(glm::all(glm::lessThan(glm::abs(minUv), vec2(1e5f))) &&
        glm::all(glm::lessThan(glm::abs(maxUv), vec2(1e5f)))))
    return true;
  // A pixel to each side for the filter.
  const ivec2 first(glm::floor(minUv * size) - 1.f), last(glm::floor(maxUv * size) + 1.f);
  if (last.x - first.x >= image.width() || last.y - first.y >= image.height()) {
    for (const bool cell : shines_)
      if (cell) return true;
    return false;
  }
  // Steps as long as the narrowest cell meet every cell on the way, the last one too.
  const auto step = [](int side) { return side % kCell == 0 ? kCell : side % kCell; };
  for (int y = first.y;; y = std::min(y + step(image.height()), last.y)) {
    for (int x = first.x;; x = std::min(x + step(image.width()), last.x)) {
      if (shines_[static_cast<std::size_t>(wrapped(y, image.height()) / kCell) * width_ +
                  wrapped(x, image.width()) / kCell])
        return true;
      if (x == last.x) break;
    }
    if (y == last.y) break;
  }
  return false;
}

}  // namespace lucerna::bake
