#include "scene/gltf/place.hpp"

#include <cmath>
#include <limits>

#include "scene/light.hpp"

namespace lucerna::scene::gltf {

namespace {

// Depth-first search for the value's address; the depth is limited when the file is read.
bool findPointer(const Json& here, const Json* wanted, std::string& pointer) {
  if (&here == wanted) return true;
  if (here.is_object()) {
    for (auto it = here.begin(); it != here.end(); ++it) {
      if (!findPointer(it.value(), wanted, pointer)) continue;
      pointer.insert(0, "/" + it.key());
      return true;
    }
  } else if (here.is_array()) {
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (!findPointer(here[i], wanted, pointer)) continue;
      pointer.insert(0, "/" + std::to_string(i));
      return true;
    }
  }
  return false;
}

std::string described(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

}  // namespace

void fail(const std::string& place, const std::string& found, const std::string& wanted,
          const std::string& next) {
  throw Fault{
      fmt::format("{}: found {}, wanted {}; {}", place.empty() ? "/" : place, found, wanted, next)};
}

std::string Place::pointer() const {
  std::string pointer;
  findPointer(*root_, value_, pointer);
  return pointer.empty() ? "/" : pointer;
}

void Place::refuse(const std::string& wanted) const {
  refuse(described(*value_), wanted);
}

void Place::refuse(const std::string& found, const std::string& wanted) const {
  fail(pointer(), found, wanted);
}

const Json* Place::member(const char* key) const {
  if (!value_->is_object()) refuse("an object");
  const auto it = value_->find(key);
  return it == value_->end() ? nullptr : &*it;
}

std::optional<Place> Place::find(const char* key) const {
  const Json* value = member(key);
  if (!value) return std::nullopt;
  return child(*value);
}

Place Place::at(const char* key) const {
  const Json* value = member(key);
  if (!value) refuse(fmt::format("no \"{}\"", key), fmt::format("\"{}\", which is required", key));
  return child(*value);
}

std::vector<std::pair<std::string, Place>> Place::members() const {
  if (!value_->is_object()) refuse("an object");
  std::vector<std::pair<std::string, Place>> result;
  for (auto it = value_->begin(); it != value_->end(); ++it) {
    result.emplace_back(it.key(), child(it.value()));
  }
  return result;
}

std::optional<Place> Place::extension(const char* name) const {
  const auto extensions = find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::vector<Place> Place::elements() const {
  if (!value_->is_array()) refuse("an array");
  std::vector<Place> result;
  result.reserve(value_->size());
  for (const Json& element : *value_) result.push_back(child(element));
  return result;
}

std::vector<Place> Place::elements(const char* key) const {
  const auto array = find(key);
  return array ? array->elements() : std::vector<Place>();
}

std::string Place::name(const std::string& fallback) const {
  constexpr std::size_t kMaxBytes = 250;
  const auto place = find("name");
  const std::string& whole = place ? place->text() : fallback;
  if (whole.size() <= kMaxBytes) return whole;
  std::size_t size = kMaxBytes;
  while (size > 0 && (static_cast<unsigned char>(whole[size]) & 0xC0) == 0x80) --size;  // of UTF-8
  return whole.substr(0, size) + "...";
}

const std::string& Place::text() const {
  if (!value_->is_string()) refuse("a string");
  return value_->get_ref<const std::string&>();
}

bool Place::boolean() const {
  if (!value_->is_boolean()) refuse("true or false");
  return value_->get<bool>();
}

float Place::number() const {
  if (!value_->is_number()) refuse("a number");
  const double value = value_->get<double>();
  if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
    refuse("a number that a float can hold");
  }
  return static_cast<float>(value);
}

float Place::number(float min, float max) const {
  const float value = number();
  if (value < min || value > max) refuse(fmt::format("a number from {} to {}", min, max));
  return value;
}

std::uint64_t Place::integer(std::uint64_t min, std::uint64_t max) const {
  const std::string wanted = max == std::numeric_limits<std::uint64_t>::max()
                                 ? fmt::format("an integer of at least {}", min)
                                 : fmt::format("an integer from {} to {}", min, max);
  std::uint64_t result = 0;
  if (value_->is_number_unsigned()) {
    result = value_->get<std::uint64_t>();
  } else if (value_->is_number_float()) {  // 3.0 is an integer of JSON Schema, 1e300 is too much
    const double value = value_->get<double>();
    if (!(value >= 0 && value < 9e15) || value != std::floor(value)) refuse(wanted);
    result = static_cast<std::uint64_t>(value);
  } else {
    refuse(wanted);
  }
  if (result < min || result > max) refuse(wanted);
  return result;
}

std::uint32_t Place::index(std::size_t count, const char* list) const {
  const auto value = integer(0, std::numeric_limits<std::uint64_t>::max());
  if (value >= count) {
    refuse(count == 0 ? fmt::format("an index into /{}, which has nothing in it", list)
                      : fmt::format("an index into /{}: 0 to {}", list, count - 1));
  }
  return static_cast<std::uint32_t>(value);
}

void Place::numbers(std::span<float> out) const {
  const auto places = elements();
  if (places.size() != out.size()) refuse(fmt::format("an array of {} numbers", out.size()));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = places[i].number();
}

std::string Place::text(const char* key, const std::string& fallback) const {
  const auto place = find(key);
  return place ? place->text() : fallback;
}

bool Place::boolean(const char* key, bool fallback) const {
  const auto place = find(key);
  return place ? place->boolean() : fallback;
}

float Place::number(const char* key, float fallback, float min, float max) const {
  const auto place = find(key);
  return place ? place->number(min, max) : fallback;
}

std::uint64_t Place::integer(const char* key, std::uint64_t fallback, std::uint64_t min,
                             std::uint64_t max) const {
  const auto place = find(key);
  return place ? place->integer(min, max) : fallback;
}

std::uint32_t Place::index(const char* key, std::size_t count, const char* list) const {
  const auto place = find(key);
  return place ? place->index(count, list) : kNone;
}

vec3 Place::vector3(const char* key, vec3 fallback) const {
  if (const auto place = find(key)) place->numbers({&fallback.x, 3});
  return fallback;
}

vec4 Place::vector4(const char* key, vec4 fallback) const {
  if (const auto place = find(key)) place->numbers({&fallback.x, 4});
  return fallback;
}

}  // namespace lucerna::scene::gltf
