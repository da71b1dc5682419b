#include "fuzz/fuzz.hpp"
#include "scene/gltf/gltf_reader.hpp"

namespace lucerna::fuzz {

void gltf(ByteView bytes) {
  auto scene =
      scene::readGltf("fuzz.gltf", Bytes(bytes.begin(), bytes.end()), scene::OutsideFiles::Refuse);
  if (!scene) return checkRefusal(scene.error(), ErrorKind::Input, "fuzz.gltf: ");
  for (const std::string& warning : scene->warnings) CHECK(!warning.empty());
  useScene(std::move(*scene));
}

}  // namespace lucerna::fuzz
