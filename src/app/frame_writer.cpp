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
Image resizedLayer(Image&& image, LayerKind kind, uvec2 size) {
  const bool averaged = kind == LayerKind::Color || kind == LayerKind::Albedo;
  return averaged ? resizedLinear(std::move(image), size) : resizedNearest(std::move(image), size);
}

bool holdsLinear(OutputKind kind) {
  return kind == OutputKind::Exr || kind == OutputKind::Hdr;
}

Status checkFlags(const OutputSettings& output, OutputKind kind) {
  const char* ofVideo = output.fps        ? "--fps"
                        : output.crf      ? "--crf"
                        : output.lossless ? "--lossless"
                                          : nullptr;
  if (ofVideo && kind != OutputKind::Video)
    return error(ErrorKind::Usage, "{}: '{}' is no video; give -o NAME.mp4 or NAME.mkv", ofVideo,
                 output.path);
  const char* ofExr = !output.layers.empty() ? "--layers" : output.exrType ? "--exr-type" : nullptr;
  if (ofExr && kind != OutputKind::Exr)
    return error(ErrorKind::Usage, "{}: '{}' is no EXR file; give -o NAME.exr", ofExr, output.path);
  return {};
}

// The whole picture is put together in memory, as the readers of such files will do.
Status checkSize(const RenderSettings& settings, OutputKind kind) {
  const uvec2 size = settings.pictureSize(), rendered = settings.renderSize();
  const auto longest = static_cast<std::uint32_t>(ImageLimits().maxSide);
  if (kind == OutputKind::Exr && std::max(size.x, size.y) > longest)
    return error(ErrorKind::Usage,
                 "--size: sides of an EXR file have at most {} px, found {} x {}; make it smaller, "
                 "or write PNG",
                 longest, size.x, size.y);
  const std::uint64_t pixels =
      std::max(std::uint64_t{size.x} * size.y, std::uint64_t{rendered.x} * rendered.y);
  const std::uint64_t bytes = pixels * (holdsLinear(kind) ? 3 * sizeof(float) : 3);
  const std::uint64_t limit = ImageLimits().maxBytes;
  if (bytes <= limit) return {};
  return error(
      ErrorKind::Usage,
      "--size: a picture of {} x {}{} takes {} MiB, at most {} are allowed; make it "
      "smaller",
      size.x, size.y,
      rendered == settings.size ? "" : fmt::format(" (rendered {} x {})", rendered.x, rendered.y),
      bytes >> 20, limit >> 20);
}

Status checkStereo(const StereoSettings& stereo, const std::vector<LayerKind>& layers) {
  const auto isColor = [](LayerKind kind) { return kind == LayerKind::Color; };
  if (stereo.layout != StereoLayout::Anaglyph || std::ranges::all_of(layers, isColor)) return {};
  return error(
      ErrorKind::Usage,
      "--layers: an anaglyph holds two colours of one eye and one of the other, which only "
      "'color' has; take --stereo sbs or tb");
}

}  // namespace

Result<FrameWriter> FrameWriter::create(const OutputSettings& output,
                                        const RenderSettings& settings) {
  LUCERNA_TRY(name, FrameName::parse(output.path, settings.frames));
  LUCERNA_TRY_VOID(checkFlags(output, name.kind()));
  LUCERNA_TRY_VOID(checkFolderOf(name.at(0), "-o"));
  FrameWriter writer(std::move(name));
  writer.exrType_ = output.exrType.value_or(writer.exrType_);
  for (const std::string& layer : output.layers) {
    LUCERNA_TRY(kind, layerFromName(layer));
    if (std::find(writer.layers_.begin(), writer.layers_.end(), kind) == writer.layers_.end())
      writer.layers_.push_back(kind);
  }
  if (writer.layers_.empty() && holdsLinear(writer.name_.kind()))
    writer.layers_.push_back(LayerKind::Color);
  writer.wanted_ = writer.layers_;
  const auto has = [&](LayerKind kind) {
    return std::find(writer.layers_.begin(), writer.layers_.end(), kind) != writer.layers_.end();
  };
  // Where the depth is empty there is no normal.
  if (has(LayerKind::Normal) && !has(LayerKind::Depth)) writer.wanted_.push_back(LayerKind::Depth);
  LUCERNA_TRY_VOID(checkStereo(settings.stereo, writer.layers_));
  LUCERNA_TRY_VOID(checkSize(settings, writer.name_.kind()));
  if (writer.name_.kind() == OutputKind::Video)
    LUCERNA_TRY_VOID(writer.openVideo(output, settings));
  return writer;
}

