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

// Of the 8-bit pictures that most are.
const std::array<float, 256>& linearOf8Bits() {
  static const auto table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = linearFromSrgb(static_cast<float>(i) / 255.f);
    return values;
  }();
  return table;
}

float linear(const Image& image, std::size_t index) {
  if (image.type() == ComponentType::U8) return linearOf8Bits()[image.as<std::uint8_t>()[index]];
  const float value = stored(image, index);
  return image.type() == ComponentType::U16 ? linearFromSrgb(value) : value;
}

std::size_t firstOf(const Image& image, ivec2 at) {
  return (static_cast<std::size_t>(at.y) * image.width() + at.x) *
         static_cast<std::size_t>(image.channels());
}

// 1 and 2 channels are grey and grey with alpha (image/image.hpp).
bool hasAlpha(const Image& image) {
  return image.channels() == 2 || image.channels() == 4;
}

float alphaOf(const Image& image, ivec2 at) {
  return stored(image, firstOf(image, at) + static_cast<std::size_t>(image.channels()) - 1);
}

vec4 texel(const Image& image, ivec2 at, bool color) {
  const std::size_t first = firstOf(image, at);
  vec4 value(0.f, 0.f, 0.f, 1.f);
  for (int c = 0; c < 3; ++c) {
    const std::size_t index = first + (image.channels() >= 3 ? static_cast<std::size_t>(c) : 0);
    value[c] = color ? linear(image, index) : stored(image, index);
  }
  if (hasAlpha(image)) value.w = alphaOf(image, at);
  return value;
}

int wrapped(int i, int size, scene::Wrap wrap) {
  if (i >= 0 && i < size) return i;
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

// read: of a texel of the picture.
template <typename Read>
auto sample(const Image& image, vec2 uv, scene::Wrap wrapS, scene::Wrap wrapT, bool nearest,
            Read read) {
  const ivec2 size(image.width(), image.height());
  const vec2 place = held(uv) * vec2(size);
  const vec2 corner = glm::floor(nearest ? place : place - 0.5f);
  const ivec2 p(corner);
  const int left = wrapped(p.x, size.x, wrapS), top = wrapped(p.y, size.y, wrapT);
  if (nearest) return read(ivec2(left, top));
  const int right = wrapped(p.x + 1, size.x, wrapS), bottom = wrapped(p.y + 1, size.y, wrapT);
  const vec2 share = place - 0.5f - corner;
  return glm::mix(glm::mix(read({left, top}), read({right, top}), share.x),
                  glm::mix(read({left, bottom}), read({right, bottom}), share.x), share.y);
}

vec4 sampleTexels(const Image& image, vec2 uv, scene::Wrap wrapS, scene::Wrap wrapT, bool nearest,
                  bool color) {
  return sample(image, uv, wrapS, wrapT, nearest,
                [&](ivec2 at) { return texel(image, at, color); });
}

}  // namespace

vec4 colorAt(const scene::Texture& texture, vec2 uv) {
  const Image& image = *texture.image;
  const auto channels = static_cast<std::size_t>(image.channels());
  const auto at = [&](auto read) {
    return sample(image, uv, texture.wrapS, texture.wrapT, texture.nearest, read);
  };
  // As texel(), in less time.
  if (image.type() == ComponentType::U8 && channels >= 3) {
    const std::uint8_t* all = image.as<std::uint8_t>().data();
    const std::array<float, 256>& table = linearOf8Bits();
    return at([&](ivec2 p) {
      const std::uint8_t* c = all + firstOf(image, p);
      return vec4(table[c[0]], table[c[1]], table[c[2]],
                  channels == 4 ? static_cast<float>(c[3]) / 255.f : 1.f);
    });
  }
  if (image.type() == ComponentType::F32 && channels >= 3) {
    const float* all = image.as<float>().data();
    return at([&](ivec2 p) {
      const float* c = all + firstOf(image, p);
      return vec4(c[0], c[1], c[2], channels == 4 ? c[3] : 1.f);
    });
  }
  return at([&](ivec2 p) { return texel(image, p, true); });
}

vec4 dataAt(const scene::Texture& texture, vec2 uv) {
  return sampleTexels(*texture.image, uv, texture.wrapS, texture.wrapT, texture.nearest, false);
}

float alphaAt(const scene::Texture& texture, vec2 uv) {
  const Image& image = *texture.image;
  if (!hasAlpha(image)) return 1.f;
  const auto channels = static_cast<std::size_t>(image.channels());
  if (image.type() == ComponentType::U8) {  // as alphaOf(), in less time
    const std::uint8_t* alphas = image.as<std::uint8_t>().data() + channels - 1;
    const auto width = static_cast<std::size_t>(image.width());
    return sample(image, uv, texture.wrapS, texture.wrapT, texture.nearest, [&](ivec2 at) {
      return static_cast<float>(
                 alphas[(static_cast<std::size_t>(at.y) * width + static_cast<std::size_t>(at.x)) *
                        channels]) /
             255.f;
    });
  }
  return sample(image, uv, texture.wrapS, texture.wrapT, texture.nearest,
                [&](ivec2 at) { return alphaOf(image, at); });
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
  return sampleTexels(*texture.faces[static_cast<std::size_t>(index)],
                      vec2(0.5f + 0.5f * ndc.x, 0.5f - 0.5f * ndc.y), scene::Wrap::ClampToEdge,
                      scene::Wrap::ClampToEdge, texture.nearest, true);
}

}  // namespace lucerna::trace
