// Buffers and vertex inputs: move-only owners of GL objects, made by Device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lucerna::gpu {

class Device;

// Where a block that is a part of a buffer may begin, in bytes: the most that drivers ask for.
inline constexpr std::size_t kBlockAlignment = 256;

class Buffer {
 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    Buffer(std::move(other)).swap(*this);
    return *this;
  }
  ~Buffer();
  explicit operator bool() const { return id_ != 0; }
  std::size_t bytes() const { return bytes_; }
  std::uint32_t id() const { return id_; }

 private:
  friend class Device;
  void swap(Buffer& other) noexcept;
  Device* device_ = nullptr;
  std::uint32_t id_ = 0;
  std::size_t bytes_ = 0;
};

// One vertex attribute: `location` in the shader, read from `buffer`.
struct VertexAttribute {
  std::uint32_t location = 0;
  std::uint32_t buffer = 0;  // index in VertexInputDesc::buffers
  int components = 4;        // 1 to 4
  enum class Type : std::uint8_t {
    Float,
    Half,
    Unorm8,
    Snorm8,
    Unorm16,
    Snorm16,
    Uint32
  } type = Type::Float;
  std::uint32_t offset = 0;  // bytes
};
struct VertexBuffer {
  const Buffer* buffer = nullptr;
  std::uint32_t stride = 0;   // bytes
  std::uint32_t divisor = 0;  // 1: advances once an instance
};
struct VertexInputDesc {
  std::vector<VertexBuffer> buffers;
  std::vector<VertexAttribute> attributes;
  const Buffer* indices = nullptr;  // 32-bit; null: not indexed
};

class VertexInput {
 public:
  VertexInput() = default;
  VertexInput(VertexInput&& other) noexcept { swap(other); }
  VertexInput& operator=(VertexInput&& other) noexcept {
    VertexInput(std::move(other)).swap(*this);
    return *this;
  }
  ~VertexInput();
  explicit operator bool() const { return id_ != 0; }
  bool indexed() const { return indexed_; }
  std::uint32_t id() const { return id_; }

 private:
  friend class Device;
  void swap(VertexInput& other) noexcept;
  Device* device_ = nullptr;
  std::uint32_t id_ = 0;
  bool indexed_ = false;
};

// The layout of GL's DrawElementsIndirectCommand.
struct IndexedDrawCommand {
  std::uint32_t indexCount = 0;
  std::uint32_t instanceCount = 1;
  std::uint32_t firstIndex = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t baseInstance = 0;
};

}  // namespace lucerna::gpu
