// HDR textures in KTX2 files (Khronos, "KTX File Format Specification", 2.0): a 2D texture or an
// array of them, one level, without supercompression, rows from top to bottom.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "core/result.hpp"
#include "image/image.hpp"
#include "image/image_file.hpp"

namespace lucerna {

enum class HdrFormat {
  Rgb9e5,  // 4 bytes a texel (rgb9e5.hpp)
  Bc6h     // 1 byte a texel (bc6h.hpp)
};

// layers: one or more of one size, F32 or Half, 3 or 4 channels, the fourth of which is left out.
// One layer gives a plain texture, more give an array. The same layers give the same bytes.
Bytes encodeKtx2(std::span<const Image> layers, HdrFormat format);
Status writeKtx2(const std::filesystem::path& path, std::span<const Image> layers,
                 HdrFormat format);

// What a file holds, for textures that a GPU decodes. It refers to the bytes it was read from.
struct Ktx2Texture {
  HdrFormat format = HdrFormat::Rgb9e5;
  int width = 0, height = 0;
  int layers = 1;                     // of an array or of none
  std::span<const std::byte> texels;  // of the largest level: all layers, equally large

  std::span<const std::byte> layer(int index) const {
    const std::size_t size = texels.size() / static_cast<std::size_t>(layers);
    return texels.subspan(static_cast<std::size_t>(index) * size, size);
  }
};

// Reads nothing but the header and allocates nothing; what it gives lies within `bytes`. Smaller
// levels are checked and left out. `limits` hold for the sides of a layer and for the bytes of all
// of them as F32 RGB. Errors (ErrorKind::Input): other formats, supercompression, cubes, volumes
// and orientations; files that break the specification; `name` is used in messages.
Result<Ktx2Texture> parseKtx2(std::span<const std::byte> bytes, const std::string& name,
                              const ImageLimits& limits = {});

// F32, red, green, blue.
Image decodedLayer(const Ktx2Texture& texture, int layer);
Result<std::vector<Image>> decodeKtx2(std::span<const std::byte> bytes, const std::string& name,
                                      const ImageLimits& limits = {});
Result<std::vector<Image>> readKtx2(const std::filesystem::path& path,
                                    const ImageLimits& limits = {});

}  // namespace lucerna
