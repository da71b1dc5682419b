// JPEG through TurboJPEG.
#include <turbojpeg.h>

#include <memory>

#include "core/log.hpp"
#include "image/codec.hpp"

namespace lucerna::codec {
namespace {

using Decoder = std::unique_ptr<void, int (*)(tjhandle)>;

Decoder makeDecoder() {
  Decoder decoder(tjInitDecompress(), tjDestroy);
  CHECK(decoder);
  return decoder;
}

const unsigned char* data(ByteView bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

bool recognises(ByteView bytes) {
  return startsWith(bytes, "\xff\xd8\xff");
}

Result<Header> readHeader(ByteView bytes, const std::string& name) {
  const Decoder decoder = makeDecoder();
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), data(bytes), bytes.size(), &width, &height, &subsampling,
                          &colours) != 0)
    return corrupt(name, "JPEG", tjGetErrorStr2(decoder.get()));
  Header header;
  header.info = {"JPEG", width, height, colours == TJCS_GRAY ? 1 : 3};
  // A block of 8x8 pixels takes a bit at least with Huffman codes; a margin for arithmetic coding.
  header.leastBytes = static_cast<std::uint64_t>(width) * height / 4096;
  return header;
}

// Adobe stores the ink inverted.
Image rgbFromInvertedCmyk(const Image& cmyk) {
  Image rgb(cmyk.width(), cmyk.height(), 3, ComponentType::U8);
  const std::uint8_t* from = cmyk.pixel<std::uint8_t>(0, 0);
  std::uint8_t* to = rgb.pixel<std::uint8_t>(0, 0);
  const std::size_t pixels = rgb.bytes().size() / 3;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      to[3 * i + c] = static_cast<std::uint8_t>((from[4 * i + c] * from[4 * i + 3] + 127) / 255);
  return rgb;
}

Result<Image> decode(ByteView bytes, const std::string& name) {
  const Decoder decoder = makeDecoder();
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), data(bytes), bytes.size(), &width, &height, &subsampling,
                          &colours) != 0)
    return corrupt(name, "JPEG", tjGetErrorStr2(decoder.get()));
  const bool grey = colours == TJCS_GRAY, ink = colours == TJCS_CMYK || colours == TJCS_YCCK;
  Image image(width, height, grey ? 1 : ink ? 4 : 3, ComponentType::U8);
  const int format = grey ? TJPF_GRAY : ink ? TJPF_CMYK : TJPF_RGB;
  const int status = tjDecompress2(decoder.get(), data(bytes), bytes.size(),
                                   reinterpret_cast<unsigned char*>(image.bytes().data()), width,
                                   static_cast<int>(image.rowBytes()), height, format,
                                   TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT);
  if (status != 0) {
    const std::string message = tjGetErrorStr2(decoder.get());
    // Warnings are for streams that decode all the same, but one that ends early is half a picture.
    const bool fatal = tjGetErrorCode(decoder.get()) == TJERR_FATAL;
    if (fatal || message.find("remature end") != std::string::npos)
      return corrupt(name, "JPEG", message);
    log::warning("{}: {}", name, message);
  }
  return ink ? rgbFromInvertedCmyk(image) : image;
}

}  // namespace

const Format kJpeg = {"JPEG", ".jpg", recognises, readHeader, decode};

}  // namespace lucerna::codec
