#include "image/video.hpp"

#include <gmock/gmock.h>

#include <sys/resource.h>

#include <cmath>
#include <csignal>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include "core/file.hpp"
#include "image/metrics.hpp"

namespace lucerna {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kWidth = 64, kHeight = 48;

// A bright bar that moves over a gradient.
Image picture(int frame, int width = kWidth, int height = kHeight) {
  Image image(width, height, 3, ComponentType::U8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* p = image.pixel<std::uint8_t>(x, y);
      const bool bar = x / 8 == frame % (width / 8);
      p[0] = static_cast<std::uint8_t>(bar ? 250 : 3 * x);
      p[1] = static_cast<std::uint8_t>(bar ? 240 : 4 * y);
      p[2] = static_cast<std::uint8_t>(bar ? 60 : 120);
    }
  return image;
}

Image plain(std::array<std::uint8_t, 3> color) {
  Image image(kWidth, kHeight, 3, ComponentType::U8);
  const auto bytes = image.as<std::uint8_t>();
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = color[i % 3];
  return image;
}

// What a player would see.
struct Film {
  std::vector<Image> pictures;
  double framesPerSecond = 0, seconds = 0;
  std::string codec;
  AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
  AVColorTransferCharacteristic transfer = AVCOL_TRC_UNSPECIFIED;
};

Image asRgb(const AVFrame& frame) {
  Image image(frame.width, frame.height, 3, ComponentType::U8);
  SwsContext* converter = sws_getContext(
      frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width,
      frame.height, AV_PIX_FMT_RGB24, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
  const int* matrix = sws_getCoefficients(SWS_CS_ITU709);
  sws_setColorspaceDetails(converter, matrix, 0, matrix, 1, 0, 1 << 16, 1 << 16);
  auto* to = reinterpret_cast<std::uint8_t*>(image.bytes().data());
  const int rowBytes = static_cast<int>(image.rowBytes());
  sws_scale(converter, frame.data, frame.linesize, 0, frame.height, &to, &rowBytes);
  sws_freeContext(converter);
  return image;
}

void takeFrames(AVCodecContext& decoder, Film& film) {
  AVFrame* frame = av_frame_alloc();
  while (avcodec_receive_frame(&decoder, frame) >= 0) film.pictures.push_back(asRgb(*frame));
  av_frame_free(&frame);
}

Film decoded(const fs::path& path) {
  Film film;
  AVFormatContext* format = nullptr;
  if (avformat_open_input(&format, path.c_str(), nullptr, nullptr) < 0) return film;
  avformat_find_stream_info(format, nullptr);
  const AVStream& stream = *format->streams[0];
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  film.codec = codec->name;
  film.framesPerSecond = av_q2d(stream.avg_frame_rate);
  film.seconds = static_cast<double>(format->duration) / AV_TIME_BASE;
  AVCodecContext* decoder = avcodec_alloc_context3(codec);
  avcodec_parameters_to_context(decoder, stream.codecpar);
  avcodec_open2(decoder, codec, nullptr);
  AVPacket* packet = av_packet_alloc();
  while (av_read_frame(format, packet) >= 0) {
    avcodec_send_packet(decoder, packet);
    av_packet_unref(packet);
    takeFrames(*decoder, film);
  }
  avcodec_send_packet(decoder, nullptr);
  takeFrames(*decoder, film);
  film.matrix = decoder->colorspace;
  film.transfer = decoder->color_trc;
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&format);
  return film;
}

class VideoTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "lucerna-video-XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::vector<Image>& pictures,
                 VideoSettings settings = {}) {
    settings.width = pictures[0].width();
    settings.height = pictures[0].height();
    auto video = VideoWriter::create(folder_ / name, settings);
    EXPECT_TRUE(video) << video.error().message;
    for (const Image& picture : pictures) EXPECT_TRUE(video->add(picture));
    EXPECT_TRUE(video->finish());
    return folder_ / name;
  }
  std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

std::vector<Image> pictures(int count) {
  std::vector<Image> result;
  for (int i = 0; i < count; ++i) result.push_back(picture(i));
  return result;
}

