// Video through libav. Pictures are encoded one by one on the calling thread.
#include "image/video.hpp"

#include <algorithm>
#include <cmath>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "core/file.hpp"
#include "core/text.hpp"

namespace lucerna {
namespace {

constexpr int kLargestRateTerm = 60000;  // holds 24000/1001 and the like
constexpr double kLeastRate = 1e-3, kGreatestRate = 1e3;
constexpr int kGreatestCrf = 51;
constexpr int kGreatestH264Side = 16384;  // px; x264's own limit
constexpr int kLeastFfv1Side = 3;         // px; smaller pictures do not come back as they were
// Frames that x264 looks ahead; they are all the memory that it gathers.
constexpr const char* kLookahead = "20";

struct Free {
  void operator()(AVFrame* p) const { av_frame_free(&p); }
  void operator()(AVPacket* p) const { av_packet_free(&p); }
  void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
  void operator()(SwsContext* p) const { sws_freeContext(p); }
  void operator()(AVFormatContext* p) const {
    avio_closep(&p->pb);
    avformat_free_context(p);
  }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

std::string reason(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  return text;
}

bool hasExtension(const std::filesystem::path& path, const char* extension) {
  return equalIgnoringCase(path.extension().string(), extension);
}

int even(int side) {
  return side + side % 2;
}

// What libavcodec asks first: (width + 128) (height + 128) stays below 2^28.
bool fitsCodecs(const VideoSettings& settings) {
  return av_image_check_size(static_cast<unsigned>(settings.width),
                             static_cast<unsigned>(settings.height), 0, nullptr) >= 0;
}

Status checkVideoSize(const std::filesystem::path& path, const VideoSettings& settings) {
  const int width = settings.width, height = settings.height;
  if (!fitsCodecs(settings))
    return error(ErrorKind::Usage,
                 "{}: a video's picture has at most some 260 million pixels, found {}x{}; make it "
                 "smaller, or write pictures",
                 path.string(), width, height);
  if (settings.codec == VideoCodec::Ffv1) {
    if (std::min(width, height) >= kLeastFfv1Side) return {};
    return error(ErrorKind::Usage,
                 "{}: lossless video (FFV1) takes sides of at least {} px, found {}x{}; make it "
                 "larger",
                 path.string(), kLeastFfv1Side, width, height);
  }
  if (std::max(width, height) > kGreatestH264Side)
    return error(ErrorKind::Usage,
                 "{}: H.264 takes sides of at most {} px, found {}x{}; make it smaller, or "
                 "lossless (FFV1) in an .mkv file",
                 path.string(), kGreatestH264Side, width, height);
  if (width % 2 == 0 && height % 2 == 0) return {};
  return error(ErrorKind::Usage,
               "{}: H.264 takes even sides, found {}x{}; make it {}x{}, or lossless (FFV1) in an "
               ".mkv file",
               path.string(), width, height, even(width), even(height));
}

AVPixelFormat pixelFormat(VideoCodec codec) {
  return codec == VideoCodec::H264 ? AV_PIX_FMT_YUV420P : AV_PIX_FMT_0RGB32;
}

// Every number that decides about a byte is stated: nothing depends on the machine.
void describe(AVCodecContext& context, const VideoSettings& settings) {
  const bool h264 = settings.codec == VideoCodec::H264;
  const AVRational rate = av_d2q(settings.framesPerSecond, kLargestRateTerm);
  context.width = settings.width;
  context.height = settings.height;
  context.pix_fmt = pixelFormat(settings.codec);
  context.time_base = av_inv_q(rate);
  context.framerate = rate;
  context.thread_count = 1;
  context.flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_GLOBAL_HEADER;  // both formats want it
  context.color_range = h264 ? AVCOL_RANGE_MPEG : AVCOL_RANGE_JPEG;
  context.colorspace = h264 ? AVCOL_SPC_BT709 : AVCOL_SPC_RGB;
  context.color_primaries = AVCOL_PRI_BT709;
  context.color_trc = AVCOL_TRC_IEC61966_2_1;
  if (h264) {
    av_opt_set_int(context.priv_data, "crf", settings.crf, 0);
    av_opt_set(context.priv_data, "rc-lookahead", kLookahead, 0);
    av_opt_set(context.priv_data, "x264-params", "cpu-independent=1", 0);
  } else {
    context.level = 3;  // FFV1 version 3: every slice carries a checksum
    av_opt_set_int(context.priv_data, "slicecrc", 1, 0);
  }
}

// From sRGB-encoded RGB to the codec's pixels; Rec. 709 for H.264, an exchange of bytes for FFV1.
Owned<SwsContext> makeConverter(const VideoSettings& settings) {
  const int flags = SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_BITEXACT;
  Owned<SwsContext> converter(sws_getContext(
      settings.width, settings.height, AV_PIX_FMT_RGB24, settings.width, settings.height,
      pixelFormat(settings.codec), flags, nullptr, nullptr, nullptr));
  if (converter && settings.codec == VideoCodec::H264) {
    const int* rec709 = sws_getCoefficients(SWS_CS_ITU709);
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(converter.get(), rec709, 1, rec709, 0, 0, kOne, kOne);
  }
  return converter;
}

}  // namespace

bool isVideoName(const std::filesystem::path& path) {
  return hasExtension(path, ".mp4") || hasExtension(path, ".mkv");
}

Status checkVideo(const std::filesystem::path& path, const VideoSettings& settings) {
  // Our own messages say what matters; libav's own go to stderr unasked.
  av_log_set_level(AV_LOG_QUIET);
  const bool h264 = settings.codec == VideoCodec::H264;
  if (!h264 && !hasExtension(path, ".mkv"))
    return error(ErrorKind::Usage, "{}: lossless video (FFV1) is written as .mkv", path.string());
  LUCERNA_TRY_VOID(checkVideoSize(path, settings));
  if (!(settings.framesPerSecond >= kLeastRate && settings.framesPerSecond <= kGreatestRate))
    return error(ErrorKind::Usage, "{}: {:g} frames a second, wanted {:g} to {:g}", path.string(),
                 settings.framesPerSecond, kLeastRate, kGreatestRate);
  if (settings.crf < 0 || settings.crf > kGreatestCrf)
    return error(ErrorKind::Usage, "{}: a rate factor of {}, wanted 0 to {}", path.string(),
                 settings.crf, kGreatestCrf);
  return {};
}

struct VideoWriter::Impl {
  Impl(AtomicFile target, std::string shownName, const VideoSettings& wanted)
      : file(std::move(target)), name(std::move(shownName)), settings(wanted) {}

