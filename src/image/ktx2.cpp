#include "image/ktx2.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string_view>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "image/bc6h.hpp"
#include "image/codec.hpp"
#include "image/rgb9e5.hpp"

namespace lucerna {
namespace {

using codec::ByteView;
using codec::little32;

constexpr std::string_view kIdentifier{"\xabKTX 20\xbb\r\n\x1a\n", 12};
constexpr std::size_t kHeaderBytes = 80, kLevelBytes = 24;
constexpr std::size_t kConversionGrain = 1 << 14;  // texels
constexpr int kMost = std::numeric_limits<int>::max();
// image_file.cpp checks those of the caller.
constexpr ImageLimits kNoLimits{kMost, std::numeric_limits<std::uint64_t>::max()};

// Where the header's fields lie.
enum At : std::size_t {
  kVkFormat = 12,
  kTypeSize = 16,
  kWidth = 20,
  kHeight = 24,
  kDepth = 28,
  kLayers = 32,
  kFaces = 36,
  kLevels = 40,
  kScheme = 44,
  kDescriptorAt = 48,
  kDescriptorSize = 52,
  kPairsAt = 56,
  kPairsSize = 60,
  kGlobalAt = 64,
  kGlobalSize = 72,
};

// A sample of a data format descriptor: bits of a texel block.
struct Sample {
  std::uint32_t bitOffset, bits, channel, lower, upper;
};
constexpr std::uint32_t kExponent = 2 << 4, kFloat = 8 << 4;  // ored to the channel
constexpr std::uint32_t kOne = std::bit_cast<std::uint32_t>(1.f);

// The upper value of mantissas is what the reference implementation writes and asks for; the
// specification's text says 256 where its table says 8448.
constexpr std::array<Sample, 6> kRgb9e5Samples = {{{0, 9, 0, 0, 8448},
                                                   {27, 5, 0 | kExponent, 15, 31},
                                                   {9, 9, 1, 0, 8448},
                                                   {27, 5, 1 | kExponent, 15, 31},
                                                   {18, 9, 2, 0, 8448},
                                                   {27, 5, 2 | kExponent, 15, 31}}};
constexpr std::array<Sample, 1> kBc6hSamples = {{{0, 128, kFloat, 0, kOne}}};

struct FormatFacts {
  std::uint32_t vkFormat, typeSize;
  std::uint32_t blockSide, blockBytes;  // texels along x and y; levels begin at multiples of it
  std::uint32_t colorModel;
  std::span<const Sample> samples;
};
const FormatFacts kRgb9e5Facts = {123, 4, 1, 4, 1, kRgb9e5Samples};
const FormatFacts kBc6hFacts = {143, 1, 4, 16, 133, kBc6hSamples};

const FormatFacts& factsOf(HdrFormat format) {
  return format == HdrFormat::Rgb9e5 ? kRgb9e5Facts : kBc6hFacts;
}

std::uint64_t little64(ByteView bytes, std::size_t at) {
  return little32(bytes, at) | static_cast<std::uint64_t>(little32(bytes, at + 4)) << 32;
}

std::uint64_t levelBytes(const FormatFacts& facts, std::uint64_t width, std::uint64_t height) {
  const auto blocks = [&](std::uint64_t side) {
    return (side + facts.blockSide - 1) / facts.blockSide;
  };
  return blocks(width) * blocks(height) * facts.blockBytes;
}

class Writer {
 public:
  Bytes bytes;

  void put32(std::uint32_t value) { put(value, 4); }
  void put64(std::uint64_t value) { put(value, 8); }
  void text(std::string_view text) {
    for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  }
  void align(std::size_t size) { bytes.resize((bytes.size() + size - 1) / size * size); }
  void set32(std::size_t at, std::size_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> 8 * i);
  }

 private:
  void put(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>(value >> 8 * i));
  }
};

