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
  // before the tone map. The file is written when the last of the frame's views is there.
  Status write(Session& session, int view, const gpu::Texture& output);
  // Ends a video with the frames written so far; without it there is none.
  Status finish();
  const std::vector<std::filesystem::path>& written() const { return written_; }
  const FrameName& name() const { return name_; }

 private:
  explicit FrameWriter(FrameName name) : name_(std::move(name)) {}
  // What a file holds one of or several: a layer, or the encoded picture of PNG and video.
  struct Part {
    std::optional<LayerKind> kind;  // none: the encoded picture
    ExrLayer layer;
    std::string port = {};  // that it comes from, "Row.port"; "": the pipeline's output
  };
  static Status checkPart(const Part& part, uvec2 size);
  Status openVideo(const OutputSettings& output, const RenderSettings& settings);
  Result<std::vector<Part>> read(Session& session, int view, const gpu::Texture& output) const;
  Image finished(std::size_t part, const RenderSettings& settings);
  Status writeFrame(const Session& session);

  FrameName name_;
  ComponentType exrType_ = ComponentType::Half;
  std::vector<LayerKind> layers_;        // to be written
  std::vector<LayerKind> wanted_;        // and what writing these needs
  std::vector<std::vector<Part>> eyes_;  // of the frame so far
  std::optional<VideoWriter> video_;
  std::vector<std::filesystem::path> written_;
};

}  // namespace lucerna::app
