// Writes finished frames to picture files, or into a video.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/frame_name.hpp"
#include "app/session.hpp"
#include "image/video.hpp"

namespace lucerna::app {

class FrameWriter {
 public:
  // Checks everything that can be checked before the first frame. Errors: ErrorKind::Usage;
  // ErrorKind::Failed if a video cannot be written there.
  static Result<FrameWriter> create(const OutputSettings& output, const RenderSettings& settings);

  // What openSession() must keep: nothing for PNG, the linear colour and further layers otherwise.
  const std::vector<LayerKind>& layers() const { return wanted_; }

  // A FrameSink: PNG and video are the pipeline's output; HDR and EXR hold linear values from
  // before the tone map.
  Status write(Session& session, const gpu::Texture& output);
  // Ends a video with the frames written so far; without it there is none.
  Status finish();
  const std::vector<std::filesystem::path>& written() const { return written_; }

 private:
  explicit FrameWriter(FrameName name) : name_(std::move(name)) {}
  Status openVideo(const OutputSettings& output, const RenderSettings& settings);
  Status writeLayers(Session& session, const std::filesystem::path& path);

  FrameName name_;
  ComponentType exrType_ = ComponentType::Half;
  std::vector<LayerKind> layers_;  // to be written
  std::vector<LayerKind> wanted_;  // and what writing these needs
  std::optional<VideoWriter> video_;
  std::vector<std::filesystem::path> written_;
};

}  // namespace lucerna::app
