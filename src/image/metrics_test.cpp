#include "image/metrics.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "image/image_file.hpp"
#include "image/vector_math.hpp"

namespace lucerna {
namespace {

namespace fs = std::filesystem;

Image randomPicture(int width, int height, std::uint64_t seed) {
  Random random(seed);
  Image image(width, height, 3, ComponentType::F32);
  for (float& value : image.as<float>()) value = random.uniform();
  return image;
}

Image plain(int width, int height, float r, float g, float b) {
  Image image(width, height, 3, ComponentType::F32);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float* p = image.pixel<float>(x, y);
      p[0] = r, p[1] = g, p[2] = b;
    }
  return image;
}

TEST(VectorMath, PowersAreNearTheLibrary) {
  double worst = 0;
  for (const float exponent : {1 / 3.f, 0.7f, 2.4f, 0.05f, 1.f})
    for (float x = 1e-6f; x < 500; x *= 1.0137f) {
      const double wanted = std::pow(static_cast<double>(x), static_cast<double>(exponent));
      worst = std::max(worst, std::abs(vectorPow(x, exponent) - wanted) / wanted);
    }
  EXPECT_LT(worst, 3e-6);
  EXPECT_EQ(vectorPow(0, 0.7f), 0);
  EXPECT_EQ(vectorPow(1, 0.7f), 1);
}

class SharedMetrics : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kFolder / "expected.json"))
      GTEST_SKIP() << kFolder / "expected.json" << " is missing";
    expected_ = nlohmann::json::parse(*readText(kFolder / "expected.json"));
  }
  static Image picture(const std::string& name) {
    auto image = readImage(kFolder / name);
    CHECK(image, "{}", image.error().message);
    return converted(*image, ComponentType::F32, 3);
  }
  static void check(const std::string& name, const ErrorMap& map, const nlohmann::json& wanted) {
    EXPECT_NEAR(map.mean, wanted["mean"].get<double>(), 0.001) << name;
    EXPECT_NEAR(map.max, wanted["max"].get<double>(), 0.005) << name;
    EXPECT_NEAR(map.min, wanted["min"].get<double>(), 0.001) << name;
    EXPECT_NEAR(map.weightedMedian, wanted["weighted_median"].get<double>(), 0.001) << name;
  }
  static inline const fs::path kFolder = fs::path(LUCERNA_SOURCE_DIR) / "../shared/metrics";
  nlohmann::json expected_;
};

TEST_F(SharedMetrics, LdrFlipAgreesWithItsAuthors) {
  const Image reference = picture("reference.png");
  for (const auto& [name, wanted] : expected_["ldr"].items())
    check(name, flipLdr(reference, picture(name)), wanted);
}

TEST_F(SharedMetrics, HdrFlipAgreesWithItsAuthors) {
  const Image reference = picture("reference.exr");
  for (const auto& [name, wanted] : expected_["hdr"].items()) {
    const HdrFlip flip = flipHdr(reference, picture(name));
    check(name, flip.map, wanted);
    EXPECT_NEAR(flip.startExposure, wanted["start_exposure"].get<double>(), 0.001);
    EXPECT_NEAR(flip.stopExposure, wanted["stop_exposure"].get<double>(), 0.001);
    EXPECT_EQ(flip.exposures, wanted["exposures"].get<int>());
  }
}

TEST(Flip, OfEqualPicturesIsExactlyZero) {
  const Image a = randomPicture(33, 21, 1);
  const ErrorMap map = flipLdr(a, a);
  EXPECT_EQ(map.mean, 0);
  EXPECT_EQ(map.max, 0);
  EXPECT_EQ(map.weightedMedian, 0);
  EXPECT_EQ(flipHdr(a, a).map.max, 0);
}

TEST(Flip, OfBlackAndWhiteIsNearlyOne) {
  const ErrorMap map = flipLdr(plain(40, 30, 0, 0, 0), plain(40, 30, 1, 1, 1));
  EXPECT_GT(map.min, 0.9);
  EXPECT_LE(map.max, 1.0);
}