TEST_F(VideoTest, H264ComesBackNearlyTheSame) {
  const std::vector<Image> sent = pictures(30);
  for (const char* name : {"a.mp4", "a.mkv"}) {
    const Film film = decoded(write(name, sent, {.framesPerSecond = 24}));
    EXPECT_EQ(film.codec, "h264");
    EXPECT_DOUBLE_EQ(film.framesPerSecond, 24);
    EXPECT_NEAR(film.seconds, 30 / 24., 0.05);
    ASSERT_EQ(film.pictures.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const PixelMetrics metrics = pixelMetrics(converted(sent[i], ComponentType::F32, 3),
                                                converted(film.pictures[i], ComponentType::F32, 3));
      // Half the resolution in colour costs most of it, at the bar's edges.
      EXPECT_GT(metrics.psnr, 26) << name << " frame " << i;
    }
  }
}

TEST_F(VideoTest, Ffv1ComesBackExactly) {
  const std::vector<Image> sent = pictures(9);
  const Film film = decoded(write("a.mkv", sent, {.codec = VideoCodec::Ffv1}));
  EXPECT_EQ(film.codec, "ffv1");
  ASSERT_EQ(film.pictures.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i)
    EXPECT_TRUE(std::ranges::equal(sent[i].bytes(), film.pictures[i].bytes())) << "frame " << i;
}

TEST_F(VideoTest, Ffv1TakesOddSizes) {
  const std::vector<Image> sent{picture(0, 33, 17)};
  const Film film = decoded(write("a.mkv", sent, {.codec = VideoCodec::Ffv1}));
  ASSERT_EQ(film.pictures.size(), 1u);
  EXPECT_TRUE(std::ranges::equal(sent[0].bytes(), film.pictures[0].bytes()));
}

TEST_F(VideoTest, Ffv1TakesWhatIsTooWideForH264) {
  constexpr int kWide = 20000;
  const std::vector<Image> sent{picture(0, kWide, 3)};
  const Film film = decoded(write("a.mkv", sent, {.codec = VideoCodec::Ffv1}));
  ASSERT_EQ(film.pictures.size(), 1u);
  EXPECT_TRUE(std::ranges::equal(sent[0].bytes(), film.pictures[0].bytes()));
}

TEST_F(VideoTest, ColorsAreThoseOfRec709) {
  for (const std::array<std::uint8_t, 3> color :
       {std::array<std::uint8_t, 3>{200, 40, 40}, {30, 180, 60}, {50, 60, 220}, {255, 255, 255}}) {
    const Film film = decoded(write("a.mp4", {plain(color)}));
    EXPECT_EQ(film.matrix, AVCOL_SPC_BT709);
    EXPECT_EQ(film.transfer, AVCOL_TRC_IEC61966_2_1);
    ASSERT_EQ(film.pictures.size(), 1u);
    const std::uint8_t* seen = film.pictures[0].pixel<std::uint8_t>(kWidth / 2, kHeight / 2);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], color[c], 3);
  }
}

TEST_F(VideoTest, TheSamePicturesGiveTheSameBytes) {
  const std::vector<Image> sent = pictures(60);
  for (const auto& [extension, codec] :
       {std::pair(".mp4", VideoCodec::H264), std::pair(".mkv", VideoCodec::H264),
        std::pair(".mkv", VideoCodec::Ffv1)}) {
    const auto a = readFile(write(std::string("a") + extension, sent, {.codec = codec}));
    const auto b = readFile(write(std::string("b") + extension, sent, {.codec = codec}));
    ASSERT_TRUE(a && b);
    EXPECT_EQ(*a, *b) << extension;
  }
}

