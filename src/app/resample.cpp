#include "app/resample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"

namespace lucerna::app {
namespace {

struct Taps {
  int first = 0;
  std::vector<float> weights;  // sum 1
};

// For each of `to` pixels, which of `from` pixels it averages.
std::vector<Taps> tentTaps(int from, int to) {
  const float scale = static_cast<float>(from) / static_cast<float>(to);
  const float radius = std::max(scale, 1.f);
  std::vector<Taps> result(to);
  for (int i = 0; i < to; ++i) {
    const float center = (static_cast<float>(i) + 0.5f) * scale;  // pixel centres at k + 0.5
    const int first = std::max(0, static_cast<int>(std::floor(center - radius)));
    const int last = std::min(from - 1, static_cast<int>(std::ceil(center + radius)));
    Taps& taps = result[i];
    taps.first = first;
    float sum = 0.f;
    for (int k = first; k <= last; ++k) {
      const float distance = std::abs(static_cast<float>(k) + 0.5f - center);
      taps.weights.push_back(std::max(0.f, 1.f - distance / radius));
      sum += taps.weights.back();
    }
    for (float& weight : taps.weights) weight /= sum;
  }
  return result;
}

bool hasSize(const Image& image, uvec2 size) {
  return uvec2(image.width(), image.height()) == size;
}

}  // namespace

Image resizedLinear(Image image, uvec2 size) {
  CHECK(image.type() == ComponentType::F32);
  if (hasSize(image, size)) return image;
  const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
  const int channels = image.channels();
  const std::vector<Taps> columns = tentTaps(image.width(), width);
  const std::vector<Taps> rows = tentTaps(image.height(), height);

  Image wide(width, image.height(), channels, ComponentType::F32);
  parallelFor(image.height(), 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < width; ++x)
        for (std::size_t k = 0; k < columns[x].weights.size(); ++k) {
          const float* from = image.pixel<float>(columns[x].first + static_cast<int>(k), y);
          float* to = wide.pixel<float>(x, y);
          for (int c = 0; c < channels; ++c) to[c] += columns[x].weights[k] * from[c];
        }
  });
  Image result(width, height, channels, ComponentType::F32);
  parallelFor(height, 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (std::size_t k = 0; k < rows[y].weights.size(); ++k) {
        const float* from = wide.pixel<float>(0, rows[y].first + static_cast<int>(k));
        float* to = result.pixel<float>(0, y);
        for (int i = 0; i < width * channels; ++i) to[i] += rows[y].weights[k] * from[i];
      }
  });
  return result;
}

Image resizedNearest(Image image, uvec2 size) {
  CHECK(image.type() == ComponentType::F32);
  if (hasSize(image, size)) return image;
  Image result(static_cast<int>(size.x), static_cast<int>(size.y), image.channels(),
               ComponentType::F32);
  const auto nearest = [](int i, int from, int to) {
    return static_cast<int>((2 * static_cast<std::int64_t>(i) + 1) * from / (2 * to));
  };
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x)
      std::copy_n(image.pixel<float>(nearest(x, image.width(), result.width()),
                                     nearest(y, image.height(), result.height())),
                  image.channels(), result.pixel<float>(x, y));
  return result;
}

Image resizedSrgb(Image image, uvec2 size) {
  CHECK(image.type() == ComponentType::U8);
  if (hasSize(image, size)) return image;
  std::array<float, 256> linear;
  for (int i = 0; i < 256; ++i) linear[i] = linearFromSrgb(static_cast<float>(i) / 255.f);
  const auto isAlpha = [&](std::size_t i) {
    return image.channels() % 2 == 0 &&
           i % image.channels() == static_cast<std::size_t>(image.channels()) - 1;
  };
  Image light(image.width(), image.height(), image.channels(), ComponentType::F32);
  const auto source = image.as<std::uint8_t>();
  const auto values = light.as<float>();
  for (std::size_t i = 0; i < source.size(); ++i)
    values[i] = isAlpha(i) ? static_cast<float>(source[i]) / 255.f : linear[source[i]];

  const Image resized = resizedLinear(std::move(light), size);
  Image result(resized.width(), resized.height(), resized.channels(), ComponentType::U8);
  const auto from = resized.as<float>();
  const auto to = result.as<std::uint8_t>();
  for (std::size_t i = 0; i < from.size(); ++i) {
    const float value = isAlpha(i) ? from[i] : srgbFromLinear(from[i]);
    to[i] = static_cast<std::uint8_t>(std::lround(255.f * std::clamp(value, 0.f, 1.f)));
  }
  return result;
}

}  // namespace lucerna::app