// Two plain pictures have no features: FLIP is the mapped colour distance, computed here by hand.
TEST(Flip, OfPlainColoursIsTheirMappedDistance) {
  // Grey 0.5 against 0.6 (sRGB): L* 53.389 and 63.223; the largest distance, green to blue after
  // the Hunt adjustment, is 41.27 when raised to 0.7.
  const ErrorMap map = flipLdr(plain(30, 30, 0.5f, 0.5f, 0.5f), plain(30, 30, 0.6f, 0.6f, 0.6f));
  const double lightness = 63.223 - 53.389, largest = 41.2760036;
  EXPECT_NEAR(map.mean, std::pow(lightness, 0.7) * 0.95 / (0.4 * largest), 0.002);
  EXPECT_NEAR(map.max - map.min, 0, 1e-4);
}

TEST(Flip, SeesAnErrorWhereItIsAndFartherWithMorePixelsPerDegree) {
  const Image a = plain(61, 61, 0.4f, 0.4f, 0.4f);
  Image b = a;
  std::fill_n(b.pixel<float>(30, 30), 3, 1.f);
  const ErrorMap map = flipLdr(a, b);
  EXPECT_EQ(*map.error.pixel<float>(0, 0), 0.f);
  EXPECT_EQ(map.max, *map.error.pixel<float>(30, 30));
  FlipSettings near;
  near.pixelsPerDegree = 20;
  EXPECT_GT(flipLdr(a, b, near).max, map.max) << "larger pixels show more";
}

TEST(Flip, TheMaskLimitsTheSummaryOnly) {
  const Image a = plain(32, 16, 0.2f, 0.2f, 0.2f);
  Image b = a;
  for (int y = 0; y < 16; ++y) std::fill_n(b.pixel<float>(24, y), 3 * 8, 0.9f);
  Image mask(32, 16, 1, ComponentType::U8);
  for (int y = 0; y < 16; ++y) std::fill_n(mask.pixel<std::uint8_t>(0, y), 8, std::uint8_t{255});
  const ErrorMap all = flipLdr(a, b), masked = flipLdr(a, b, {}, &mask);
  EXPECT_GT(all.max, 0.5);
  EXPECT_LT(masked.max, 0.01);
  EXPECT_TRUE(std::ranges::equal(all.error.bytes(), masked.error.bytes()));
  EXPECT_GT(pixelMetrics(a, b, &mask).psnr, 1e9);
  EXPECT_LT(pixelMetrics(a, b).psnr, 20);
}

TEST(Flip, ABrokenPixelIsAFullError) {
  const Image a = randomPicture(20, 20, 3);
  Image b = a;
  *b.pixel<float>(4, 5) = std::numeric_limits<float>::quiet_NaN();
  *b.pixel<float>(14, 5) = std::numeric_limits<float>::infinity();
  for (const ErrorMap& map : {flipLdr(a, b), flipHdr(a, b).map}) {
    EXPECT_EQ(*map.error.pixel<float>(4, 5), 1.f);
    EXPECT_EQ(*map.error.pixel<float>(14, 5), 1.f);
    EXPECT_TRUE(std::isfinite(map.mean));
    EXPECT_LT(map.mean, 0.5);
  }
}

TEST(Flip, BlackReferencesHaveFiniteExposures) {
  const HdrFlip flip = flipHdr(plain(8, 8, 0, 0, 0), plain(8, 8, 1, 1, 1));
  EXPECT_TRUE(std::isfinite(flip.startExposure));
  EXPECT_GT(flip.map.mean, 0.5);
  const HdrFlip given =
      flipHdr(plain(8, 8, 0, 0, 0), plain(8, 8, 1, 1, 1), {}, nullptr, ExposureRange{-1, 1, 3});
  EXPECT_EQ(given.exposures, 3);
}

TEST(Metrics, BitsDoNotDependOnTheThreadCount) {
  const Image a = randomPicture(70, 301, 5), b = randomPicture(70, 301, 6);
  setThreadCount(1);
  const ErrorMap one = flipLdr(a, b);
  const PixelMetrics pixelsOne = pixelMetrics(a, b);
  for (const int threads : {2, 5}) {
    setThreadCount(threads);
    const ErrorMap many = flipLdr(a, b);
    EXPECT_TRUE(std::ranges::equal(one.error.bytes(), many.error.bytes()));
    EXPECT_EQ(one.mean, many.mean);
    EXPECT_EQ(one.weightedMedian, many.weightedMedian);
    EXPECT_EQ(pixelsOne.ssim, pixelMetrics(a, b).ssim);
  }
  setThreadCount(0);
}

