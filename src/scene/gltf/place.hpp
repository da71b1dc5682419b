// Checked access to the JSON of a glTF file: reading a value and refusing a wrong one are one step,
// and every refusal names the place as a JSON pointer.
//
// Faults travel as an exception inside src/scene/gltf/ only; readGltf() turns them into an Error.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/math/math.hpp"
#include "core/result.hpp"

namespace lucerna::scene::gltf {

using Json = nlohmann::json;

struct Fault {
  std::string message;  // place, found, wanted, next step; the file's name is added by readGltf()
  ErrorKind kind = ErrorKind::Input;
};

// "PLACE: found FOUND, wanted WANTED; NEXT"
[[noreturn]] void fail(const std::string& place, const std::string& found,
                       const std::string& wanted,
                       const std::string& next = "correct this value or export the file again");

// A value in a document. Cheap to copy; the document must outlive it.
class Place {
 public:
  Place(const Json& root, const Json& value) : root_(&root), value_(&value) {}

  // The JSON pointer, e.g. "/accessors/3/count". Searches the document: for messages only.
  std::string pointer() const;
  const void* id() const { return value_; }                   // of the value
  [[noreturn]] void refuse(const std::string& wanted) const;  // found: the value itself
  [[noreturn]] void refuse(const std::string& found, const std::string& wanted) const;

  // Objects. Asking a value that is no object for a member is a fault.
  bool has(const char* key) const { return member(key) != nullptr; }
  std::optional<Place> find(const char* key) const;
  Place at(const char* key) const;  // a fault if it is missing
  std::vector<std::pair<std::string, Place>> members() const;
  // The object extensions/NAME, if it is there.
  std::optional<Place> extension(const char* name) const;

  // Arrays. elements("x") of an object: its array member x, or nothing if it has none.
  std::vector<Place> elements() const;
  std::vector<Place> elements(const char* key) const;

  // The member "name", of which about 250 bytes are kept: what stands once in a file may be copied
  // for everything that is made of it.
  std::string name(const std::string& fallback) const;

  // Values.
  const std::string& text() const;
  bool boolean() const;
  float number() const;  // finite as a float
  float number(float min, float max) const;
  std::uint64_t integer(std::uint64_t min, std::uint64_t max) const;
  // An index into a list of `count`, which is called `list` in messages.
  std::uint32_t index(std::size_t count, const char* list) const;
  void numbers(std::span<float> out) const;  // an array of exactly out.size() numbers

  // Members with a default for absence.
  std::string text(const char* key, const std::string& fallback = {}) const;
  bool boolean(const char* key, bool fallback) const;
  float number(const char* key, float fallback, float min, float max) const;
  std::uint64_t integer(const char* key, std::uint64_t fallback, std::uint64_t min,
                        std::uint64_t max) const;
  std::uint32_t index(const char* key, std::size_t count, const char* list) const;  // kNone
  vec3 vector3(const char* key, vec3 fallback) const;
  vec4 vector4(const char* key, vec4 fallback) const;

 private:
  const Json* member(const char* key) const;
  Place child(const Json& value) const { return {*root_, value}; }

  const Json* root_;
  const Json* value_;
};

}  // namespace lucerna::scene::gltf
