// What a pass holds in its Ports struct while it executes. T is gpu::Texture or a data type.
#pragma once

#include "core/check.hpp"

namespace lucerna::graph {

template <typename T>
class In {
 public:
  explicit operator bool() const { return pointer_ != nullptr; }
  const T& operator*() const {
    CHECK(pointer_ != nullptr, "an unbound input was read");
    return *pointer_;
  }
  const T* operator->() const { return &**this; }
  const T* get() const { return pointer_; }
  void bind(const T* pointer) { pointer_ = pointer; }

 private:
  const T* pointer_ = nullptr;
};

template <typename T>
class Out {
 public:
  explicit operator bool() const { return pointer_ != nullptr; }
  T& operator*() const {
    CHECK(pointer_ != nullptr, "an output that nobody reads was written");
    return *pointer_;
  }
  T* operator->() const { return &**this; }
  T* get() const { return pointer_; }
  void bind(T* pointer) { pointer_ = pointer; }

 private:
  T* pointer_ = nullptr;
};

template <typename T>
class InOut : public Out<T> {
 public:
  // There was nothing to update (only where the port is optional): the content is undefined, and
  // this pass makes it.
  bool isNew() const { return isNew_; }
  void bind(T* pointer, bool isNew = false) {
    Out<T>::bind(pointer);
    isNew_ = isNew;
  }

 private:
  bool isNew_ = false;
};

}  // namespace lucerna::graph
