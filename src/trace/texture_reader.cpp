#include "trace/texture_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lucerna::trace {
namespace {

float stored(const Image& image, std::size_t index) {
  switch (image.type()) {
    case ComponentType::U8:
      return static_cast<float>(image.as<std::uint8_t>()[index]) / 255.f;
    case ComponentType::U16:
      return static_cast<float>(image.as<std::uint16_t>()[index]) / 65535.f;
    case ComponentType::Half:
      return floatFromHalf(image.as<std::uint16_t>()[index]);
    case ComponentType::F32:
      return image.as<float>()[index];
  }
  return 0.f;
}

// A table for the 8-bit pictures that most are.
float linear(const Image& image, std::size_t index) {
  static const auto table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = linearFromSrgb(static_cast<float>(i) / 255.f);
    return values;
  }();
  if (image.type() == ComponentType::U8) return table[image.as<std::uint8_t>()[index]];
  const float value = stored(image, index);
  return image.type() == ComponentType::U16 ? linearFromSrgb(value) : value;
}

// 1 and 2 channels are grey and grey with alpha (image/image.hpp).
vec4 texel(const Image& image, ivec2 at, bool color) {
  const int channels = image.channels();
  const std::size_t first =
      (static_cast<std::size_t>(at.y) * image.width() + at.x) * static_cast<std::size_t>(channels);
  vec4 value(0.f, 0.f, 0.f, 1.f);
  for (int c = 0; c < 3; ++c) {
    const std::size_t index = first + (channels >= 3 ? static_cast<std::size_t>(c) : 0);
    value[c] = color ? linear(image, index) : stored(image, index);
  }
  if (channels == 2 || channels == 4) value.w = stored(image, first + channels - 1);
  return value;
}

int wrapped(int i, int size, scene::Wrap wrap) {
  if (wrap == scene::Wrap::ClampToEdge) return std::clamp(i, 0, size - 1);
  const int period = wrap == scene::Wrap::Repeat ? size : 2 * size;
  const int within = ((i % period) + period) % period;
  return within < size ? within : period - 1 - within;
}

// Coordinates that a picture can be read at: far away all texels are as good.
vec2 held(vec2 uv) {
  for (int axis = 0; axis < 2; ++axis)
    uv[axis] = std::isfinite(uv[axis]) ? std::clamp(uv[axis], -1e5f, 1e5f) : 0.f;
  return uv;
}

vec4 sample(const Image& image, vec2 uv, scene::Wrap wrapS, scene::Wrap wrapT, bool nearest,
            bool color) {
  const ivec2 size(image.width(), image.height());
  const auto at = [&](ivec2 p) {
    return texel(image, {wrapped(p.x, size.x, wrapS), wrapped(p.y, size.y, wrapT)}, color);
  };
  const vec2 place = held(uv) * vec2(size);
  if (nearest) return at(ivec2(glm::floor(place)));
  const vec2 corner = glm::floor(place - 0.5f);
  const vec2 share = place - 0.5f - corner;
  const ivec2 p(corner);
  return glm::mix(glm::mix(at(p), at(p + ivec2(1, 0)), share.x),
                  glm::mix(at(p + ivec2(0, 1)), at(p + ivec2(1, 1)), share.x), share.y);
}

}  // namespace

vec4 colorAt(const scene::Texture& texture, vec2 uv) {
  return sample(*texture.image, uv, texture.wrapS, texture.wrapT, texture.nearest, true);
}

vec4 dataAt(const scene::Texture& texture, vec2 uv) {
  return sample(*texture.image, uv, texture.wrapS, texture.wrapT, texture.nearest, false);
}

// Each face is what a camera at the origin sees along its axis: right and up of that camera.
vec4 cubeColorAt(const scene::Texture& texture, vec3 d) {
  struct Face {
    vec3 forward, right, up;
  };
  static const std::array<Face, 6> faces{{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                          {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                          {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                          {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                          {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
                                          {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}};
  const vec3 size = glm::abs(d);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int index = 2 * axis + (d[axis] < 0.f ? 1 : 0);
  const Face& face = faces[static_cast<std::size_t>(index)];
  const float ahead = std::max(glm::dot(d, face.forward), 1e-30f);
  const vec2 ndc(glm::dot(d, face.right) / ahead, glm::dot(d, face.up) / ahead);
  return sample(*texture.faces[static_cast<std::size_t>(index)],
                vec2(0.5f + 0.5f * ndc.x, 0.5f - 0.5f * ndc.y), scene::Wrap::ClampToEdge,
                scene::Wrap::ClampToEdge, texture.nearest, true);
}

}  // namespace lucerna::trace
