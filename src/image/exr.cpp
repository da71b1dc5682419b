// OpenEXR, read from and written to memory.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <map>

#include "core/text.hpp"
#include "image/codec.hpp"
#include "image/exr_header.hpp"
#include "image/exr_streams.hpp"

namespace lucerna::codec {
namespace {

// The greatest ratio that a compression was seen or is argued to reach. DWA stores a blank block of
// 8x8 values in next to nothing; every chunk of lines costs 16 bytes at least, which bounds all.
constexpr std::uint64_t kExrRatio = 8 * kDeflateRatio;
constexpr std::uint64_t kDwaRatio = 64 * kDeflateRatio;
constexpr std::uint32_t kDwaA = 8, kDwaB = 9;

bool recognises(ByteView bytes) {
  return startsWith(bytes, "\x76\x2f\x31\x01");
}

// The order in which the channels of a layer are interleaved: colours, axes, alpha, others.
int channelRank(const std::string& channel) {
  static constexpr std::string_view kOrder[] = {"R", "G", "B", "X", "Y", "Z", "A"};
  const auto* found = std::find(std::begin(kOrder), std::end(kOrder), channel);
  return static_cast<int>(found - std::begin(kOrder));
}

void sortChannels(std::vector<std::string>& channels) {
  std::stable_sort(channels.begin(), channels.end(),
                   [](const auto& a, const auto& b) { return channelRank(a) < channelRank(b); });
}

std::string layerOf(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}
std::string lastName(const std::string& channel) {
  return channel.substr(channel.rfind('.') + 1);
}

// The channels that decodeImage takes from the unnamed layer.
std::vector<std::string> mainChannels(std::span<const std::string> all) {
  const auto has = [&](std::string_view name) {
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  std::vector<std::string> result;
  if (has("R") || has("G") || has("B"))
    result = {"R", "G", "B"};
  else if (has("Y"))
    result = {"Y"};
  else if (all.size() == 1)
    return {all.front()};
  if (!result.empty() && has("A")) result.push_back("A");
  return result;
}

Result<Header> readHeader(ByteView bytes, const std::string& name) {
  LUCERNA_TRY(exr, readExrHeader(bytes, name));
  if (exr.width > 0x7fffffff || exr.height > 0x7fffffff)
    return corrupt(name, "EXR", "the data window is wider or higher than 2^31");
  std::vector<std::string> names;
  std::uint64_t pixelBytes = 0;
  for (const ExrChannel& channel : exr.channels) {
    if (layerOf(channel.name).empty()) names.push_back(channel.name);
    pixelBytes += channel.bytes;
  }
  const bool dwa = exr.compression == kDwaA || exr.compression == kDwaB;
  const std::uint64_t values = static_cast<std::uint64_t>(exr.width) * exr.height;
  Header header;
  header.info = {"EXR", static_cast<int>(exr.width), static_cast<int>(exr.height),
                 static_cast<int>(mainChannels(names).size()), ComponentType::F32};
  // Sizes beyond any limit are told by decodeImage; keep the product within 64 bits.
  header.leastBytes = std::min(values, std::uint64_t{1} << 48) *
                      std::min<std::uint64_t>(pixelBytes, 1 << 12) /
                      (exr.compression == 0 ? 1
                       : dwa                ? kDwaRatio
                                            : kExrRatio);
  if (!exr.tiled) header.leastBytes = std::max(header.leastBytes, values / exr.width / 256 * 16);
  return header;
}

std::vector<std::string> channelNames(const Imf::ChannelList& channels) {
  std::vector<std::string> names;
  for (auto it = channels.begin(); it != channels.end(); ++it) names.emplace_back(it.name());
  return names;
}

// Reads channels prefix + names[i] of a part into one image. Throws what OpenEXR throws.
Result<Image> readChannels(Imf::InputPart& part, const std::string& prefix,
                           const std::vector<std::string>& names, ComponentType type,
                           const std::string& file) {
  const Imath::Box2i window = part.header().dataWindow();
  const Imf::ChannelList& channels = part.header().channels();
  for (const std::string& name : names)
    if (const Imf::Channel* channel = channels.findChannel(prefix + name);
        channel && (channel->xSampling != 1 || channel->ySampling != 1))
      return error(ErrorKind::Input,
                   "{}: channel '{}' is subsampled {}x{}; only full resolution is read", file,
                   prefix + name, channel->xSampling, channel->ySampling);
  Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
              static_cast<int>(names.size()), type);
  const std::size_t component = bytesPer(type);
  Imf::FrameBuffer target;
  for (std::size_t c = 0; c < names.size(); ++c)
    target.insert(
        prefix + names[c],
        Imf::Slice::Make(type == ComponentType::Half ? Imf::HALF : Imf::FLOAT,
                         image.bytes().data() + c * component, window, component * names.size(),
                         image.rowBytes(), 1, 1, names[c] == "A" ? 1.0 : 0.0));
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
  return image;
}

Result<Image> decodeMain(ByteView bytes, const std::string& name) {
  MemoryInput stream(bytes, name);
  Imf::MultiPartInputFile file(stream);
  Imf::InputPart part(file, 0);
  const std::vector<std::string> all = channelNames(part.header().channels());
  std::vector<std::string> unnamed;
  std::copy_if(all.begin(), all.end(), std::back_inserter(unnamed),
               [](const std::string& channel) { return layerOf(channel).empty(); });
  const std::vector<std::string> wanted = mainChannels(unnamed);
  if (wanted.empty())
    return error(ErrorKind::Input,
                 "{}: has channels {}; R, G, B, A or Y were wanted, outside any layer", name,
                 join(all));
  return readChannels(part, "", wanted, ComponentType::F32, name);
}

// Appends the layers of one part. Channels of a named part without a layer take the part's name.
Status appendLayers(Imf::InputPart& part, bool severalParts, const std::string& name,
                    std::vector<ExrLayer>& layers) {
  std::map<std::string, std::vector<std::string>> grouped;
  for (const std::string& channel : channelNames(part.header().channels()))
    grouped[layerOf(channel)].push_back(lastName(channel));
  for (auto& [layer, channels] : grouped) {
    if (channels.size() > 4)
      return error(ErrorKind::Input, "{}: layer '{}' has {} channels; at most 4 are read", name,
                   layer, channels.size());
    sortChannels(channels);
    const std::string prefix = layer.empty() ? "" : layer + ".";
    const bool half = std::all_of(channels.begin(), channels.end(), [&](const auto& channel) {
      return part.header().channels()[prefix + channel].type == Imf::HALF;
    });
    LUCERNA_TRY(image, readChannels(part, prefix, channels,
                                    half ? ComponentType::Half : ComponentType::F32, name));
    const bool usePart = layer.empty() && severalParts && part.header().hasName();
    layers.push_back({usePart ? part.header().name() : layer, channels, std::move(image)});
  }
  return {};
}

// Of all channels of a part, none of them taking more than a float.
ImageInfo infoOf(const Imf::Header& header) {
  const Imath::Box2i window = header.dataWindow();
  return {"EXR", window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
          static_cast<int>(channelNames(header.channels()).size()), ComponentType::F32};
}

Status checkParts(const Imf::MultiPartInputFile& file, const std::string& name,
                  const ImageLimits& limits) {
  std::uint64_t decoded = 0;
  for (int i = 0; i < file.parts(); ++i) {
    const ImageInfo info = infoOf(file.header(i));
    if (info.width > limits.maxSide || info.height > limits.maxSide)
      return error(ErrorKind::Input,
                   "{}: part {} has {}x{} pixels; at most {} a side are read; make it smaller",
                   name, i + 1, info.width, info.height, limits.maxSide);
    decoded += info.bytes();
    if (decoded > limits.maxBytes)
      return error(ErrorKind::Input, "{}: its layers take more than {} once decoded; take some out",
                   name, bytesText(limits.maxBytes));
  }
  return {};
}

Result<std::vector<ExrLayer>> decodeAll(ByteView bytes, const std::string& name,
                                        const ImageLimits& limits) {
  MemoryInput stream(bytes, name);
  Imf::MultiPartInputFile file(stream);
  LUCERNA_TRY_VOID(checkParts(file, name, limits));
  std::vector<ExrLayer> layers;
  for (int i = 0; i < file.parts(); ++i) {
    Imf::InputPart part(file, i);
    LUCERNA_TRY_VOID(appendLayers(part, file.parts() > 1, name, layers));
  }
  return layers;
}

// OpenEXR reports by exceptions; they end here.
template <typename Read>
auto withoutExceptions(const std::string& name, Read read) -> decltype(read()) {
  const ImageLimits limits;
  Imf::Header::setMaxImageSize(limits.maxSide, limits.maxSide);
  Imf::Header::setMaxTileSize(limits.maxSide, limits.maxSide);
  try {
    return read();
  } catch (const std::exception& exception) {
    return corrupt(name, "EXR", exception.what());
  }
}

Result<Image> decode(ByteView bytes, const std::string& name) {
  return withoutExceptions(name, [&] { return decodeMain(bytes, name); });
}

Status checkLayers(std::span<const ExrSource> layers, const std::string& name) {
  CHECK(!layers.empty());
  for (const ExrSource& layer : layers) {
    const ComponentType type = layer.image.type();
    CHECK(layer.channels.size() == static_cast<std::size_t>(layer.image.channels()));
    CHECK(layer.image.width() == layers[0].image.width() &&
          layer.image.height() == layers[0].image.height());
    if (type != ComponentType::F32 && type != ComponentType::Half)
      return error(ErrorKind::Usage, "{}: EXR holds linear floats; write 8-bit pictures as .png",
                   name);
  }
  return {};
}

void addLayer(const ExrSource& layer, Imf::Header& header, Imf::FrameBuffer& source) {
  const Image& image = layer.image;
  const Imf::PixelType type = image.type() == ComponentType::Half ? Imf::HALF : Imf::FLOAT;
  const std::size_t component = bytesPer(image.type());
  for (std::size_t c = 0; c < layer.channels.size(); ++c) {
    const std::string channel =
        layer.name.empty() ? layer.channels[c] : layer.name + "." + layer.channels[c];
    header.channels().insert(channel, Imf::Channel(type));
    auto* first = reinterpret_cast<char*>(const_cast<std::byte*>(image.bytes().data()));
    source.insert(channel, Imf::Slice(type, first + c * component,
                                      component * layer.channels.size(), image.rowBytes()));
  }
}

}  // namespace

const Format kExr = {"EXR", ".exr", recognises, readHeader, decode};

Result<std::vector<ExrLayer>> decodeExrLayers(ByteView bytes, const std::string& name,
                                              const ImageLimits& limits) {
  return withoutExceptions(name, [&] { return decodeAll(bytes, name, limits); });
}

Result<Bytes> encodeExr(std::span<const ExrSource> layers, const std::string& name) {
  LUCERNA_TRY_VOID(checkLayers(layers, name));
  try {
    Imf::Header header(layers[0].image.width(), layers[0].image.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer source;
    for (const ExrSource& layer : layers) addLayer(layer, header, source);
    MemoryOutput stream(name);
    {
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(source);
      file.writePixels(layers[0].image.height());
    }  // writes the offsets
    return stream.takeBytes();
  } catch (const std::exception& exception) {
    return error(ErrorKind::Failed, "{}: encoding the EXR failed: {}", name, exception.what());
  }
}

}  // namespace lucerna::codec