  Error failed(const char* what, int code) const {
    return error(ErrorKind::Failed, "{}: {}: {}", name, what, reason(code));
  }
  Error notWritten(int code) const {
    return error(ErrorKind::Failed, "{}: writing failed: {}; check the free space", name,
                 reason(code));
  }

  Status open() {
    LUCERNA_TRY_VOID(openCodec());
    return openFile();
  }

  Status openCodec() {
    const bool h264 = settings.codec == VideoCodec::H264;
    const AVCodec* encoder =
        h264 ? avcodec_find_encoder_by_name("libx264") : avcodec_find_encoder(AV_CODEC_ID_FFV1);
    if (!encoder)
      return error(ErrorKind::Failed, "{}: this libavcodec has no {} encoder; install one that has",
                   name, h264 ? "libx264" : "FFV1");
    codec.reset(avcodec_alloc_context3(encoder));
    describe(*codec, settings);
    if (const int code = avcodec_open2(codec.get(), encoder, nullptr); code < 0)
      return failed("the encoder does not open", code);
    converter = makeConverter(settings);
    frame.reset(av_frame_alloc());
    packet.reset(av_packet_alloc());
    CHECK(converter && frame && packet);
    frame->format = codec->pix_fmt;
    frame->width = settings.width;
    frame->height = settings.height;
    if (const int code = av_frame_get_buffer(frame.get(), 0); code < 0)
      return failed("no memory for a picture", code);
    return {};
  }

