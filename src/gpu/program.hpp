// Shader programs: made from paths and defines by Device::program(), cached by both.
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/math/math.hpp"

namespace lucerna::gpu {

class Device;
struct Uniform;

struct ProgramDesc {
  std::string vertex{}, fragment{};  // paths relative to src/; or
  std::string compute{};
  std::map<std::string, std::string> defines{};
  bool operator<(const ProgramDesc& other) const {
    return std::tie(vertex, fragment, compute, defines) <
           std::tie(other.vertex, other.fragment, other.compute, other.defines);
  }
};

// One thing that a program reads. type: as GLSL spells it ("vec3", "sampler2D"), "block" for
// uniform and storage blocks, "other" for types that have no place here.
struct ProgramInput {
  std::string name, type;
};

// Uniforms by name; a name the program does not use is ignored (the compiler may drop it), a wrong
// type asserts. Values stay with the program, except over a reload: set them before each use.
// Textures and blocks are bound by name at the draw.
class Program {
 public:
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // False if it never compiled: draws with it do nothing, and Device::takeErrors() has the reason.
  bool usable() const { return id_ != 0; }
  const ProgramDesc& desc() const { return desc_; }
  // What the linked program reads, for whoever binds by names that are data; empty if unusable.
  const std::vector<ProgramInput>& inputs() const;
  // Whether the file went into it, itself or by #include.
  bool includes(std::string_view file) const;

  // Floats and vectors (no arrays) are again what the shader initialises them with.
  void reset() const;

  void set(std::string_view name, float value) const;
  void set(std::string_view name, int value) const;
  // Only bool itself: arrays would otherwise decay to it.
  void set(std::string_view name, std::same_as<bool> auto value) const { setBool(name, value); }
  void set(std::string_view name, std::uint32_t value) const;
  void set(std::string_view name, vec2 value) const;
  void set(std::string_view name, vec3 value) const;
  void set(std::string_view name, vec4 value) const;
  void set(std::string_view name, ivec2 value) const;
  void set(std::string_view name, const mat3& value) const;
  void set(std::string_view name, const mat4& value) const;
  void set(std::string_view name, std::span<const float> values) const;
  void set(std::string_view name, std::span<const vec3> values) const;
  void set(std::string_view name, std::span<const vec4> values) const;

 private:
  void setBool(std::string_view name, bool value) const;
  friend class Device;  // its Impl included
  friend struct Reflector;
  Program();
  struct Reflection;
  const Uniform* find(std::string_view name) const;
  ProgramDesc desc_;
  Device* device_ = nullptr;
  std::uint32_t id_ = 0;
  std::unique_ptr<Reflection> reflection_;
};
using ProgramPtr = std::shared_ptr<const Program>;

}  // namespace lucerna::gpu
