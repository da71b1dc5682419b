#include "fuzz/fuzz.hpp"

#include <vector>

#include "scene/bvh.hpp"
#include "scene/check_scene.hpp"
#include "scene/view.hpp"

namespace lucerna::fuzz {
namespace {

constexpr float kTime = 0.4f;  // s, between the keys of most animations

void checkSound(const scene::Scene& scene, const char* when) {
  const Status sound = scene::checkScene(scene, scene.textures.size());
  CHECK(sound, "{}: {}", when, sound.error().message);
  for (const scene::Texture& texture : scene.textures) CHECK(texture.image != nullptr);
}

std::vector<Aabb> boxesOf(const scene::Scene& scene) {
  std::vector<Aabb> boxes;
  for (const scene::Object& object : scene.objects) boxes.push_back(object.boundsW);
  return boxes;
}

}  // namespace

std::string_view textOf(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void checkRefusal(const Error& error, ErrorKind kind, std::string_view name) {
  const std::string& message = error.message;
  CHECK(error.kind == kind, "a refusal of kind {}: {}", static_cast<int>(error.kind), message);
  CHECK(message.size() > name.size() + 10, "a refusal that says nothing: '{}'", message);
  CHECK(message.find(name) != std::string::npos, "a refusal without '{}': '{}'", name, message);
  CHECK(message.back() != '\n', "a refusal that ends with a newline: '{}'", message);
}

void useScene(scene::Scene scene) {
  checkSound(scene, "as read");
  scene::complete(scene);
  checkSound(scene, "completed");
  CHECK(!scene.cameras.empty());
  scene::Bvh bvh;
  bvh.build(boxesOf(scene));
  const std::vector<std::uint32_t> moved = scene::animate(scene, kTime);
  checkSound(scene, "animated");
  std::vector<Aabb> boxes;
  for (const std::uint32_t object : moved) boxes.push_back(scene.objects.at(object).boundsW);
  bvh.refit(moved, boxes);
  std::vector<std::uint32_t> seen;
  bvh.query(scene::viewOf(scene, scene.cameras.front(), 16.f / 9.f).frustumW(), seen);
  for (const std::uint32_t object : seen) CHECK(object < scene.objects.size());
  (void)scene::placeLights(scene);
}

}  // namespace lucerna::fuzz
