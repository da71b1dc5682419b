// Writes video files through libav: H.264 in MP4 or Matroska, lossless FFV1 in Matroska.
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.hpp"
#include "image/image.hpp"

namespace lucerna {

enum class VideoCodec { H264, Ffv1 };

struct VideoSettings {
  // px, some 260 million in all; of H.264 even, as its colours have half the resolution, and at
  // most 16384; of FFV1 at least 3
  int width = 0, height = 0;
  double framesPerSecond = 30;  // 0.001 to 1000
  VideoCodec codec = VideoCodec::H264;
  int crf = 18;  // H.264: constant rate factor, 0 to 51; 18 is hard to tell from the original
};

// What is wrong with the settings, or with the codec in a file of that name (ErrorKind::Usage).
Status checkVideo(const std::filesystem::path& path, const VideoSettings& settings);
bool isVideoName(const std::filesystem::path& path);  // .mp4 or .mkv

// One file, picture by picture. Encodes on the calling thread, so that the same pictures give the
// same bytes; memory does not grow with their number. The file appears under its name in finish();
// without it nothing stays behind.
class VideoWriter {
 public:
  static Result<VideoWriter> create(const std::filesystem::path& path,
                                    const VideoSettings& settings);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  ~VideoWriter();

  // picture: U8, RGB, sRGB-encoded, of the settings' size. Errors: ErrorKind::Failed.
  Status add(const Image& picture);
  // Ends the file, which takes at least one picture.
  Status finish();

 private:
  struct Impl;
  explicit VideoWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lucerna
