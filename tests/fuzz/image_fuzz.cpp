#include "image/image_file.hpp"

#include <zlib.h>

#include <cmath>

#include "fuzz/fuzz.hpp"

namespace lucerna::fuzz {
namespace {

// As much as a few kilobytes should be able to ask for.
constexpr ImageLimits kLimits{.maxSide = 4096, .maxBytes = 16 << 20};

void checkSize(const Image& image, const ImageInfo& info) {
  CHECK(image.width() == info.width && image.height() == info.height,
        "the header says {}x{}, the picture has {}x{}", info.width, info.height, image.width(),
        image.height());
  CHECK(image.width() <= kLimits.maxSide && image.height() <= kLimits.maxSide);
}

// A PNG whose chunks have right checksums: damage gets past the first check of libpng.
Bytes withChecksums(ByteView png) {
  Bytes bytes(png.begin(), png.end());
  const auto at = [&](std::size_t i) { return std::to_integer<std::size_t>(bytes[i]); };
  for (std::size_t begin = 8; begin + 12 <= bytes.size();) {
    const std::size_t length =
        at(begin) << 24 | at(begin + 1) << 16 | at(begin + 2) << 8 | at(begin + 3);
    if (length > bytes.size() - begin - 12) break;
    const auto* chunk = reinterpret_cast<const Bytef*>(bytes.data() + begin + 4);
    const uLong sum = crc32(0, chunk, static_cast<uInt>(4 + length));  // of its type and data
    for (std::size_t i = 0; i < 4; ++i)
      bytes[begin + 8 + length + i] = static_cast<std::byte>(sum >> (24 - 8 * i));
    begin += 12 + length;
  }
  return bytes;
}

void decode(ByteView bytes) {
  const auto info = imageInfo(bytes, "fuzz.tga");  // TGA has no signature to tell it by
  const auto picture = decodeImage(bytes, "fuzz.tga", kLimits);
  if (!info) checkRefusal(info.error(), ErrorKind::Input, "fuzz.tga");
  if (!picture) return checkRefusal(picture.error(), ErrorKind::Input, "fuzz.tga");
  CHECK(info);
  checkSize(*picture, *info);
  CHECK(picture->channels() == info->channels, "the header of {} says {} channels, there are {}",
        info->format, info->channels, picture->channels());
  if (picture->type() == ComponentType::F32)
    for (const float value : picture->as<float>()) CHECK(std::isfinite(value));
}

}  // namespace

void image(ByteView bytes) {
  if (textOf(bytes).starts_with("\x76\x2f\x31\x01")) return;  // the target exr
  decode(bytes);
  if (textOf(bytes).starts_with("\x89PNG\r\n\x1a\n")) decode(withChecksums(bytes));
}

}  // namespace lucerna::fuzz
