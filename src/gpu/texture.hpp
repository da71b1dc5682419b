// Textures and samplers: move-only owners of GL objects, made by Device.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/math/math.hpp"
#include "gpu/format.hpp"

namespace lucerna::gpu {

class Device;

enum class TextureKind : std::uint8_t { Plain2D, Array2D, Cube, CubeArray, Multisample2D };

struct TextureDesc {
  TextureKind kind = TextureKind::Plain2D;
  Format format = Format::Rgba8Unorm;
  int width = 1, height = 1;
  int layers = 1;  // Array2D: layers; Cube: 6; CubeArray: 6 n
  int levels = 1;  // 0: all mip levels (a texture made so has their number in its desc)
  int samples = 1;
  bool operator==(const TextureDesc&) const = default;
  std::uint64_t bytes() const;  // of all levels, layers and samples, counted by us
};

// What createTexture() throws where the driver has no memory left: unlike other errors it can
// happen at any texture, and nobody below main() can do anything about it. what() is a whole
// sentence, which ends with what a user may do.
class OutOfMemory : public std::runtime_error {
 public:
  OutOfMemory(const std::string& label, const TextureDesc& desc, std::string_view remedy);
};
inline constexpr std::string_view kRenderSmaller =
    "render smaller (--size, --scale) or close other programs";

class Texture {
 public:
  Texture() = default;
  Texture(Texture&& other) noexcept { swap(other); }
  Texture& operator=(Texture&& other) noexcept {
    Texture(std::move(other)).swap(*this);
    return *this;
  }
  ~Texture();

  explicit operator bool() const { return id_ != 0; }
  const TextureDesc& desc() const { return desc_; }
  int width() const { return desc_.width; }
  int height() const { return desc_.height; }
  Format format() const { return desc_.format; }
  const std::string& label() const { return label_; }
  std::uint32_t id() const { return id_; }  // the GL name, for debugging tools and UI glue

 private:
  friend class Device;
  void swap(Texture& other) noexcept;
  Device* device_ = nullptr;
  std::uint32_t id_ = 0;
  TextureDesc desc_;
  std::string label_;
};

enum class Filter : std::uint8_t {
  Nearest,
  Linear,
  Trilinear
};  // Trilinear: mipmapped, 4x anisotropic on GPUs
enum class Address : std::uint8_t { Repeat, MirroredRepeat, ClampToEdge, ClampToBorder };

// Samplers are values; the Device keeps one GL object per distinct value.
struct Sampler {
  Filter filter = Filter::Linear;
  bool magnifyNearest = false;
  Address u = Address::ClampToEdge, v = Address::ClampToEdge;
  bool compareGreaterEqual = false;  // depth comparison for shadow sampling with reversed depth
  vec4 border{0.f};
  bool operator==(const Sampler&) const = default;
};
inline constexpr Sampler kNearest{.filter = Filter::Nearest};
inline constexpr Sampler kLinear{.filter = Filter::Linear};

}  // namespace lucerna::gpu
