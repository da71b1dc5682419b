// What image_file.cpp asks of each file format. Private to this folder.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/result.hpp"
#include "image/image.hpp"
#include "image/image_file.hpp"

namespace lucerna::codec {

using ByteView = std::span<const std::byte>;

struct Header {
  ImageInfo info;
  // No shorter file can hold a picture of this size; guards allocations against lying headers.
  std::uint64_t leastBytes = 0;
};

// recognises: by the first bytes. readHeader: allocates nothing that grows with the declared size.
// decode: called only after the header was read and found to fit.
struct Format {
  const char* name;
  const char* extension;
  bool (*recognises)(ByteView bytes);
  Result<Header> (*readHeader)(ByteView bytes, const std::string& name);
  Result<Image> (*decode)(ByteView bytes, const std::string& name);
};

extern const Format kPng, kJpeg, kBmp, kHdr, kExr, kKtx2, kTga;

// Encoders give the whole file; `name` is used in messages.
Result<Bytes> encodePng(const Image& image, const std::string& name);
Result<Bytes> encodeHdr(const Image& image, const std::string& name);
// A layer to be written, as ExrLayer; the image is the caller's.
struct ExrSource {
  std::string name;
  std::vector<std::string> channels;
  const Image& image;
};
Result<Bytes> encodeExr(std::span<const ExrSource> layers, const std::string& name);
Result<std::vector<ExrLayer>> decodeExrLayers(ByteView bytes, const std::string& name,
                                              const ImageLimits& limits);

// Deflate cannot shrink by more (RFC 1951: 258 bytes in two bits, and some).
constexpr std::uint64_t kDeflateRatio = 1032;

// Bounds-checked integers of a header; 0 beyond the end, so check sizes first where 0 has meaning.
inline std::uint32_t byteAt(ByteView bytes, std::size_t at) {
  return at < bytes.size() ? std::to_integer<std::uint32_t>(bytes[at]) : 0;
}
inline std::uint32_t little16(ByteView b, std::size_t at) {
  return byteAt(b, at) | byteAt(b, at + 1) << 8;
}
inline std::uint32_t little32(ByteView b, std::size_t at) {
  return little16(b, at) | little16(b, at + 2) << 16;
}
inline std::uint32_t big32(ByteView b, std::size_t at) {
  return byteAt(b, at) << 24 | byteAt(b, at + 1) << 16 | byteAt(b, at + 2) << 8 | byteAt(b, at + 3);
}
inline bool startsWith(ByteView bytes, std::string_view magic) {
  if (bytes.size() < magic.size()) return false;
  for (std::size_t i = 0; i < magic.size(); ++i)
    if (std::to_integer<unsigned char>(bytes[i]) != static_cast<unsigned char>(magic[i]))
      return false;
  return true;
}
inline Error corrupt(const std::string& name, const char* format, std::string_view what) {
  return error(ErrorKind::Input, "{}: corrupt {}: {}; export or copy it again", name, format, what);
}

}  // namespace lucerna::codec
