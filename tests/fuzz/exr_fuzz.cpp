#include "fuzz/fuzz.hpp"
#include "image/image_file.hpp"

namespace lucerna::fuzz {
namespace {

// As much as a few kilobytes should be able to ask for.
constexpr ImageLimits kLimits{.maxSide = 4096, .maxBytes = 16 << 20};

}  // namespace

void exr(ByteView bytes) {
  const auto info = imageInfo(bytes, "fuzz.exr");
  const auto picture = decodeImage(bytes, "fuzz.exr", kLimits);
  if (!picture) checkRefusal(picture.error(), ErrorKind::Input, "fuzz.exr");
  if (picture)
    CHECK(info && info->width == picture->width() && info->height == picture->height() &&
              info->channels == picture->channels(),
          "the header does not say what the picture has");
  const auto layers = decodeExrLayers(bytes, "fuzz.exr", kLimits);
  if (!layers) return checkRefusal(layers.error(), ErrorKind::Input, "fuzz.exr");
  CHECK(!layers->empty());
  for (const ExrLayer& layer : *layers)
    CHECK(layer.channels.size() == static_cast<std::size_t>(layer.image.channels()));
}

}  // namespace lucerna::fuzz
