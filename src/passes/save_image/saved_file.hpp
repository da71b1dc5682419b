// The file that SaveImage writes: its name, what it can hold, and the form of texels in it. No GL.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/numbered_path.hpp"
#include "gpu/format.hpp"
#include "image/image.hpp"

namespace lucerna::passes {

class SavedFile {
 public:
  enum class Kind { Png, Exr, Hdr };

  // pattern: "depth.exr", "depth-%04d.exr". Errors (ErrorKind::Usage): another ending, a '%' that
  // is no number, a folder that does not exist.
  static Result<SavedFile> parse(const std::string& pattern);

  Kind kind() const { return kind_; }
  // Of several views each has a file of its own: "depth-0003-view1.exr".
  std::filesystem::path at(std::uint64_t frame, int view, int viewCount) const;

  // The formats that such a file holds in a sensible way: all in EXR; colours in HDR; colours and
  // integers of up to 16 bits in PNG.
  std::vector<gpu::Format> formats() const;

  // texels: as Device::download() gives those of a texture of that format, top row first. What is
  // written: EXR every channel, as floats, and HDR colours, both linear, so sRGB formats are
  // decoded; PNG the stored numbers, and of float formats sRGB-encoded colours. HDR and PNG leave
  // alpha out and give two channels a blue of 0.
  Image content(const Image& texels, gpu::Format format) const;
  Status write(const std::filesystem::path& path, const Image& content) const;

 private:
  SavedFile(NumberedPath path, Kind kind) : path_(std::move(path)), kind_(kind) {}

  NumberedPath path_;
  Kind kind_;
};

}  // namespace lucerna::passes
