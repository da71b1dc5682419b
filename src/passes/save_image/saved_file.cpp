#include "passes/save_image/saved_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/file.hpp"
#include "core/text.hpp"
#include "image/image_file.hpp"

namespace lucerna::passes {
namespace {

using gpu::FormatClass;
using Kind = SavedFile::Kind;

bool isColor(FormatClass kind) {
  return kind == FormatClass::Float || kind == FormatClass::Unorm;
}

bool holds(Kind file, const gpu::FormatInfo& format) {
  if (file == Kind::Exr || isColor(format.kind)) return true;
  const bool small = format.bytes / format.channels <= 2;
  return file == Kind::Png && format.kind == FormatClass::Uint && small;
}

// Integers keep their value, which a float holds exactly up to 2^24.
float numberOf(const Image& texels, std::size_t i, FormatClass kind) {
  if (texels.type() == ComponentType::U8) return texels.as<std::uint8_t>()[i];
  if (texels.type() == ComponentType::U16) return texels.as<std::uint16_t>()[i];
  const auto bits = std::bit_cast<std::uint32_t>(texels.as<float>()[i]);
  return kind == FormatClass::Int ? static_cast<float>(static_cast<std::int32_t>(bits))
                                  : static_cast<float>(bits);
}

Image numbers(const Image& texels, FormatClass kind) {
  Image result(texels.width(), texels.height(), texels.channels(), ComponentType::F32);
  const auto to = result.as<float>();
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = numberOf(texels, i, kind);
  return result;
}

// Floats; of sRGB formats linear colours.
Image linear(const Image& texels, gpu::Format format) {
  const FormatClass kind = gpu::info(format).kind;
  if (kind == FormatClass::Uint || kind == FormatClass::Int) return numbers(texels, kind);
  if (texels.type() == ComponentType::Half) return texels;
  Image result = converted(texels, ComponentType::F32, texels.channels());
  if (format != gpu::Format::Srgb8Alpha8) return result;
  const auto values = result.as<float>();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % 4 != 3) values[i] = linearFromSrgb(values[i]);
  return result;
}

Image encoded(const Image& colors) {
  const Image floats = converted(colors, ComponentType::F32, colors.channels());
  Image result(colors.width(), colors.height(), colors.channels(), ComponentType::U8);
  const auto from = floats.as<float>();
  const auto to = result.as<std::uint8_t>();
  for (std::size_t i = 0; i < from.size(); ++i)
    to[i] = static_cast<std::uint8_t>(std::lround(255.f * srgbFromLinear(from[i])));
  return result;
}

// One channel stays grey, two get a blue of 0, the fourth is left out.
Image withoutAlpha(const Image& image) {
  if (image.channels() == 1 || image.channels() == 3) return image;
  Image result(image.width(), image.height(), 3, image.type());
  const std::size_t component = bytesPer(image.type());
  const std::size_t step = component * static_cast<std::size_t>(image.channels());
  const std::size_t kept = std::min(step, 3 * component);
  const std::byte* from = image.bytes().data();
  std::byte* to = result.bytes().data();
  for (; from != image.bytes().data() + image.bytes().size(); from += step, to += 3 * component)
    std::memcpy(to, from, kept);
  return result;
}

std::vector<std::string> channelNames(int count) {
  if (count == 1) return {"Y"};
  const std::vector<std::string> names{"R", "G", "B", "A"};
  return {names.begin(), names.begin() + count};
}

Result<Kind> kindOf(const std::string& pattern) {
  const std::string extension = std::filesystem::path(pattern).extension().string();
  if (equalIgnoringCase(extension, ".png")) return Kind::Png;
  if (equalIgnoringCase(extension, ".exr")) return Kind::Exr;
  if (equalIgnoringCase(extension, ".hdr")) return Kind::Hdr;
  return error(ErrorKind::Usage, "'{}', which ends in '{}'", pattern, extension);
}

}  // namespace

Result<SavedFile> SavedFile::parse(const std::string& pattern) {
  LUCERNA_TRY(kind, kindOf(pattern));
  LUCERNA_TRY(path, NumberedPath::parse(pattern));
  const std::filesystem::path folder = path.at(0).parent_path();
  std::error_code noFolder;
  if (!folder.empty() && !std::filesystem::is_directory(folder, noFolder))
    return error(ErrorKind::Usage, "'{}', whose folder does not exist", pattern);
  return SavedFile(std::move(path), kind);
}

std::filesystem::path SavedFile::at(std::uint64_t frame, int view, int viewCount) const {
  return viewCount > 1 ? path_.ofView(view).at(frame) : path_.at(frame);
}

std::vector<gpu::Format> SavedFile::formats() const {
  std::vector<gpu::Format> result;
  for (const gpu::FormatInfo& format : gpu::allFormats())
    if (holds(kind_, format)) result.push_back(format.format);
  return result;
}

Image SavedFile::content(const Image& texels, gpu::Format format) const {
  if (kind_ == Kind::Exr) return linear(texels, format);
  if (kind_ == Kind::Hdr)
    return converted(withoutAlpha(linear(texels, format)), ComponentType::F32, 3);
  const Image colors = withoutAlpha(texels);
  return gpu::info(format).kind == FormatClass::Float ? encoded(colors) : colors;
}

Status SavedFile::write(const std::filesystem::path& path, const Image& content) const {
  if (kind_ != Kind::Exr) return writeImage(path, content);
  return writeExr(path,
                  {{.name = "", .channels = channelNames(content.channels()), .image = content}});
}

}  // namespace lucerna::passes