// A basic descriptor block of version 1.3 (Khronos Data Format Specification, sections 4 and 5).
void putDescriptor(const FormatFacts& facts, Writer& to) {
  constexpr std::uint32_t kVersion = 2, kBt709 = 1, kLinear = 1;
  const auto blockSize = static_cast<std::uint32_t>(24 + 16 * facts.samples.size());
  const std::uint32_t side = facts.blockSide - 1;
  to.put32(4 + blockSize);
  to.put32(0);  // of Khronos, a basic format
  to.put32(kVersion | blockSize << 16);
  to.put32(facts.colorModel | kBt709 << 8 | kLinear << 16);
  to.put32(side | side << 8);
  to.put32(facts.blockBytes);  // of plane 0
  to.put32(0);
  for (const Sample& sample : facts.samples) {
    to.put32(sample.bitOffset | (sample.bits - 1) << 16 | sample.channel << 24);
    to.put32(0);  // its position
    to.put32(sample.lower);
    to.put32(sample.upper);
  }
}

void putPair(std::string_view key, std::string_view value, Writer& to) {
  to.put32(static_cast<std::uint32_t>(key.size() + 1 + value.size() + 1));
  to.text(key);
  to.text({"\0", 1});
  to.text(value);
  to.text({"\0", 1});
  to.align(4);
}

// All up to the texels.
Writer headerOf(const FormatFacts& facts, const Image& image, std::size_t layers) {
  Writer to;
  to.text(kIdentifier);
  to.put32(facts.vkFormat);
  to.put32(facts.typeSize);
  to.put32(static_cast<std::uint32_t>(image.width()));
  to.put32(static_cast<std::uint32_t>(image.height()));
  to.put32(0);  // depth
  to.put32(layers > 1 ? static_cast<std::uint32_t>(layers) : 0);
  to.put32(1);  // faces
  to.put32(1);  // levels
  to.put32(0);  // supercompression
  to.bytes.resize(kHeaderBytes + kLevelBytes);
  to.set32(kDescriptorAt, to.bytes.size());
  putDescriptor(facts, to);
  to.set32(kPairsAt, to.bytes.size());
  to.set32(kDescriptorSize, to.bytes.size() - (kHeaderBytes + kLevelBytes));
  const std::size_t pairs = to.bytes.size();
  putPair("KTXorientation", "rd", to);
  putPair("KTXwriter", "Lucerna", to);
  to.set32(kPairsSize, to.bytes.size() - pairs);
  to.align(facts.blockBytes);
  return to;
}

void putRgb9e5(const Image& image, std::span<std::byte> to) {
  const Image colors = converted(image, ComponentType::F32, 3);
  const auto values = colors.as<float>();
  parallelFor(values.size() / 3, kConversionGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t bits = toRgb9e5({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
      for (std::size_t b = 0; b < 4; ++b) to[4 * i + b] = static_cast<std::byte>(bits >> 8 * b);
    }
  });
}

Image imageOfRgb9e5(ByteView texels, int width, int height) {
  Image image(width, height, 3, ComponentType::F32);
  const auto values = image.as<float>();
  parallelFor(values.size() / 3, kConversionGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const vec3 color = fromRgb9e5(little32(texels, 4 * i));
      for (int c = 0; c < 3; ++c) values[3 * i + c] = color[c];
    }
  });
  return image;
}

Error corrupt(const std::string& name, std::string_view what) {
  return codec::corrupt(name, "KTX2", what);
}

bool lies(std::uint64_t at, std::uint64_t size, ByteView bytes) {
  return at <= bytes.size() && size <= bytes.size() - at;
}

Result<HdrFormat> readFormat(ByteView bytes, const std::string& name) {
  if (!codec::startsWith(bytes, kIdentifier)) return corrupt(name, "its identifier is damaged");
  if (bytes.size() < kHeaderBytes + kLevelBytes)
    return corrupt(name, fmt::format("{} bytes, of which the header takes {}", bytes.size(),
                                     kHeaderBytes + kLevelBytes));
  const std::uint32_t vkFormat = little32(bytes, kVkFormat), scheme = little32(bytes, kScheme);
  if (vkFormat != kRgb9e5Facts.vkFormat && vkFormat != kBc6hFacts.vkFormat)
    return error(
        ErrorKind::Input,
        "{}: KTX2 of VkFormat {}; E5B9G9R9_UFLOAT_PACK32 (123) and BC6H_UFLOAT_BLOCK (143) "
        "are read; convert it to one of these or to EXR",
        name, vkFormat);
  if (scheme != 0)
    return error(ErrorKind::Input,
                 "{}: KTX2 of supercompression scheme {}; none (0) is read; write it without", name,
                 scheme);
  return vkFormat == kRgb9e5Facts.vkFormat ? HdrFormat::Rgb9e5 : HdrFormat::Bc6h;
}

