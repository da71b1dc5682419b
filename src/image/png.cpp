// PNG through libpng. libpng reports errors by longjmp, so the functions that call setjmp keep
// everything with a destructor outside themselves.
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>

#include "image/codec.hpp"

namespace lucerna::codec {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kFirstChunk = 8;
constexpr std::size_t kHeaderEnd = 33;                 // signature and IHDR
constexpr png_alloc_size_t kMaxChunkBytes = 64 << 20;  // of chunks that are passed over, too
// Of the levels 1 to 9: pictures are written often, so time counts for more than size.
constexpr int kCompressionLevel = 3;

struct PngReader {
  explicit PngReader(ByteView source) : rest(source) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    CHECK(png);
    info = png_create_info_struct(png);
    CHECK(info);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  [[noreturn]] static void onError(png_structp png, png_const_charp text) {
    static_cast<PngReader*>(png_get_error_ptr(png))->message = text;
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}  // harmless oddities of ancillary chunks
  static void onRead(png_structp png, png_bytep to, png_size_t count) {
    auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > reader.rest.size()) png_error(png, "the data end too early");
    std::memcpy(to, reader.rest.data(), count);
    reader.rest = reader.rest.subspan(count);
  }

  ByteView rest;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string message;
};

// The chunks before the pixels.
bool readInfo(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_read_fn(reader.png, &reader, PngReader::onRead);
  png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff);  // checked by decodeImage
  png_set_chunk_malloc_max(reader.png, kMaxChunkBytes);
  // Passes over all chunks but IHDR, PLTE, tRNS, IDAT and IEND: values are given as stored, so that
  // no profile and no gamma counts, and texts inflate to a thousand times their size.
  png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(reader.png, reader.info);
  return true;
}

bool setConversions(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_expand(reader.png);  // palettes, few bits, transparent colours
  png_set_swap(reader.png);    // 16 bits are big-endian in the file
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool readRows(PngReader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

std::vector<png_bytep> rowPointers(const Image& image) {
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height()));
  auto* first = reinterpret_cast<png_bytep>(const_cast<std::byte*>(image.bytes().data()));
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = first + y * image.rowBytes();
  return rows;
}

bool hasPixels(ByteView bytes) {
  for (std::size_t at = kHeaderEnd; at + 8 <= bytes.size();
       at += 12 + static_cast<std::size_t>(big32(bytes, at)))
    if (startsWith(bytes.subspan(at + 4), "IDAT")) return true;
  return false;
}

bool recognises(ByteView bytes) {
  return startsWith(bytes, kSignature);
}

Result<Header> readHeader(ByteView bytes, const std::string& name) {
  if (!recognises(bytes))
    return corrupt(name, "PNG", "the signature is damaged (as by a transfer in text mode)");
  if (bytes.size() < kHeaderEnd || !startsWith(bytes.subspan(kFirstChunk + 4), "IHDR"))
    return corrupt(name, "PNG", "the first chunk is not a whole IHDR");
  const std::uint32_t width = big32(bytes, 16), height = big32(bytes, 20);
  const std::uint32_t bits = byteAt(bytes, 24), colour = byteAt(bytes, 25);
  if (width > 0x7fffffff || height > 0x7fffffff)
    return corrupt(name, "PNG", "its header declares a side of more than 2^31 pixels");
  const bool palette = colour == 3, rgb = (colour & 2) != 0, alpha = (colour & 4) != 0;
  if (colour > 6 || colour == 1 || colour == 5)
    return corrupt(name, "PNG", fmt::format("colour type {} does not exist", colour));
  if (!std::has_single_bit(bits) || bits > 16)
    return corrupt(name, "PNG", fmt::format("a bit depth of {} does not exist", bits));
  if (!hasPixels(bytes)) return corrupt(name, "PNG", "it has no pixels (no IDAT chunk)");
  // libpng passes over a damaged chunk of transparent colours: only it knows whether there is one.
  // What it refuses altogether is told by decode().
  PngReader reader(bytes);
  const bool transparency =
      readInfo(reader) && png_get_valid(reader.png, reader.info, PNG_INFO_tRNS) != 0;
  const std::uint32_t stored = palette ? 1 : (rgb ? 3 : 1) + (alpha ? 1 : 0);
  Header header;
  header.info = {"PNG", static_cast<int>(width), static_cast<int>(height),
                 (rgb ? 3 : 1) + (alpha || transparency ? 1 : 0),
                 bits == 16 ? ComponentType::U16 : ComponentType::U8};
  const std::uint64_t row = 1 + (static_cast<std::uint64_t>(width) * stored * bits + 7) / 8;
  header.leastBytes = kHeaderEnd + row * height / kDeflateRatio;
  return header;
}

Result<Image> decode(ByteView bytes, const std::string& name) {
  PngReader reader(bytes);
  if (!readInfo(reader) || !setConversions(reader)) return corrupt(name, "PNG", reader.message);
  const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
  Image image(static_cast<int>(png_get_image_width(reader.png, reader.info)),
              static_cast<int>(png_get_image_height(reader.png, reader.info)),
              png_get_channels(reader.png, reader.info),
              wide ? ComponentType::U16 : ComponentType::U8);
  CHECK(png_get_rowbytes(reader.png, reader.info) == image.rowBytes());
  std::vector<png_bytep> rows = rowPointers(image);
  if (!readRows(reader, rows.data())) return corrupt(name, "PNG", reader.message);
  return image;
}

struct PngWriter {
  PngWriter() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    CHECK(png);
    info = png_create_info_struct(png);
    CHECK(info);
  }
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  [[noreturn]] static void onError(png_structp png, png_const_charp text) {
    static_cast<PngWriter*>(png_get_error_ptr(png))->message = text;
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}
  static void onWrite(png_structp png, png_bytep from, png_size_t count) {
    auto& out = static_cast<PngWriter*>(png_get_io_ptr(png))->out;
    const auto* first = reinterpret_cast<const std::byte*>(from);
    out.insert(out.end(), first, first + count);
  }
  static void onFlush(png_structp) {}

  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string message;
  Bytes out;
};

bool writeRows(PngWriter& writer, const Image& image, png_bytepp rows) {
  static constexpr int kColourTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                         PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  if (setjmp(png_jmpbuf(writer.png))) return false;
  png_set_write_fn(writer.png, &writer, PngWriter::onWrite, PngWriter::onFlush);
  png_set_user_limits(writer.png, 0x7fffffff, 0x7fffffff);
  png_set_compression_level(writer.png, kCompressionLevel);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width()),
               static_cast<png_uint_32>(image.height()),
               image.type() == ComponentType::U16 ? 16 : 8, kColourTypes[image.channels() - 1],
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer.png, writer.info);
  png_set_swap(writer.png);
  png_write_image(writer.png, rows);
  png_write_end(writer.png, nullptr);
  return true;
}

}  // namespace

const Format kPng = {"PNG", ".png", recognises, readHeader, decode};

Result<Bytes> encodePng(const Image& image, const std::string& name) {
  if (image.type() != ComponentType::U8 && image.type() != ComponentType::U16)
    return error(ErrorKind::Usage, "{}: PNG holds 8 or 16 bits, not floats; write .exr or .hdr",
                 name);
  PngWriter writer;
  std::vector<png_bytep> rows = rowPointers(image);
  if (!writeRows(writer, image, rows.data()))
    return error(ErrorKind::Failed, "{}: encoding the PNG failed: {}", name, writer.message);
  return std::move(writer.out);
}

}  // namespace lucerna::codec