Status FrameWriter::openVideo(const OutputSettings& output, const RenderSettings& settings) {
  if (!output.fps && settings.timeStep <= 0)
    return error(ErrorKind::Usage,
                 "-o: '{}' needs a frame rate, and --time-step 0 gives none; add --fps",
                 output.path);
  const uvec2 size = settings.pictureSize();
  VideoSettings video{.width = static_cast<int>(size.x),
                      .height = static_cast<int>(size.y),
                      .framesPerSecond = output.fps ? *output.fps : 1 / settings.timeStep,
                      .codec = output.lossless ? VideoCodec::Ffv1 : VideoCodec::H264};
  if (output.crf) video.crf = *output.crf;
  LUCERNA_TRY(opened, VideoWriter::create(name_.at(0), video));
  video_ = std::move(opened);
  return {};
}

Result<std::vector<FrameWriter::Part>> FrameWriter::read(Session& session, int view,
                                                         const gpu::Texture& output) const {
  std::vector<Part> parts;
  if (!holdsLinear(name_.kind())) {
    parts.push_back({{}, {"", {}, encodedRgb(session.device->download(output))}, ""});
    return parts;
  }
  const gpu::Texture* depth = nullptr;
  for (const LayerSource& source : session.layers)
    if (source.kind == LayerKind::Depth) depth = session.executor->kept(source.port);
  for (const LayerSource& source : session.layers) {
    if (std::find(layers_.begin(), layers_.end(), source.kind) == layers_.end()) continue;
    const gpu::Texture* texture = session.executor->kept(source.port);
    if (!texture)
      return error(ErrorKind::Pipeline, "{}: '{}' is not a texture, so it cannot be written",
                   name_.at(session.frame).string(), source.port);
    const scene::View& from = session.views[static_cast<std::size_t>(view)].view;
    parts.push_back(
        {source.kind, readLayer(*session.device, source.kind, *texture, depth, from), source.port});
  }
  return parts;
}

Status FrameWriter::checkPart(const Part& part, uvec2 size) {
  const Image& image = part.layer.image;
  if (uvec2(image.width(), image.height()) == size) return {};
  return error(
      ErrorKind::Pipeline,
      "{} is {} x {} px where the picture is {} x {}; let the row write it at full size (a "
      "Fullscreen row: outputScale=1), or add one that does",
      part.port.empty() ? "the pipeline's output" : "'" + part.port + "'", image.width(),
      image.height(), size.x, size.y);
}

Status FrameWriter::write(Session& session, int view, const gpu::Texture& output) {
  const auto& [eye, tile] = session.plan.places[static_cast<std::size_t>(view)];
  LUCERNA_TRY(parts, read(session, view, output));
  for (const Part& part : parts) LUCERNA_TRY_VOID(checkPart(part, session.plan.window));
  if (view == 0) eyes_.assign(static_cast<std::size_t>(session.plan.eyes()), {});
  std::vector<Part>& whole = eyes_[static_cast<std::size_t>(eye)];
  if (whole.empty())
    for (const Part& part : parts)
      whole.push_back({part.kind, {part.layer.name, part.layer.channels, {}}});
  for (std::size_t i = 0; i < parts.size(); ++i)
    placeTile(whole[i].layer.image, std::move(parts[i].layer.image), session.plan, tile);
  const bool last = view + 1 == static_cast<int>(session.plan.places.size());
  return last ? writeFrame(session) : Status();
}

// Each eye is resized by itself, so that they do not mix where they meet.
Image FrameWriter::finished(std::size_t part, const RenderSettings& settings) {
  std::vector<Image> eyes;
  for (std::vector<Part>& eye : eyes_) {
    auto& [kind, layer, port] = eye[part];
    eyes.push_back(kind ? resizedLayer(std::move(layer.image), *kind, settings.size)
                        : resizedSrgb(std::move(layer.image), settings.size));
  }
  return joinEyes(std::move(eyes), settings.stereo.layout);
}

Status FrameWriter::writeFrame(const Session& session) {
  const std::filesystem::path path = name_.at(session.frame);
  std::vector<ExrLayer> layers;
  for (std::size_t i = 0; i < eyes_[0].size(); ++i) {
    const auto& [kind, like, port] = eyes_[0][i];
    ExrLayer layer{like.name, like.channels, finished(i, session.settings)};
    // A half reaches to 65504 with eleven bits: too little for distances.
    if (name_.kind() == OutputKind::Exr && kind != LayerKind::Depth &&
        exrType_ != layer.image.type())
      layer.image = converted(layer.image, exrType_, layer.image.channels());
    layers.push_back(std::move(layer));
  }
  if (video_)
    LUCERNA_TRY_VOID(video_->add(layers[0].image));
  else if (name_.kind() == OutputKind::Exr)
    LUCERNA_TRY_VOID(writeExr(path, layers));
  else
    LUCERNA_TRY_VOID(writeImage(path, layers[0].image));
  if (!video_ || written_.empty()) written_.push_back(path);
  return {};
}

Status FrameWriter::finish() {
  return video_ && !written_.empty() ? video_->finish() : Status();
}

}  // namespace lucerna::app
