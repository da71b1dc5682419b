// BMP and TGA through stb_image. It pads short files with zeros and trusts declared sizes, so the
// data are measured here first.
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#include <stb/stb_image.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

#include "image/codec.hpp"

namespace lucerna::codec {
namespace {

constexpr std::size_t kTgaHeaderBytes = 18;
constexpr std::size_t kStbHeaderBytes = 4096;  // more than any header has

struct Tga {
  std::uint32_t idBytes, paletted, type, paletteLength, paletteBits, width, height, bits;

  explicit Tga(ByteView b)
      : idBytes(byteAt(b, 0)),
        paletted(byteAt(b, 1)),
        type(byteAt(b, 2)),
        paletteLength(little16(b, 5)),
        paletteBits(byteAt(b, 7)),
        width(little16(b, 12)),
        height(little16(b, 14)),
        bits(byteAt(b, 16)) {}

  bool runLengths() const { return type >= 8; }
  bool grey() const { return (type & 7) == 3; }
  std::uint32_t pixelBytes() const { return (bits + 7) / 8; }
  std::uint64_t dataStart() const {
    return kTgaHeaderBytes + idBytes +
           (paletted ? static_cast<std::uint64_t>(paletteLength) * ((paletteBits + 7) / 8) : 0);
  }
  bool plausible() const {
    const bool known =
        paletted ? type == 1 || type == 9 : type == 2 || type == 3 || type == 10 || type == 11;
    const auto depth = [](std::uint32_t n) {
      return n == 8 || n == 15 || n == 16 || n == 24 || n == 32;
    };
    const bool index = paletted == 1 && (bits == 8 || bits == 16) && depth(paletteBits);
    return known && width > 0 && height > 0 && (paletted == 0 ? depth(bits) : index);
  }
  int channels() const {
    const std::uint32_t colourBits = paletted ? paletteBits : bits;
    if (colourBits == 8) return 1;
    if (colourBits == 16 && grey()) return 2;
    return colourBits == 32 ? 4 : 3;
  }
};

bool tgaRecognises(ByteView bytes) {
  return bytes.size() >= kTgaHeaderBytes && Tga(bytes).plausible();
}

// Whether the packets that the file holds give all pixels.
bool runLengthsSuffice(const Tga& tga, ByteView bytes) {
  std::uint64_t wanted = static_cast<std::uint64_t>(tga.width) * tga.height;
  std::uint64_t at = tga.dataStart();
  while (wanted > 0) {
    if (at >= bytes.size()) return false;
    const std::uint32_t command = byteAt(bytes, at);
    const std::uint64_t count = (command & 127) + 1;
    at += 1 + (command & 128 ? 1 : count) * tga.pixelBytes();
    wanted -= std::min(wanted, count);
  }
  return at <= bytes.size();
}

Result<Header> tgaHeader(ByteView bytes, const std::string& name) {
  if (!tgaRecognises(bytes))
    return corrupt(name, "TGA", "the header has no known image type and depth");
  const Tga tga(bytes);
  Header header;
  header.info = {"TGA", static_cast<int>(tga.width), static_cast<int>(tga.height), tga.channels()};
  const std::uint64_t pixels = static_cast<std::uint64_t>(tga.width) * tga.height;
  header.leastBytes = tga.dataStart() + (tga.runLengths() ? pixels / 128 * (1 + tga.pixelBytes())
                                                          : pixels * tga.pixelBytes());
  return header;
}

// As decodeWithStb() will give them: alpha depends on the masks of a BMP. 0 if the header is
// damaged.
int stbChannels(ByteView bytes) {
  const ByteView start = bytes.first(std::min(bytes.size(), kStbHeaderBytes));
  int width = 0, height = 0, channels = 0;
  stbi_info_from_memory(reinterpret_cast<const stbi_uc*>(start.data()),
                        static_cast<int>(start.size()), &width, &height, &channels);
  return channels;
}

// stb_image's entry point takes either format; ours has looked at the header already.
Result<Image> decodeWithStb(ByteView bytes, const std::string& name, const char* format) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    return error(ErrorKind::Input, "{}: {} files of more than 2 GiB are not read", name, format);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                            static_cast<int>(bytes.size()), &width, &height, &channels, 0),
      stbi_image_free);
  if (!pixels) return corrupt(name, format, stbi_failure_reason());
  Image image(width, height, channels, ComponentType::U8);
  std::memcpy(image.bytes().data(), pixels.get(), image.bytes().size());
  return image;
}

Result<Image> decodeTga(ByteView bytes, const std::string& name) {
  const Tga tga(bytes);
  if (tga.runLengths() && !runLengthsSuffice(tga, bytes))
    return corrupt(name, "TGA", "the run lengths end before the last pixel");
  return decodeWithStb(bytes, name, "TGA");
}

bool bmpRecognises(ByteView bytes) {
  if (bytes.size() < 26 || !startsWith(bytes, "BM")) return false;
  const std::uint32_t size = little32(bytes, 14);
  return size == 12 || (size >= 40 && size <= 124);
}

Result<Header> bmpHeader(ByteView bytes, const std::string& name) {
  if (!bmpRecognises(bytes)) return corrupt(name, "BMP", "the header is of no known kind");
  const bool old = little32(bytes, 14) == 12;
  const std::uint32_t bits = little16(bytes, old ? 24 : 28);
  const std::uint32_t compression = old ? 0 : little32(bytes, 30);
  if (bits != 1 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32)
    return corrupt(name, "BMP", fmt::format("{} bits a pixel do not exist", bits));
  if (compression != 0 && compression != 3)
    return error(ErrorKind::Input,
                 "{}: BMP with compression {} is not read; save it uncompressed or as PNG", name,
                 compression);
  // A negative height means rows from top to bottom.
  const auto width = static_cast<std::int32_t>(old ? little16(bytes, 18) : little32(bytes, 18));
  const auto rows = static_cast<std::int32_t>(old ? little16(bytes, 20) : little32(bytes, 22));
  if (width <= 0 || rows == 0 || rows == std::numeric_limits<std::int32_t>::min())
    return corrupt(name, "BMP", fmt::format("its header declares {}x{} pixels", width, rows));
  const int channels = stbChannels(bytes);
  if (channels == 0) return corrupt(name, "BMP", stbi_failure_reason());
  Header header;
  header.info = {"BMP", width, std::abs(rows), channels};
  const std::uint64_t row = (static_cast<std::uint64_t>(width) * bits + 31) / 32 * 4;
  header.leastBytes = little32(bytes, 10) + row * static_cast<std::uint64_t>(std::abs(rows));
  return header;
}

Result<Image> decodeBmp(ByteView bytes, const std::string& name) {
  return decodeWithStb(bytes, name, "BMP");
}

}  // namespace

const Format kTga = {"TGA", ".tga", tgaRecognises, tgaHeader, decodeTga};
const Format kBmp = {"BMP", ".bmp", bmpRecognises, bmpHeader, decodeBmp};

}  // namespace lucerna::codec