TEST(Summary, QuantilesAreThoseOfTheSortedValues) {
  Random random(9);
  Image error(100, 10, 1, ComponentType::F32);
  std::vector<float> values;
  for (float& value : error.as<float>()) {
    value = random.uniform();
    values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  double sum = 0, before = 0;
  for (const float value : values) sum += value;
  std::size_t middle = 0;
  while ((before += values[middle]) < 0.5 * sum) ++middle;
  const ErrorMap map = summarised(error);
  EXPECT_EQ(map.p95, values[949]);
  EXPECT_EQ(map.weightedMedian, values[middle]);
  EXPECT_EQ(map.min, values.front());
  EXPECT_EQ(map.max, values.back());
  EXPECT_NEAR(map.mean, sum / 1000, 1e-9);
}

TEST(PixelMetrics, KnowPlainDifferences) {
  const PixelMetrics m =
      pixelMetrics(plain(20, 20, 0.5f, 0.5f, 0.5f), plain(20, 20, 0.6f, 0.6f, 0.6f));
  EXPECT_NEAR(m.rmse, 0.1, 1e-6);
  EXPECT_NEAR(m.psnr, 20, 1e-4);
  // Without variance SSIM is its luminance term.
  EXPECT_NEAR(m.ssim, (2 * 0.5 * 0.6 + 1e-4) / (0.25 + 0.36 + 1e-4), 1e-5);
  const Image a = randomPicture(20, 20, 1);
  EXPECT_TRUE(std::isinf(pixelMetrics(a, a).psnr));
  EXPECT_NEAR(pixelMetrics(a, a).ssim, 1, 1e-6);
  EXPECT_LT(pixelMetrics(a, randomPicture(20, 20, 2)).ssim, 0.2);
  EXPECT_NEAR(pixelMetrics(plain(3, 2, 0, 0, 0), plain(3, 2, 0, 0, 0)).ssim, 1, 1e-6);
}

TEST(HeatMap, GrowsInLightness) {
  Image ramp(256, 1, 1, ComponentType::F32);
  for (int x = 0; x < 256; ++x) *ramp.pixel<float>(x, 0) = static_cast<float>(x) / 255;
  const Image colours = heatMap(ramp);
  double previous = -1;
  for (int x = 0; x < 256; ++x) {
    const std::uint8_t* p = colours.pixel<std::uint8_t>(x, 0);
    const double luminance =
        0.2126 * std::pow(p[0], 2.2) + 0.7152 * std::pow(p[1], 2.2) + 0.0722 * std::pow(p[2], 2.2);
    EXPECT_GE(luminance, previous * 0.999) << x;
    previous = luminance;
  }
}

TEST(HeatMap, ShowsWhatTheMaskLeavesOutInAGreyThatNoErrorHas) {
  Image ramp(256, 1, 1, ComponentType::F32), mask(256, 1, 1, ComponentType::U8);
  for (int x = 0; x < 256; ++x) {
    *ramp.pixel<float>(x, 0) = static_cast<float>(x) / 255;
    *mask.pixel<std::uint8_t>(x, 0) = x % 2 == 0 ? 0 : 255;
  }
  const Image all = heatMap(ramp), masked = heatMap(ramp, &mask);
  const std::array grey{kMaskedGrey, kMaskedGrey, kMaskedGrey};
  for (int x = 0; x < 256; ++x) {
    const auto* shown = masked.pixel<std::uint8_t>(x, 0);
    const auto* error = all.pixel<std::uint8_t>(x, 0);
    EXPECT_TRUE(std::equal(shown, shown + 3, x % 2 == 0 ? grey.data() : error)) << x;
    EXPECT_GT(std::max(std::abs(error[0] - kMaskedGrey), std::abs(error[1] - kMaskedGrey)), 16)
        << x;
  }
}

}  // namespace
}  // namespace lucerna