  Status openFile() {
    // "file:" so that no name is taken for a network address.
    const std::string url = "file:" + file.temporary().string();
    AVFormatContext* made = nullptr;
    if (const int code = avformat_alloc_output_context2(&made, nullptr, nullptr, url.c_str());
        code < 0)
      return failed("the format is not known", code);
    format.reset(made);
    // Flushed packet by packet, so that a full disk is seen at its frame.
    format->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_FLUSH_PACKETS;
    stream = avformat_new_stream(format.get(), nullptr);
    CHECK(stream);
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = codec->framerate;
    CHECK(avcodec_parameters_from_context(stream->codecpar, codec.get()) >= 0);
    if (const int code = avio_open(&format->pb, url.c_str(), AVIO_FLAG_WRITE); code < 0)
      return error(ErrorKind::Failed,
                   "{}: cannot be written: {}; check that the folder exists and is writable", name,
                   reason(code));
    if (const int code = avformat_write_header(format.get(), nullptr); code < 0)
      return notWritten(code);
    return {};
  }

  // Hands a picture to the encoder (null ends the stream) and writes what comes out.
  Status encode(const AVFrame* picture) {
    if (const int code = avcodec_send_frame(codec.get(), picture); code < 0)
      return failed("encoding failed", code);
    for (;;) {
      const int code = avcodec_receive_packet(codec.get(), packet.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
      if (code < 0) return failed("encoding failed", code);
      packet->stream_index = stream->index;
      packet->duration = 1;
      av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      if (const int written = av_interleaved_write_frame(format.get(), packet.get()); written < 0)
        return notWritten(written);
      if (format->pb->error < 0) return notWritten(format->pb->error);
    }
  }

  AtomicFile file;
  std::string name;  // as given, for messages
  VideoSettings settings;
  Owned<AVCodecContext> codec;
  Owned<AVFormatContext> format;  // closes the file before `file` removes it
  Owned<SwsContext> converter;
  Owned<AVFrame> frame;
  Owned<AVPacket> packet;
  AVStream* stream = nullptr;  // the format's
  std::int64_t count = 0;      // pictures so far
};

VideoWriter::VideoWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

Result<VideoWriter> VideoWriter::create(const std::filesystem::path& path,
                                        const VideoSettings& settings) {
  CHECK(isVideoName(path) && settings.width > 0 && settings.height > 0);
  LUCERNA_TRY_VOID(checkVideo(path, settings));
  LUCERNA_TRY(file, AtomicFile::create(path));
  auto impl = std::make_unique<Impl>(std::move(file), path.string(), settings);
  LUCERNA_TRY_VOID(impl->open());
  return VideoWriter(std::move(impl));
}

Status VideoWriter::add(const Image& picture) {
  Impl& video = *impl_;
  CHECK(picture.type() == ComponentType::U8 && picture.channels() == 3);
  CHECK(picture.width() == video.settings.width && picture.height() == video.settings.height,
        "a picture of {}x{} in a video of {}x{}", picture.width(), picture.height(),
        video.settings.width, video.settings.height);
  // The encoder may still hold the last picture's buffer.
  if (const int code = av_frame_make_writable(video.frame.get()); code < 0)
    return video.failed("no memory for a picture", code);
  const auto* pixels = reinterpret_cast<const std::uint8_t*>(picture.bytes().data());
  const int rowBytes = static_cast<int>(picture.rowBytes());
  sws_scale(video.converter.get(), &pixels, &rowBytes, 0, picture.height(), video.frame->data,
            video.frame->linesize);
  video.frame->pts = video.count++;
  return video.encode(video.frame.get());
}

Status VideoWriter::finish() {
  Impl& video = *impl_;
  CHECK(video.count > 0, "{}: a video without pictures", video.name);
  LUCERNA_TRY_VOID(video.encode(nullptr));
  if (const int code = av_write_trailer(video.format.get()); code < 0)
    return video.notWritten(code);
  if (const int code = avio_closep(&video.format->pb); code < 0) return video.notWritten(code);
  return video.file.commit();
}

}  // namespace lucerna
