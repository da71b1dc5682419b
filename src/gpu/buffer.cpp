#include "gpu/buffer.hpp"

#include <algorithm>
#include <utility>

#include "gpu/device_impl.hpp"

namespace lucerna::gpu {

void Buffer::swap(Buffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(id_, other.id_);
  std::swap(bytes_, other.bytes_);
}

Buffer::~Buffer() {
  if (id_ == 0) return;
  glDeleteBuffers(1, &id_);
  ObjectCounts& objects = device_->impl().objects;
  --objects.buffers;
  objects.bufferBytes -= bytes_;
}

void VertexInput::swap(VertexInput& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(id_, other.id_);
  std::swap(indexed_, other.indexed_);
}

VertexInput::~VertexInput() {
  if (id_ == 0) return;
  glDeleteVertexArrays(1, &id_);
  --device_->impl().objects.vertexInputs;
}

Buffer Device::createBuffer(std::size_t bytes, std::string label) {
  Buffer buffer;
  buffer.device_ = this;
  buffer.bytes_ = std::max<std::size_t>(bytes, 4);  // GL has no empty buffers
  glCreateBuffers(1, &buffer.id_);
  glNamedBufferStorage(buffer.id_, static_cast<GLsizeiptr>(buffer.bytes_), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  impl_->setLabel(GL_BUFFER, buffer.id_, label);
  ++impl_->objects.buffers;
  impl_->objects.bufferBytes += buffer.bytes_;
  return buffer;
}

Buffer Device::createBuffer(std::span<const std::byte> data, std::string label) {
  Buffer buffer = createBuffer(data.size(), std::move(label));
  update(buffer, data);
  return buffer;
}

void Device::update(Buffer& buffer, std::span<const std::byte> data, std::size_t offset) {
  CHECK(buffer && offset + data.size() <= buffer.bytes(), "{} bytes at {} into a buffer of {}",
        data.size(), offset, buffer.bytes());
  if (data.empty()) return;
  glNamedBufferSubData(buffer.id(), static_cast<GLintptr>(offset),
                       static_cast<GLsizeiptr>(data.size()), data.data());
  impl_->counters.uploads += data.size();
}

void Device::write(Buffer& buffer, std::span<const std::byte> data, const std::string& label) {
  if (!buffer || buffer.bytes() < data.size())
    buffer = createBuffer(buffer ? data.size() + data.size() / 2 : data.size(), label);
  update(buffer, data);
}

std::vector<std::byte> Device::download(const Buffer& buffer) {
  std::vector<std::byte> data(buffer.bytes());
  glGetNamedBufferSubData(buffer.id(), 0, static_cast<GLsizeiptr>(data.size()), data.data());
  return data;
}

namespace {

void setAttribute(GLuint input, const VertexAttribute& attribute) {
  using Type = VertexAttribute::Type;
  const auto format = [&](GLenum type, GLboolean normalized) {
    glVertexArrayAttribFormat(input, attribute.location, attribute.components, type, normalized,
                              attribute.offset);
  };
  switch (attribute.type) {
    case Type::Float:
      format(GL_FLOAT, GL_FALSE);
      break;
    case Type::Half:
      format(GL_HALF_FLOAT, GL_FALSE);
      break;
    case Type::Unorm8:
      format(GL_UNSIGNED_BYTE, GL_TRUE);
      break;
    case Type::Snorm8:
      format(GL_BYTE, GL_TRUE);
      break;
    case Type::Unorm16:
      format(GL_UNSIGNED_SHORT, GL_TRUE);
      break;
    case Type::Snorm16:
      format(GL_SHORT, GL_TRUE);
      break;
    case Type::Uint32:
      glVertexArrayAttribIFormat(input, attribute.location, attribute.components, GL_UNSIGNED_INT,
                                 attribute.offset);
      break;
  }
  glVertexArrayAttribBinding(input, attribute.location, attribute.buffer);
  glEnableVertexArrayAttrib(input, attribute.location);
}

}  // namespace

VertexInput Device::createVertexInput(const VertexInputDesc& desc, std::string label) {
  VertexInput input;
  input.device_ = this;
  input.indexed_ = desc.indices != nullptr;
  glCreateVertexArrays(1, &input.id_);
  for (GLuint i = 0; i < desc.buffers.size(); ++i) {
    const VertexBuffer& source = desc.buffers[i];
    CHECK(source.buffer && *source.buffer, "vertex input '{}': buffer {} is empty", label, i);
    glVertexArrayVertexBuffer(input.id_, i, source.buffer->id(), 0,
                              static_cast<GLsizei>(source.stride));
    glVertexArrayBindingDivisor(input.id_, i, source.divisor);
  }
  for (const VertexAttribute& attribute : desc.attributes) {
    CHECK(attribute.buffer < desc.buffers.size(), "vertex input '{}': no buffer {}", label,
          attribute.buffer);
    setAttribute(input.id_, attribute);
  }
  if (desc.indices) glVertexArrayElementBuffer(input.id_, desc.indices->id());
  impl_->setLabel(GL_VERTEX_ARRAY, input.id_, label);
  ++impl_->objects.vertexInputs;
  return input;
}

}  // namespace lucerna::gpu