Status checkShape(ByteView bytes, const FormatFacts& facts, const std::string& name) {
  const std::uint32_t width = little32(bytes, kWidth), height = little32(bytes, kHeight),
                      depth = little32(bytes, kDepth), faces = little32(bytes, kFaces),
                      levels = little32(bytes, kLevels);
  if (depth != 0 || faces != 1)
    return error(
        ErrorKind::Input,
        "{}: KTX2 of depth {} and {} faces; textures in two dimensions (0 and 1) and arrays "
        "of them are read",
        name, depth, faces);
  if (width == 0 || height == 0) return corrupt(name, "its header declares a size of zero");
  if (std::max({width, height, little32(bytes, kLayers)}) > std::uint32_t{kMost})
    return corrupt(name, "its header declares 2^31 texels or layers, or more, along a side");
  if (little32(bytes, kTypeSize) != facts.typeSize)
    return corrupt(name, fmt::format("a type size of {}, {} was wanted", little32(bytes, kTypeSize),
                                     facts.typeSize));
  if (levels > static_cast<std::uint32_t>(std::bit_width(std::max(width, height))) ||
      (levels == 0 && facts.blockSide > 1))
    return corrupt(name, fmt::format("{} levels for {}x{} texels", levels, width, height));
  if (little64(bytes, kGlobalSize) != 0)
    return corrupt(name, "data of a supercompression that is not there");
  return {};
}

// What says how texels are to be read must say what the VkFormat says; limits of samples and
// primary colours may differ.
Status checkDescriptor(ByteView bytes, const FormatFacts& facts, std::size_t from,
                       const std::string& name) {
  const std::uint32_t at = little32(bytes, kDescriptorAt), size = little32(bytes, kDescriptorSize);
  const std::size_t least = 4 + 24 + 16 * facts.samples.size();
  if (at != from || !lies(at, size, bytes) || size < least || size % 4 != 0 ||
      little32(bytes, at) != size)
    return corrupt(name, "its data format descriptor is not where the header says");
  const std::uint32_t side = facts.blockSide - 1, model = little32(bytes, at + 12),
                      transfer = model >> 16 & 0xff;
  if (little32(bytes, at + 4) != 0 || little32(bytes, at + 8) >> 16 != least - 4 ||
      (model & 0xff) != facts.colorModel || little32(bytes, at + 16) != (side | side << 8) ||
      little32(bytes, at + 20) != facts.blockBytes || little32(bytes, at + 24) != 0)
    return corrupt(name, "its data format descriptor contradicts its VkFormat");
  if (transfer > 1)
    return error(ErrorKind::Input,
                 "{}: KTX2 of transfer function {}; linear light (1) is read; export it as such",
                 name, transfer);
  for (std::size_t i = 0; i < facts.samples.size(); ++i) {
    const Sample& sample = facts.samples[i];
    if (little32(bytes, at + 28 + 16 * i) !=
        (sample.bitOffset | (sample.bits - 1) << 16 | sample.channel << 24))
      return corrupt(name, "its data format descriptor contradicts its VkFormat");
  }
  return {};
}

