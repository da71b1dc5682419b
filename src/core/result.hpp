// Expected failures: a value or an Error with one clear sentence for the user.
//
//   Result<Image> readImage(path);
//   LUCERNA_TRY(image, readImage(path));   // declares `image`, or returns the error to the caller
//   LUCERNA_TRY_VOID(writeFile(path, bytes));
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/check.hpp"

namespace lucerna {

// The values are the process exit codes.
enum class ErrorKind {
  Failed = 1,    // ran, but failed or differs
  Usage = 2,     // unknown option or value on the command line
  Input = 3,     // a file that cannot be read or makes no sense
  NoGl = 4,      // no usable OpenGL
  Pipeline = 5,  // pipeline, pass, script or shader error
  Cancelled = 130
};

struct Error {
  ErrorKind kind = ErrorKind::Failed;
  // Names the thing, what was found, what was wanted and the next step. May have several lines,
  // one per fault. No trailing newline.
  std::string message;
};

// Makes an Error from an fmt format string: error(ErrorKind::Input, "{}: ...", path).
template <typename... Args>
Error error(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  return {kind, fmt::format(format, std::forward<Args>(args)...)};
}

template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit

  explicit operator bool() const { return state_.index() == 0; }
  T& value() & {
    CHECK(state_.index() == 0, "value() of an error: {}", std::get<1>(state_).message);
    return std::get<0>(state_);
  }
  const T& value() const& { return const_cast<Result*>(this)->value(); }
  T&& value() && { return std::move(value()); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(value()); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const {
    CHECK(state_.index() == 1);
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit
  explicit operator bool() const { return !error_; }
  const Error& error() const {
    CHECK(error_.has_value());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

using Status = Result<void>;

}  // namespace lucerna

#define LUCERNA_CONCAT_(a, b) a##b
#define LUCERNA_CONCAT(a, b) LUCERNA_CONCAT_(a, b)
#define LUCERNA_TRY(name, expression)                                               \
  auto LUCERNA_CONCAT(name, Result_) = (expression);                                \
  if (!LUCERNA_CONCAT(name, Result_)) return LUCERNA_CONCAT(name, Result_).error(); \
  auto name = std::move(LUCERNA_CONCAT(name, Result_)).value()
#define LUCERNA_TRY_VOID(expression)                                            \
  do {                                                                          \
    if (auto tryResult_ = (expression); !tryResult_) return tryResult_.error(); \
  } while (false)
