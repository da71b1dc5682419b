// Radiance RGBE: Ward, "Real Pixels", Graphics Gems II, 1991. Our own reader, because the one of
// stb_image (2.27) runs for ever on a run length of zero.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "image/codec.hpp"

namespace lucerna::codec {
namespace {

// Scanlines of other widths are stored without run lengths.
constexpr int kLeastRunLengthWidth = 8, kMostRunLengthWidth = 32767;

struct HdrHeader {
  int width = 0, height = 0;
  std::size_t dataStart = 0;
};

bool recognises(ByteView bytes) {
  return startsWith(bytes, "#?RADIANCE") || startsWith(bytes, "#?RGBE");
}

// The next line without its end; moves `at` past it. Lines are short: more is not a header.
std::string nextLine(ByteView bytes, std::size_t& at) {
  std::string line;
  while (at < bytes.size() && line.size() < 1024) {
    const auto c = static_cast<char>(bytes[at++]);
    if (c == '\n') break;
    if (c != '\r') line += c;
  }
  return line;
}

Result<HdrHeader> parse(ByteView bytes, const std::string& name) {
  if (!recognises(bytes)) return corrupt(name, "HDR", "it does not begin with #?RADIANCE");
  HdrHeader header;
  std::string line;
  while (!(line = nextLine(bytes, header.dataStart)).empty())
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
      return error(ErrorKind::Input, "{}: HDR pixels in {} are not read; 32-bit_rle_rgbe is", name,
                   line.substr(7));
  line = nextLine(bytes, header.dataStart);
  int used = 0;
  if (std::sscanf(line.c_str(), "-Y %9d +X %9d%n", &header.height, &header.width, &used) != 2 ||
      static_cast<std::size_t>(used) != line.size())
    return corrupt(name, "HDR",
                   fmt::format("the size line is '{}', '-Y height +X width' was wanted", line));
  return header;
}

Result<Header> readHeader(ByteView bytes, const std::string& name) {
  LUCERNA_TRY(parsed, parse(bytes, name));
  const auto pixels = static_cast<std::uint64_t>(std::max(parsed.width, 0)) *
                      static_cast<std::uint64_t>(std::max(parsed.height, 0));
  // Best case: runs of 127 in each of four planes, two bytes each.
  return Header{{"HDR", parsed.width, parsed.height, 3, ComponentType::F32},
                parsed.dataStart + pixels * 8 / 127};
}

void storePixel(const std::uint8_t* rgbe, float* rgb) {
  const float scale = rgbe[3] == 0 ? 0.f : std::ldexp(1.f, rgbe[3] - (128 + 8));
  for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(rgbe[c]) * scale;
}

// One plane (red, green, blue or exponent) of a scanline; every fourth byte of `plane`.
bool readPlane(ByteView bytes, std::size_t& at, std::uint8_t* plane, int width) {
  for (int x = 0; x < width;) {
    if (at + 2 > bytes.size()) return false;
    const std::uint32_t code = byteAt(bytes, at++);
    const int count = static_cast<int>(code > 128 ? code - 128 : code);
    const std::size_t stored = code > 128 ? 1 : static_cast<std::size_t>(count);
    if (count == 0 || count > width - x || at + stored > bytes.size()) return false;
    for (int i = 0; i < count; ++i)
      plane[4 * (x + i)] =
          static_cast<std::uint8_t>(bytes[at + (code > 128 ? 0 : static_cast<std::size_t>(i))]);
    at += stored;
    x += count;
  }
  return true;
}

bool readScanline(ByteView bytes, std::size_t& at, std::vector<std::uint8_t>& rgbe) {
  const int width = static_cast<int>(rgbe.size() / 4);
  const bool runLengths = width >= kLeastRunLengthWidth && width <= kMostRunLengthWidth &&
                          startsWith(bytes.subspan(std::min(at, bytes.size())), "\x02\x02") &&
                          byteAt(bytes, at + 2) < 128;
  if (!runLengths) {
    if (bytes.size() < rgbe.size() || at > bytes.size() - rgbe.size()) return false;
    for (std::uint8_t& value : rgbe) value = static_cast<std::uint8_t>(bytes[at++]);
    return true;
  }
  if (static_cast<int>(byteAt(bytes, at + 2) << 8 | byteAt(bytes, at + 3)) != width) return false;
  at += 4;
  for (int plane = 0; plane < 4; ++plane)
    if (!readPlane(bytes, at, rgbe.data() + plane, width)) return false;
  return true;
}

Result<Image> decode(ByteView bytes, const std::string& name) {
  LUCERNA_TRY(header, parse(bytes, name));
  Image image(header.width, header.height, 3, ComponentType::F32);
  std::vector<std::uint8_t> rgbe(static_cast<std::size_t>(header.width) * 4);
  std::size_t at = header.dataStart;
  for (int y = 0; y < header.height; ++y) {
    if (!readScanline(bytes, at, rgbe))
      return corrupt(name, "HDR", fmt::format("scanline {} is damaged or missing", y));
    for (int x = 0; x < header.width; ++x)
      storePixel(rgbe.data() + 4 * x, image.pixel<float>(x, y));
  }
  return image;
}

// The nearest value that RGBE can hold; negative and NaN become 0.
void packPixel(const float* rgb, std::uint8_t* rgbe) {
  float clamped[3];
  for (int c = 0; c < 3; ++c) clamped[c] = rgb[c] > 0 ? std::min(rgb[c], 1.69e38f) : 0.f;
  int exponent = 0;
  std::frexp(std::max({clamped[0], clamped[1], clamped[2]}), &exponent);
  // Rounding must not carry the largest component to 256.
  if (std::ldexp(std::max({clamped[0], clamped[1], clamped[2]}), 8 - exponent) >= 255.5f)
    ++exponent;
  if (exponent < -127) {
    std::fill(rgbe, rgbe + 4, std::uint8_t{0});
    return;
  }
  for (int c = 0; c < 3; ++c)
    rgbe[c] = static_cast<std::uint8_t>(std::ldexp(clamped[c], 8 - exponent) + 0.5f);
  rgbe[3] = static_cast<std::uint8_t>(exponent + 128);
}

void writePlane(const std::uint8_t* plane, int width, Bytes& out) {
  const auto value = [&](int x) { return static_cast<std::byte>(plane[4 * x]); };
  const auto runAt = [&](int x) {
    int end = x + 1;
    while (end < width && end - x < 127 && value(end) == value(x)) ++end;
    return end - x;
  };
  for (int x = 0; x < width;) {
    if (const int run = runAt(x); run >= 3) {
      out.push_back(static_cast<std::byte>(128 + run));
      out.push_back(value(x));
      x += run;
      continue;
    }
    int end = x + 1;
    while (end < width && end - x < 128 && runAt(end) < 3) ++end;
    out.push_back(static_cast<std::byte>(end - x));
    for (; x < end; ++x) out.push_back(value(x));
  }
}

}  // namespace

const Format kHdr = {"HDR", ".hdr", recognises, readHeader, decode};

Result<Bytes> encodeHdr(const Image& image, const std::string& name) {
  if (image.type() != ComponentType::F32 && image.type() != ComponentType::Half)
    return error(ErrorKind::Usage, "{}: HDR holds linear floats; write 8-bit pictures as .png",
                 name);
  const int width = image.width();
  const std::string text =
      fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height(), width);
  const auto textBytes = std::as_bytes(std::span(text));
  Bytes out(textBytes.begin(), textBytes.end());
  std::vector<std::uint8_t> rgbe(static_cast<std::size_t>(width) * 4);
  Image row(width, 1, image.channels(), image.type());
  for (int y = 0; y < image.height(); ++y) {
    std::ranges::copy(image.bytes().subspan(y * image.rowBytes(), image.rowBytes()),
                      row.bytes().begin());
    const Image rgb = converted(row, ComponentType::F32, 3);
    for (int x = 0; x < width; ++x) packPixel(rgb.pixel<float>(x, 0), rgbe.data() + 4 * x);
    if (width < kLeastRunLengthWidth || width > kMostRunLengthWidth) {
      const auto raw = std::as_bytes(std::span(rgbe));
      out.insert(out.end(), raw.begin(), raw.end());
      continue;
    }
    for (const int byte : {2, 2, width >> 8, width & 255})
      out.push_back(static_cast<std::byte>(byte));
    for (int plane = 0; plane < 4; ++plane) writePlane(rgbe.data() + plane, width, out);
  }
  return out;
}

}  // namespace lucerna::codec