TEST_F(VideoTest, ALowerRateFactorIsNearerAndLarger) {
  const std::vector<Image> sent = pictures(8);
  const auto cost = [&](int crf) {
    const fs::path path = write(fmt::format("{}.mp4", crf), sent, {.crf = crf});
    const Film film = decoded(path);
    const PixelMetrics metrics =
        pixelMetrics(converted(sent[7], ComponentType::F32, 3),
                     converted(film.pictures.at(7), ComponentType::F32, 3));
    return std::pair(metrics.rmse, fs::file_size(path));
  };
  const auto [fineError, fineBytes] = cost(5);
  const auto [coarseError, coarseBytes] = cost(45);
  EXPECT_LT(fineError, coarseError);
  EXPECT_GT(fineBytes, coarseBytes);
}

TEST_F(VideoTest, TheFileAppearsOnlyWhenItIsWhole) {
  {
    auto video = VideoWriter::create(folder_ / "a.mp4", {.width = kWidth, .height = kHeight});
    ASSERT_TRUE(video);
    for (int i = 0; i < 50; ++i) ASSERT_TRUE(video->add(picture(i)));
    EXPECT_FALSE(fs::exists(folder_ / "a.mp4"));
  }  // as when rendering fails
  EXPECT_EQ(entries(), 0);
  write("a.mp4", pictures(3));
  EXPECT_EQ(entries(), 1);
}

// A full disk, as far as the program sees.
TEST_F(VideoTest, AFileThatCannotGrowIsAFaultOfTheDisk) {
  auto video = VideoWriter::create(folder_ / "a.mkv",
                                   {.width = 640, .height = 480, .codec = VideoCodec::Ffv1});
  ASSERT_TRUE(video);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{.rlim_cur = 4096, .rlim_max = before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &tight);
  Status written;
  for (int i = 0; i < 100 && written; ++i) written = video->add(picture(i, 640, 480));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("writing failed"));
  EXPECT_THAT(written.error().message, HasSubstr("check the free space"));
}

TEST_F(VideoTest, RefusesWhatItCannotWrite) {
  const auto faultOf = [](const fs::path& path, const VideoSettings& settings) {
    const auto video = VideoWriter::create(path, settings);
    if (video) return std::string("it succeeded");
    EXPECT_EQ(video.error().kind,
              checkVideo(path, settings) ? ErrorKind::Failed : ErrorKind::Usage);
    return video.error().message;
  };
  const VideoSettings small{.width = kWidth, .height = kHeight};
  EXPECT_THAT(faultOf(folder_ / "a.mp4", {.width = 33, .height = 18}),
              HasSubstr("even sides, found 33x18; make it 34x18"));
  EXPECT_THAT(
      faultOf(folder_ / "a.mp4", {.width = 20000, .height = 12000}),
      HasSubstr("at most 16384 px, found 20000x12000; make it smaller, or lossless (FFV1)"));
  EXPECT_THAT(faultOf(folder_ / "a.mkv", {.width = 64, .height = 2, .codec = VideoCodec::Ffv1}),
              HasSubstr("at least 3 px, found 64x2"));
  for (const VideoCodec codec : {VideoCodec::H264, VideoCodec::Ffv1})
    EXPECT_THAT(faultOf(folder_ / "a.mkv", {.width = 16384, .height = 16384, .codec = codec}),
                HasSubstr("at most some 260 million pixels, found 16384x16384; make it smaller"));
  EXPECT_THAT(faultOf(folder_ / "a.mp4", {.width = 4, .height = 4, .codec = VideoCodec::Ffv1}),
              HasSubstr(".mkv"));
  EXPECT_THAT(faultOf(folder_ / "a.mp4", {.width = 4, .height = 4, .framesPerSecond = 1e5}),
              HasSubstr("wanted 0.001 to 1000"));
  EXPECT_THAT(faultOf(folder_ / "a.mp4", {.width = 4, .height = 4, .framesPerSecond = NAN}),
              HasSubstr("nan frames a second"));
  EXPECT_THAT(faultOf(folder_ / "a.mp4", {.width = 4, .height = 4, .crf = 52}), HasSubstr("52"));
  EXPECT_THAT(faultOf(folder_ / "no" / "a.mp4", small), HasSubstr("does not exist"));
  EXPECT_THAT(faultOf("/proc/a.mp4", small), HasSubstr("cannot be written"));
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace lucerna