std::string_view textOf(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Status checkPair(std::string_view pair, const std::string& name) {
  const std::size_t end = pair.find('\0');
  if (end == std::string_view::npos || end == 0)
    return corrupt(name, "a key without a name or an end");
  const std::string_view value = pair.substr(end + 1);
  if (pair.substr(0, end) == "KTXorientation" && value.substr(0, value.find('\0')) != "rd")
    return error(ErrorKind::Input,
                 "{}: KTX2 whose KTXorientation is not 'rd'; turn its rows so that they run to the "
                 "right and downwards",
                 name);
  return {};
}

Status checkPairs(ByteView bytes, std::size_t from, const std::string& name) {
  const std::uint32_t at = little32(bytes, kPairsAt), size = little32(bytes, kPairsSize);
  if (size == 0) return {};
  if (at != from || !lies(at, size, bytes))
    return corrupt(name, "its keys and values are not where the header says");
  ByteView rest = bytes.subspan(at, size);
  while (!rest.empty()) {
    const std::uint64_t length = little32(rest, 0), padded = (length + 3) / 4 * 4;
    if (rest.size() < 4 || length < 2 || padded > rest.size() - 4)
      return corrupt(name, "a key and its value end beyond their place");
    LUCERNA_TRY_VOID(checkPair(textOf(rest.subspan(4, length)), name));
    rest = rest.subspan(4 + padded);
  }
  return {};
}

// Gives the largest level.
Result<ByteView> readLevels(ByteView bytes, const FormatFacts& facts, std::size_t from,
                            const std::string& name) {
  const std::uint64_t layers = std::max(little32(bytes, kLayers), 1u);  // all below 2^31
  const std::uint32_t width = little32(bytes, kWidth), height = little32(bytes, kHeight);
  const std::size_t levels = std::max(little32(bytes, kLevels), 1u);
  ByteView largest;
  for (std::size_t level = 0; level < levels; ++level) {
    const std::size_t entry = kHeaderBytes + kLevelBytes * level;
    const std::uint64_t at = little64(bytes, entry), size = little64(bytes, entry + 8);
    const std::uint64_t layer =
        levelBytes(facts, std::max(width >> level, 1u), std::max(height >> level, 1u));
    // Compares by division: the product may not fit.
    if (size / layers != layer || size % layers != 0 || little64(bytes, entry + 16) != size)
      return corrupt(name, fmt::format("level {} of {} layers of {}x{} texels takes {} bytes",
                                       level, layers, width >> level, height >> level, size));
    if (at < from || !lies(at, size, bytes) || at % facts.blockBytes != 0)
      return error(
          ErrorKind::Input,
          "{}: level {} of {} bytes from byte {} on, but the file has {}: it is truncated or "
          "corrupt",
          name, level, size, at, bytes.size());
    if (level == 0) largest = bytes.subspan(at, size);
  }
  return largest;
}

// 64 bits hold it, as each texel takes a byte of the file, or more.
std::uint64_t decodedBytes(const Ktx2Texture& texture) {
  return std::uint64_t(texture.width) * std::uint64_t(texture.height) *
         std::uint64_t(texture.layers) * 3 * sizeof(float);
}

Status checkLimits(const Ktx2Texture& texture, const std::string& name, const ImageLimits& limits) {
  if (texture.width > limits.maxSide || texture.height > limits.maxSide)
    return error(ErrorKind::Input,
                 "{}: its KTX2 header declares {}x{} texels; at most {} a side are read; make it "
                 "smaller",
                 name, texture.width, texture.height, limits.maxSide);
  if (decodedBytes(texture) > limits.maxBytes)
    return error(
        ErrorKind::Input,
        "{}: its KTX2 header declares {} layers of {}x{} texels, which take {} once decoded; "
        "at most {} are read; take some out",
        name, texture.layers, texture.width, texture.height, bytesText(decodedBytes(texture)),
        bytesText(limits.maxBytes));
  return {};
}

bool recognises(ByteView bytes) {
  return codec::startsWith(bytes, kIdentifier);
}

Result<codec::Header> readHeader(ByteView bytes, const std::string& name) {
  LUCERNA_TRY(texture, parseKtx2(bytes, name, kNoLimits));
  if (texture.layers > 1)
    return error(ErrorKind::Input, "{}: KTX2 of {} layers, a picture has one; give one layer alone",
                 name, texture.layers);
  return codec::Header{{"KTX2", texture.width, texture.height, 3, ComponentType::F32}, 0};
}

Result<Image> decode(ByteView bytes, const std::string& name) {
  LUCERNA_TRY(texture, parseKtx2(bytes, name, kNoLimits));
  return decodedLayer(texture, 0);
}

}  // namespace

