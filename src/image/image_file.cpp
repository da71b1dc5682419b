#include "image/image_file.hpp"

#include <algorithm>
#include <array>

#include "core/text.hpp"
#include "image/codec.hpp"

namespace lucerna {
namespace {

using codec::Format;

// TGA has no signature, so it comes last.
const std::array kFormats = {&codec::kPng, &codec::kJpeg, &codec::kHdr, &codec::kExr,
                             &codec::kBmp, &codec::kKtx2, &codec::kTga};

std::string extensionOf(const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  return equalIgnoringCase(extension, ".jpeg") ? ".jpg" : extension;
}

std::string firstBytes(codec::ByteView bytes) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(8, bytes.size()); ++i)
    text += fmt::format("{}{:02x}", i == 0 ? "" : " ", codec::byteAt(bytes, i));
  return text;
}

// By content; if nothing fits, by extension, whose header reader then says what is wrong.
Result<const Format*> formatOf(codec::ByteView bytes, const std::string& name) {
  if (bytes.empty())
    return error(ErrorKind::Input, "{}: the file is empty, a picture was wanted", name);
  for (const Format* format : kFormats)
    if (format->recognises(bytes)) return format;
  const std::string extension = extensionOf(name);
  for (const Format* format : kFormats)
    if (equalIgnoringCase(extension, format->extension)) return format;
  return error(
      ErrorKind::Input,
      "{}: begins with {}, which is none of PNG, JPEG, TGA, BMP, HDR, EXR and KTX2; convert it "
      "to one of these",
      name, firstBytes(bytes));
}

Status checkSize(const codec::Header& header, codec::ByteView bytes, const std::string& name,
                 const ImageLimits& limits) {
  const ImageInfo& info = header.info;
  if (info.width <= 0 || info.height <= 0)
    return codec::corrupt(name, info.format.c_str(), "its header declares a size of zero");
  if (info.width > limits.maxSide || info.height > limits.maxSide)
    return error(ErrorKind::Input,
                 "{}: its {} header declares {}x{} pixels; at most {} a side are read; make it "
                 "smaller",
                 name, info.format, info.width, info.height, limits.maxSide);
  if (info.bytes() > limits.maxBytes)
    return error(ErrorKind::Input,
                 "{}: its {} header declares {}x{} pixels, which take {} once decoded; at most {} "
                 "are read; make it smaller",
                 name, info.format, info.width, info.height, bytesText(info.bytes()),
                 bytesText(limits.maxBytes));
  if (header.leastBytes > bytes.size())
    return error(ErrorKind::Input,
                 "{}: its {} header declares {}x{} pixels, which take {} bytes or more, but the "
                 "file has {}: it is truncated or corrupt",
                 name, info.format, info.width, info.height, header.leastBytes, bytes.size());
  return {};
}

}  // namespace

std::uint64_t ImageInfo::bytes() const {
  return std::uint64_t(std::max(width, 0)) * std::uint64_t(std::max(height, 0)) *
         (std::uint64_t(channels) * bytesPer(type));
}

Result<Image> decodeImage(std::span<const std::byte> bytes, const std::string& name,
                          const ImageLimits& limits) {
  LUCERNA_TRY(format, formatOf(bytes, name));
  LUCERNA_TRY(header, format->readHeader(bytes, name));
  LUCERNA_TRY_VOID(checkSize(header, bytes, name, limits));
  return format->decode(bytes, name);
}

Result<Image> readImage(const std::filesystem::path& path, const ImageLimits& limits) {
  LUCERNA_TRY(bytes, readFile(path));
  return decodeImage(bytes, path.string(), limits);
}

Result<ImageInfo> imageInfo(std::span<const std::byte> bytes, const std::string& name) {
  LUCERNA_TRY(format, formatOf(bytes, name));
  LUCERNA_TRY(header, format->readHeader(bytes, name));
  return header.info;
}

Result<Bytes> encodeImage(const std::filesystem::path& path, const Image& image) {
  const std::string extension = path.extension().string();
  if (equalIgnoringCase(extension, ".png")) return codec::encodePng(image, path.string());
  if (equalIgnoringCase(extension, ".hdr")) return codec::encodeHdr(image, path.string());
  if (equalIgnoringCase(extension, ".exr")) {
    static const std::vector<std::string> kNames[] = {
        {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    const codec::ExrSource layer{"", kNames[image.channels() - 1], image};
    return codec::encodeExr({&layer, 1}, path.string());
  }
  return error(ErrorKind::Usage, "{}: pictures are written as .png, .hdr or .exr, not '{}'",
               path.string(), extension);
}

Status writeImage(const std::filesystem::path& path, const Image& image) {
  CHECK(!image.empty());
  LUCERNA_TRY(bytes, encodeImage(path, image));
  return writeFile(path, bytes);
}

Status writeExr(const std::filesystem::path& path, const std::vector<ExrLayer>& layers) {
  std::vector<codec::ExrSource> sources;
  for (const ExrLayer& layer : layers) sources.push_back({layer.name, layer.channels, layer.image});
  LUCERNA_TRY(bytes, codec::encodeExr(sources, path.string()));
  return writeFile(path, bytes);
}

Result<std::vector<ExrLayer>> decodeExrLayers(std::span<const std::byte> bytes,
                                              const std::string& name, const ImageLimits& limits) {
  LUCERNA_TRY(header, codec::kExr.readHeader(bytes, name));
  LUCERNA_TRY_VOID(checkSize(header, bytes, name, limits));
  return codec::decodeExrLayers(bytes, name, limits);
}

Result<std::vector<ExrLayer>> readExrLayers(const std::filesystem::path& path) {
  LUCERNA_TRY(bytes, readFile(path));
  return decodeExrLayers(bytes, path.string());
}

}  // namespace lucerna
