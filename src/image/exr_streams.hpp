// OpenEXR streams over memory.
#pragma once

#include <ImfIO.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "image/codec.hpp"

namespace lucerna::codec {

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(ByteView bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    const auto wanted = static_cast<std::uint64_t>(count);
    if (count < 0 || at_ > bytes_.size() || wanted > bytes_.size() - at_)
      throw std::runtime_error("the data end too early");
    std::memcpy(to, bytes_.data() + at_, wanted);
    at_ += wanted;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  ByteView bytes_;
  std::uint64_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(const std::string& name) : OStream(name.c_str()) {}

  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, from, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  Bytes takeBytes() { return std::move(bytes_); }

 private:
  Bytes bytes_;
  std::uint64_t at_ = 0;
};

}  // namespace lucerna::codec
