// Values as bytes and back, in this machine's order: what a program and its own child tell each
// other. ByteWriter and ByteReader understand the same calls, so that a struct's members need to be
// listed once, in a function that takes either.
//
// What is read is untrusted all the same: a count is checked against the bytes that are there
// before anything is allocated.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/file.hpp"

namespace lucerna {

template <typename T>
concept RawBytes =
    std::is_trivially_copyable_v<T> && (!std::is_enum_v<T> || std::is_same_v<T, std::byte>) &&
    !std::is_same_v<T, bool> && !std::is_pointer_v<T>;

class ByteWriter {
 public:
  Bytes bytes;

  template <RawBytes T>
  void operator()(const T& value) {
    append(&value, sizeof value);
  }
  void operator()(const bool& value) { (*this)(static_cast<std::uint8_t>(value)); }
  template <typename E>
  void choice(const E& value, int) {
    (*this)(static_cast<std::uint8_t>(value));
  }
  void operator()(const std::string& text) { block(text); }
  template <RawBytes T>
  void operator()(const std::vector<T>& values) {
    block(values);
  }
  template <RawBytes T>
  void operator()(std::span<const T> values) {
    block(values);
  }
  template <typename T, typename Fields>
  void list(const std::vector<T>& values, Fields fields) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) fields(*this, value);
  }
  template <RawBytes T>
  void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }

 private:
  template <typename Container>
  void block(const Container& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(values[0]));
  }
  void append(const void* data, std::size_t size) {
    const auto* from = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), from, from + size);
  }
};

// After the first fault every call leaves its value alone.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  bool good() const { return good_; }
  bool atEnd() const { return rest_.empty(); }

  template <RawBytes T>
  void operator()(T& value) {
    take(&value, sizeof value);
  }
  void operator()(bool& value) {
    std::uint8_t byte = 0;
    (*this)(byte);
    value = byte != 0;
  }
  template <typename E>
  void choice(E& value, int count) {
    std::uint8_t byte = 0;
    (*this)(byte);
    if (byte >= count)
      good_ = false;
    else
      value = static_cast<E>(byte);
  }
  void operator()(std::string& text) { block(text); }
  template <RawBytes T>
  void operator()(std::vector<T>& values) {
    block(values);
  }
  template <typename T, typename Fields>
  void list(std::vector<T>& values, Fields fields) {
    std::uint64_t count = 0;
    (*this)(count);
    // Every element takes at least one byte, so that the loop ends with the bytes.
    for (std::uint64_t i = 0; i < count && good_; ++i) fields(*this, values.emplace_back());
  }
  template <RawBytes T>
  void operator()(std::optional<T>& value) {
    bool has = false;
    (*this)(has);
    if (has) (*this)(value.emplace());
  }

 private:
  template <typename Container>
  void block(Container& values) {
    std::uint64_t count = 0;
    (*this)(count);
    if (!good_ || count > rest_.size() / sizeof(values[0])) {
      good_ = false;
      return;
    }
    values.resize(count);
    take(values.data(), count * sizeof(values[0]));
  }
  void take(void* to, std::size_t size) {
    if (!good_ || size > rest_.size()) {
      good_ = false;
      return;
    }
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }

  std::span<const std::byte> rest_;
  bool good_ = true;
};

}  // namespace lucerna
