#include "image/image.hpp"

#include <ImathConfig.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/parallel.hpp"

namespace lucerna {
namespace {

constexpr std::size_t kConversionGrain = 1 << 16;  // components a block

// The component types as C++ types; Half needs one of its own beside std::uint16_t.
struct HalfBits {
  std::uint16_t bits;
};

template <typename Visit>
void withComponent(ComponentType type, Visit visit) {
  switch (type) {
    case ComponentType::U8:
      return visit(std::uint8_t{});
    case ComponentType::U16:
      return visit(std::uint16_t{});
    case ComponentType::Half:
      return visit(HalfBits{});
    case ComponentType::F32:
      return visit(float{});
  }
}

float toFloat(std::uint8_t v) {
  return static_cast<float>(v) / 255.f;
}
float toFloat(std::uint16_t v) {
  return static_cast<float>(v) / 65535.f;
}
float toFloat(HalfBits v) {
  return floatFromHalf(v.bits);
}
float toFloat(float v) {
  return v;
}

// Clamps to [0, 1] and rounds to nearest; NaN becomes 0.
template <typename T>
T unorm(float v, float largest) {
  const float clamped = v > 0 ? std::min(v, 1.f) : 0.f;
  return static_cast<T>(clamped * largest + 0.5f);
}
void fromFloat(float v, std::uint8_t& to) {
  to = unorm<std::uint8_t>(v, 255.f);
}
void fromFloat(float v, std::uint16_t& to) {
  to = unorm<std::uint16_t>(v, 65535.f);
}
void fromFloat(float v, HalfBits& to) {
  to.bits = halfFromFloat(v);
}
void fromFloat(float v, float& to) {
  to = v;
}

template <typename From, typename To>
void convertComponents(const Image& from, Image& to) {
  const auto* source = reinterpret_cast<const From*>(from.bytes().data());
  auto* target = reinterpret_cast<To*>(to.bytes().data());
  const std::size_t count = from.bytes().size() / sizeof(From);
  parallelFor(count, kConversionGrain, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fromFloat(toFloat(source[i]), target[i]);
  });
}

Image withType(const Image& image, ComponentType type) {
  Image result(image.width(), image.height(), image.channels(), type);
  withComponent(image.type(), [&](auto from) {
    withComponent(type,
                  [&](auto to) { convertComponents<decltype(from), decltype(to)>(image, result); });
  });
  return result;
}

// Which channel of the source gives channel `to`; -1 is opaque alpha.
int sourceChannel(int to, int fromChannels, int toChannels) {
  const bool toAlpha = (toChannels == 2 || toChannels == 4) && to == toChannels - 1;
  const bool fromHasAlpha = fromChannels == 2 || fromChannels == 4;
  if (toAlpha) return fromHasAlpha ? fromChannels - 1 : -1;
  return fromChannels >= 3 ? to : 0;
}

template <typename T>
void remapChannels(const Image& from, Image& to, T one) {
  int map[4] = {};
  for (int c = 0; c < to.channels(); ++c) map[c] = sourceChannel(c, from.channels(), to.channels());
  const auto* source = reinterpret_cast<const T*>(from.bytes().data());
  auto* target = reinterpret_cast<T*>(to.bytes().data());
  const int fromChannels = from.channels(), toChannels = to.channels();
  const std::size_t pixels = static_cast<std::size_t>(from.width()) * from.height();
  parallelFor(pixels, kConversionGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int c = 0; c < toChannels; ++c)
        target[i * toChannels + c] = map[c] < 0 ? one : source[i * fromChannels + map[c]];
  });
}

Image withChannels(const Image& image, int channels) {
  Image result(image.width(), image.height(), channels, image.type());
  withComponent(image.type(), [&](auto component) {
    decltype(component) one;
    fromFloat(1.f, one);
    remapChannels(image, result, one);
  });
  return result;
}

}  // namespace

Image::Image(int width, int height, int channels, ComponentType type)
    : width_(width), height_(height), channels_(channels), type_(type) {
  CHECK(width > 0 && height > 0, "an image of {}x{}", width, height);
  CHECK(channels >= 1 && channels <= 4, "an image of {} channels", channels);
  data_.resize(rowBytes() * static_cast<std::size_t>(height));
}

Image converted(const Image& image, ComponentType type, int channels) {
  if (image.empty()) return image;
  // Fewer channels first and more channels last: the conversion in between then has least to do.
  if (channels == image.channels()) return type == image.type() ? image : withType(image, type);
  if (type == image.type()) return withChannels(image, channels);
  return channels < image.channels() ? withType(withChannels(image, channels), type)
                                     : withChannels(withType(image, type), channels);
}

Image flippedVertically(const Image& image) {
  Image result = image;
  const std::size_t row = image.rowBytes();
  for (int y = 0; y < image.height(); ++y)
    std::memcpy(result.bytes().data() + static_cast<std::size_t>(y) * row,
                image.bytes().data() + static_cast<std::size_t>(image.height() - 1 - y) * row, row);
  return result;
}

// IEC 61966-2-1.
float srgbFromLinear(float linear) {
  const float v = linear > 0 ? std::min(linear, 1.f) : 0.f;
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

float linearFromSrgb(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

std::uint16_t halfFromFloat(float value) {
  return imath_float_to_half(value);
}
float floatFromHalf(std::uint16_t bits) {
  return imath_half_to_float(bits);
}

}  // namespace lucerna
