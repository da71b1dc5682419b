#include "fuzz/fuzz.hpp"
#include "scene/import/scene_stream.hpp"
#include "scene/texture_store.hpp"

namespace lucerna::fuzz {

void importAnswer(ByteView bytes) {
  auto imported = scene::readStream(bytes);
  if (!imported) return checkRefusal(imported.error(), ErrorKind::Input, "");
  // Truth values other than 0 and 1 are evened out once, so the second writing must repeat it.
  const Bytes written = scene::writeStream(*imported);
  const auto again = scene::readStream(written);
  CHECK(again, "{}", again.error().message);
  CHECK(scene::writeStream(*again) == written);
  scene::Scene scene = std::move(imported->scene);
  scene.textures.resize(imported->textures.size());
  for (scene::Texture& texture : scene.textures) texture.image = scene::checkerboard();
  useScene(std::move(scene));
}

}  // namespace lucerna::fuzz
