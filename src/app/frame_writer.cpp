#include "app/frame_writer.hpp"

#include <algorithm>
#include <cmath>

#include "app/resample.hpp"
#include "core/file.hpp"
#include "image/image_file.hpp"

namespace lucerna::app {
namespace {

// Floats are taken as linear and encoded; 8-bit outputs are encoded already.
Image encodedRgb(const Image& image) {
  if (image.type() == ComponentType::U8) return converted(image, ComponentType::U8, 3);
  const Image linear = converted(image, ComponentType::F32, 3);
  Image result(linear.width(), linear.height(), 3, ComponentType::U8);
  const auto from = linear.as<float>();
  const auto to = result.as<std::uint8_t>();
  for (std::size_t i = 0; i < from.size(); ++i)
    to[i] = static_cast<std::uint8_t>(std::lround(255.f * srgbFromLinear(from[i])));
  return result;
}

// Distances and directions are not averaged.
Image resizedLayer(const Image& image, LayerKind kind, uvec2 size) {
  return kind == LayerKind::Color || kind == LayerKind::Albedo ? resizedLinear(image, size)
                                                               : resizedNearest(image, size);
}

bool holdsLinear(OutputKind kind) {
  return kind == OutputKind::Exr || kind == OutputKind::Hdr;
}

Status checkVideoFlags(const OutputSettings& output, OutputKind kind) {
  const char* flag = output.fps        ? "--fps"
                     : output.crf      ? "--crf"
                     : output.lossless ? "--lossless"
                                       : nullptr;
  if (kind == OutputKind::Video || !flag) return {};
  return error(ErrorKind::Usage, "{}: '{}' is no video; give -o NAME.mp4 or NAME.mkv", flag,
               output.path);
}

}  // namespace

Result<FrameWriter> FrameWriter::create(const OutputSettings& output,
                                        const RenderSettings& settings) {
  LUCERNA_TRY(name, FrameName::parse(output.path, settings.frames));
  LUCERNA_TRY_VOID(checkVideoFlags(output, name.kind()));
  LUCERNA_TRY_VOID(checkFolderOf(name.at(0), "-o"));
  FrameWriter writer(std::move(name));
  writer.exrType_ = output.exrType;
  for (const std::string& layer : output.layers) {
    LUCERNA_TRY(kind, layerFromName(layer));
    if (std::find(writer.layers_.begin(), writer.layers_.end(), kind) == writer.layers_.end())
      writer.layers_.push_back(kind);
  }
  if (!output.layers.empty() && writer.name_.kind() != OutputKind::Exr)
    return error(ErrorKind::Usage, "--layers: '{}' holds one picture; layers need -o NAME.exr",
                 output.path);
  if (writer.layers_.empty() && holdsLinear(writer.name_.kind()))
    writer.layers_.push_back(LayerKind::Color);
  writer.wanted_ = writer.layers_;
  const auto has = [&](LayerKind kind) {
    return std::find(writer.layers_.begin(), writer.layers_.end(), kind) != writer.layers_.end();
  };
  // Where the depth is empty there is no normal.
  if (has(LayerKind::Normal) && !has(LayerKind::Depth)) writer.wanted_.push_back(LayerKind::Depth);
  if (writer.name_.kind() == OutputKind::Video)
    LUCERNA_TRY_VOID(writer.openVideo(output, settings));
  return writer;
}

Status FrameWriter::openVideo(const OutputSettings& output, const RenderSettings& settings) {
  if (!output.fps && settings.timeStep <= 0)
    return error(ErrorKind::Usage,
                 "-o: '{}' needs a frame rate, and --time-step 0 gives none; add --fps",
                 output.path);
  VideoSettings video{.width = static_cast<int>(settings.size.x),
                      .height = static_cast<int>(settings.size.y),
                      .framesPerSecond = output.fps ? *output.fps : 1 / settings.timeStep,
                      .codec = output.lossless ? VideoCodec::Ffv1 : VideoCodec::H264};
  if (output.crf) video.crf = *output.crf;
  LUCERNA_TRY(opened, VideoWriter::create(name_.at(0), video));
  video_ = std::move(opened);
  return {};
}

Status FrameWriter::write(Session& session, const gpu::Texture& output) {
  const std::filesystem::path path = name_.at(session.frame);
  if (holdsLinear(name_.kind())) {
    LUCERNA_TRY_VOID(writeLayers(session, path));
  } else {
    const Image picture =
        resizedSrgb(encodedRgb(session.device->download(output)), session.settings.size);
    LUCERNA_TRY_VOID(video_ ? video_->add(picture) : writeImage(path, picture));
  }
  if (!video_ || written_.empty()) written_.push_back(path);
  return {};
}

Status FrameWriter::finish() {
  return video_ && !written_.empty() ? video_->finish() : Status();
}

Status FrameWriter::writeLayers(Session& session, const std::filesystem::path& path) {
  const gpu::Texture* depth = nullptr;
  for (const LayerSource& source : session.layers)
    if (source.kind == LayerKind::Depth) depth = session.executor->kept(source.port);
  std::vector<ExrLayer> layers;
  for (const LayerSource& source : session.layers) {
    if (std::find(layers_.begin(), layers_.end(), source.kind) == layers_.end()) continue;
    const gpu::Texture* texture = session.executor->kept(source.port);
    if (!texture)
      return error(ErrorKind::Pipeline, "{}: '{}' is not a texture, so it cannot be written",
                   path.string(), source.port);
    ExrLayer layer = readLayer(*session.device, source.kind, *texture, depth, session.view.view);
    layer.image = resizedLayer(layer.image, source.kind, session.settings.size);
    // A half reaches to 65504 with eleven bits: too little for distances.
    if (name_.kind() == OutputKind::Exr && source.kind != LayerKind::Depth)
      layer.image = converted(layer.image, exrType_, layer.image.channels());
    layers.push_back(std::move(layer));
  }
  return name_.kind() == OutputKind::Hdr ? writeImage(path, layers.front().image)
                                         : writeExr(path, layers);
}

}  // namespace lucerna::app
