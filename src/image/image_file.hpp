// Image files behind one interface: PNG, JPEG, TGA, BMP, HDR (RGBE), EXR, KTX2 (one layer of HDR,
// see ktx2.hpp; only read here). The content decides the format when reading (the extension only
// breaks ties), the extension when writing.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "core/result.hpp"
#include "image/image.hpp"

namespace lucerna {

struct ImageLimits {
  int maxSide = 32768;
  std::uint64_t maxBytes = 2ull << 30;  // once decoded: 16384 x 8192 as F32 RGBA
};

// PNG keeps 8 or 16 bits; JPEG, TGA and BMP give U8; HDR and KTX2 give F32 RGB; EXR gives F32 with
// the channels R G B A or Y of the part's unnamed layer. U8/U16 values are as stored (sRGB for
// colour pictures), F32 is linear. `name` is used in messages. Sizes in headers are checked against
// `limits` and against what the file can hold before anything is allocated.
Result<Image> decodeImage(std::span<const std::byte> bytes, const std::string& name,
                          const ImageLimits& limits = {});
Result<Image> readImage(const std::filesystem::path& path, const ImageLimits& limits = {});

struct ImageInfo {
  std::string format;  // "PNG", "JPEG", ...
  int width = 0, height = 0, channels = 0;
  ComponentType type = ComponentType::U8;

  // Of the decoded picture; sides below zero count as none.
  std::uint64_t bytes() const;
};
// Reads only the header.
Result<ImageInfo> imageInfo(std::span<const std::byte> bytes, const std::string& name);

// .png (U8/U16, 1 to 4 channels), .hdr (F32), .exr (F32 or Half), as the extension says; the path
// is used in messages too.
Result<Bytes> encodeImage(const std::filesystem::path& path, const Image& image);
// Writes beside the target and renames.
Status writeImage(const std::filesystem::path& path, const Image& image);

// One file with several named layers; "" is the main one (R, G, B, A), "depth" gives depth.Z or
// depth.R..., as the channel names say.
struct ExrLayer {
  std::string name;
  std::vector<std::string>
      channels;  // as many as the image has, e.g. {"R","G","B"}, {"Z"}, {"X","Y","Z"}
  Image image;   // F32 or Half; all layers have the same size
};
Status writeExr(const std::filesystem::path& path, const std::vector<ExrLayer>& layers);
// The limits hold for the sides of each part and for the bytes of all of them together.
Result<std::vector<ExrLayer>> decodeExrLayers(std::span<const std::byte> bytes,
                                              const std::string& name,
                                              const ImageLimits& limits = {});
Result<std::vector<ExrLayer>> readExrLayers(const std::filesystem::path& path);

}  // namespace lucerna
