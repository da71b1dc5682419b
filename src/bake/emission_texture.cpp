#include "bake/emission_texture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace lucerna::bake {
namespace {

// Of its colour, without alpha.
std::span<const std::byte> bytesAt(const Image& image, int x, int y) {
  const std::size_t size = bytesPer(image.type());
  const auto channels = static_cast<std::size_t>(image.channels());
  return image.bytes().subspan(
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
       static_cast<std::size_t>(x)) *
          channels * size,
      std::min<std::size_t>(channels, 3) * size);
}

bool isBlack(const Image& image, int x, int y) {
  return std::ranges::all_of(bytesAt(image, x, y), [](std::byte b) { return b == std::byte{0}; });
}

// Linear colour at the centres of the pixels.
Image linearOf(const scene::Texture& texture) {
  const int width = texture.image->width(), height = texture.image->height();
  Image linear(width, height, 3, ComponentType::F32);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
      const vec4 color = trace::colorAt(texture, uv);
      std::copy_n(&color.x, 3, linear.pixel<float>(x, y));
    }
  return linear;
}

Image halved(const Image& image) {
  Image half(image.width() / 2, image.height() / 2, 3, ComponentType::F32);
  for (int y = 0; y < half.height(); ++y)
    for (int x = 0; x < half.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0.f;
        for (const ivec2 p : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)})
          sum += image.pixel<float>(2 * x + p.x, 2 * y + p.y)[c];
        half.pixel<float>(x, y)[c] = 0.25f * sum;
      }
  return half;
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
  const auto add = [&](Image image) {
    levels_.push_back(texture);
    levels_.back().image = std::make_shared<Image>(std::move(image));
  };
  add(linearOf(texture));
  for (;;) {
    const Image& last = *levels_.back().image;
    if (last.width() % 2 != 0 || last.height() % 2 != 0) break;
    add(halved(last));
  }
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

bool EmissionTexture::isEven(vec2 minUv, vec2 maxUv) const {
  constexpr int kMost = 16;  // pixels along a side
  if (texture_.wrapS != scene::Wrap::Repeat || texture_.wrapT != scene::Wrap::Repeat) return false;
  if (!(glm::all(glm::lessThan(glm::abs(minUv), vec2(1e5f))) &&
        glm::all(glm::lessThan(glm::abs(maxUv), vec2(1e5f)))))
    return false;
  const Image& image = *texture_.image;
  const vec2 size(image.width(), image.height());
  const ivec2 first(glm::floor(minUv * size) - 1.f), last(glm::floor(maxUv * size) + 1.f);
  if (last.x - first.x > kMost || last.y - first.y > kMost) return false;
  const auto pixel = [&](int x, int y) {
    return bytesAt(image, wrapped(x, image.width()), wrapped(y, image.height()));
  };
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (!std::ranges::equal(pixel(x, y), pixel(first.x, first.y))) return false;
  return true;
}

}  // namespace lucerna::bake