namespace codec {
const Format kKtx2 = {"KTX2", ".ktx2", recognises, readHeader, decode};
}

Bytes encodeKtx2(std::span<const Image> layers, HdrFormat format) {
  CHECK(!layers.empty());
  const FormatFacts& facts = factsOf(format);
  const Image& first = layers[0];
  Writer to = headerOf(facts, first, layers.size());
  const auto layer = static_cast<std::size_t>(levelBytes(facts, first.width(), first.height()));
  const std::size_t begin = to.bytes.size(), size = layer * layers.size();
  to.set32(kHeaderBytes, begin);
  for (const std::size_t at : {kHeaderBytes + 8, kHeaderBytes + 16}) {
    to.set32(at, size & 0xffffffff);
    to.set32(at + 4, size >> 32);
  }
  to.bytes.resize(begin + size);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const Image& image = layers[i];
    CHECK(image.width() == first.width() && image.height() == first.height());
    CHECK(image.channels() >= 3 && bytesPer(image.type()) >= 2 &&
          image.type() != ComponentType::U16);
    const auto place = std::span(to.bytes).subspan(begin + i * layer, layer);
    if (format == HdrFormat::Rgb9e5)
      putRgb9e5(image, place);
    else
      std::ranges::copy(encodeBc6h(image), place.begin());
  }
  return std::move(to.bytes);
}

Status writeKtx2(const std::filesystem::path& path, std::span<const Image> layers,
                 HdrFormat format) {
  return writeFile(path, encodeKtx2(layers, format));
}

Result<Ktx2Texture> parseKtx2(ByteView bytes, const std::string& name, const ImageLimits& limits) {
  LUCERNA_TRY(format, readFormat(bytes, name));
  const FormatFacts& facts = factsOf(format);
  LUCERNA_TRY_VOID(checkShape(bytes, facts, name));
  // One after the other, without gaps.
  const std::size_t descriptor =
      kHeaderBytes + kLevelBytes * std::max(little32(bytes, kLevels), 1u);
  LUCERNA_TRY_VOID(checkDescriptor(bytes, facts, descriptor, name));
  const std::size_t pairs = descriptor + little32(bytes, kDescriptorSize);
  LUCERNA_TRY_VOID(checkPairs(bytes, pairs, name));
  const std::size_t levels = pairs + little32(bytes, kPairsSize);
  LUCERNA_TRY(texels, readLevels(bytes, facts, levels, name));
  const Ktx2Texture texture = {format, static_cast<int>(little32(bytes, kWidth)),
                               static_cast<int>(little32(bytes, kHeight)),
                               static_cast<int>(std::max(little32(bytes, kLayers), 1u)), texels};
  LUCERNA_TRY_VOID(checkLimits(texture, name, limits));
  return texture;
}

Image decodedLayer(const Ktx2Texture& texture, int layer) {
  CHECK(layer >= 0 && layer < texture.layers);
  return texture.format == HdrFormat::Rgb9e5
             ? imageOfRgb9e5(texture.layer(layer), texture.width, texture.height)
             : decodeBc6h(texture.layer(layer), texture.width, texture.height);
}

Result<std::vector<Image>> decodeKtx2(ByteView bytes, const std::string& name,
                                      const ImageLimits& limits) {
  LUCERNA_TRY(texture, parseKtx2(bytes, name, limits));
  std::vector<Image> layers;
  for (int i = 0; i < texture.layers; ++i) layers.push_back(decodedLayer(texture, i));
  return layers;
}

Result<std::vector<Image>> readKtx2(const std::filesystem::path& path, const ImageLimits& limits) {
  LUCERNA_TRY(bytes, readFile(path));
  return decodeKtx2(bytes, path.string(), limits);
}

}  // namespace lucerna
