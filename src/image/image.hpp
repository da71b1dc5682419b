// A picture in memory. Rows run from top to bottom, pixels are interleaved, no padding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/check.hpp"

namespace lucerna {

enum class ComponentType { U8, U16, Half, F32 };

constexpr std::size_t bytesPer(ComponentType type) {
  return type == ComponentType::U8 ? 1 : type == ComponentType::F32 ? 4 : 2;
}

class Image {
 public:
  Image() = default;
  // channels: 1 to 4. Zero-filled.
  Image(int width, int height, int channels, ComponentType type);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  ComponentType type() const { return type_; }
  bool empty() const { return data_.empty(); }
  std::size_t rowBytes() const {
    return static_cast<std::size_t>(width_) * channels_ * bytesPer(type_);
  }

  std::span<std::byte> bytes() { return data_; }
  std::span<const std::byte> bytes() const { return data_; }

  // T must match type(): std::uint8_t, std::uint16_t (U16 and Half bits), float.
  template <typename T>
  std::span<T> as() {
    CHECK(sizeof(T) == bytesPer(type_));
    return {reinterpret_cast<T*>(data_.data()), data_.size() / sizeof(T)};
  }
  template <typename T>
  std::span<const T> as() const {
    CHECK(sizeof(T) == bytesPer(type_));
    return {reinterpret_cast<const T*>(data_.data()), data_.size() / sizeof(T)};
  }
  // The first component of pixel (x, y); y counts from the top.
  template <typename T>
  T* pixel(int x, int y) {
    return as<T>().data() + (static_cast<std::size_t>(y) * width_ + x) * channels_;
  }
  template <typename T>
  const T* pixel(int x, int y) const {
    return as<T>().data() + (static_cast<std::size_t>(y) * width_ + x) * channels_;
  }

 private:
  int width_ = 0, height_ = 0, channels_ = 0;
  ComponentType type_ = ComponentType::U8;
  std::vector<std::byte> data_;
};

// Converts component type and channel count. U8/U16 are unorm; no colour-space change. 1 and 2
// channels are grey and grey with alpha, 3 and 4 colour and colour with alpha: a missing alpha
// becomes 1, grey is copied to the colours, colour becomes grey by taking red.
Image converted(const Image& image, ComponentType type, int channels);
Image flippedVertically(const Image& image);
float srgbFromLinear(float linear);  // clamps to [0, 1]
float linearFromSrgb(float srgb);
inline constexpr float kLargestHalf = 65504.f;
std::uint16_t halfFromFloat(float value);
float floatFromHalf(std::uint16_t bits);

}  // namespace lucerna
