// Textures made by code: tileable noise, and pictures and normal maps from functions of the place.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/math/math.hpp"
#include "core/parallel.hpp"
#include "image/image.hpp"

namespace lucerna::scene::builtin {

// A well mixed 32-bit hash of a lattice point.
inline std::uint32_t latticeHash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return h ^ (h >> 15);
}
inline float latticeValue(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  return static_cast<float>(latticeHash(x, y, seed) >> 8) * 0x1p-24f;
}

// Value noise in [0, 1] with `period` lattice cells across the unit square; tiles. p >= 0.
inline float noise(vec2 p, std::uint32_t period, std::uint32_t seed) {
  const vec2 q = p * static_cast<float>(period);
  const vec2 floor = glm::floor(q), f = q - floor;
  const vec2 w = f * f * (3.f - 2.f * f);
  const std::uint32_t x = static_cast<std::uint32_t>(floor.x) % period, x1 = (x + 1) % period;
  const std::uint32_t y = static_cast<std::uint32_t>(floor.y) % period, y1 = (y + 1) % period;
  const float low = glm::mix(latticeValue(x, y, seed), latticeValue(x1, y, seed), w.x);
  const float high = glm::mix(latticeValue(x, y1, seed), latticeValue(x1, y1, seed), w.x);
  return glm::mix(low, high, w.y);
}

// Sum of `octaves` noises of doubling frequency and halving strength, in [0, 1]; tiles.
inline float fractalNoise(vec2 p, std::uint32_t period, int octaves, std::uint32_t seed) {
  float sum = 0, weight = 0.5f, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * noise(p, period << i, seed + static_cast<std::uint32_t>(i));
    total += weight;
    weight *= 0.5f;
  }
  return sum / total;
}

inline std::uint8_t unormByte(float value) {
  return static_cast<std::uint8_t>(glm::clamp(value, 0.f, 1.f) * 255.f + 0.5f);
}

// An 8-bit RGBA image of width x height; color(p) gives its stored components in [0, 1] at the
// pixel centre p in [0, 1)^2, p.y growing downwards.
template <typename Color>
std::shared_ptr<const Image> paint(int width, int height, const Color& color) {
  auto image = std::make_shared<Image>(width, height, 4, ComponentType::U8);
  parallelFor(static_cast<std::size_t>(height), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      std::uint8_t* pixel = image->pixel<std::uint8_t>(0, static_cast<int>(y));
      for (int x = 0; x < width; ++x, pixel += 4) {
        const vec2 p((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                     (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
        const vec4 c = color(p);
        for (int i = 0; i < 4; ++i) pixel[i] = unormByte(c[i]);
      }
    }
  });
  return image;
}

// The direction of a place on a face of a cube map (scene::Texture::faces).
inline vec3 faceDirection(int face, vec2 p) {
  const float s = 2 * p.x - 1, t = 2 * p.y - 1;
  switch (face) {
    case 0:
      return glm::normalize(vec3(1, -t, s));
    case 1:
      return glm::normalize(vec3(-1, -t, -s));
    case 2:
      return glm::normalize(vec3(s, 1, -t));
    case 3:
      return glm::normalize(vec3(s, -1, t));
    case 4:
      return glm::normalize(vec3(-s, -t, 1));
    default:
      return glm::normalize(vec3(s, -t, -1));
  }
}

// The tangent-space normal map of a tileable relief: height(p) in metres on a tile of the given
// side length (m).
template <typename Height>
std::shared_ptr<const Image> paintNormals(int size, float metresPerTile, const Height& height) {
  const auto side = static_cast<std::size_t>(size);
  std::vector<float> heights(side * side);
  parallelFor(side, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      for (std::size_t x = 0; x < side; ++x)
        heights[y * side + x] = height((vec2(x, y) + 0.5f) / static_cast<float>(size));
  });
  const float scale = static_cast<float>(size) / (2 * metresPerTile);
  return paint(size, size, [&](vec2 p) {
    const auto x = static_cast<std::size_t>(p.x * static_cast<float>(size));
    const auto y = static_cast<std::size_t>(p.y * static_cast<float>(size));
    const std::size_t left = (x + side - 1) % side, right = (x + 1) % side;
    const std::size_t above = (y + side - 1) % side, below = (y + 1) % side;
    // The image's green axis points up, against growing p.y.
    const float dx = (heights[y * side + right] - heights[y * side + left]) * scale;
    const float dy = (heights[above * side + x] - heights[below * side + x]) * scale;
    return vec4(0.5f + 0.5f * glm::normalize(vec3(-dx, -dy, 1)), 1);
  });
}

}  // namespace lucerna::scene::builtin
