// Writes finished frames to picture files.
#pragma once

#include <filesystem>
#include <vector>

#include "app/frame_name.hpp"
#include "app/session.hpp"

namespace lucerna::app {

class FrameWriter {
 public:
  // Checks everything that can be checked before the first frame. Errors: ErrorKind::Usage.
  static Result<FrameWriter> create(const OutputSettings& output, const RenderSettings& settings);

  // What openSession() must keep: nothing for PNG, the linear colour and further layers otherwise.
  const std::vector<LayerKind>& layers() const { return wanted_; }

  // A FrameSink: PNG is the pipeline's output; HDR and EXR hold linear values from before the tone
  // map.
  Status write(Session& session, const gpu::Texture& output);
  const std::vector<std::filesystem::path>& written() const { return written_; }

 private:
  explicit FrameWriter(FrameName name) : name_(std::move(name)) {}
  Status writeLayers(Session& session, const std::filesystem::path& path);

  FrameName name_;
  ComponentType exrType_ = ComponentType::Half;
  std::vector<LayerKind> layers_;  // to be written
  std::vector<LayerKind> wanted_;  // and what writing these needs
  std::vector<std::filesystem::path> written_;
};

}  // namespace lucerna::app
