#include "app/bench/visibility_error.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

namespace lucerna::app::bench {
namespace {

constexpr int kWidth = 64, kHeight = 48;

Image picture(const std::function<float(int x, int y)>& value) {
  Image image(kWidth, kHeight, 1, ComponentType::F32);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) *image.pixel<float>(x, y) = value(x, y);
  return image;
}

Image mask(const std::function<bool(int x, int y)>& on) {
  Image image(kWidth, kHeight, 1, ComponentType::U8);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) *image.pixel<std::uint8_t>(x, y) = on(x, y) ? 255 : 0;
  return image;
}

const Image kAll = mask([](int, int) { return true; }),
            kNone = mask([](int, int) { return false; });

// From 1 on the left to 0 on the right, between columns 24 and 40.
float ramp(float x) {
  return std::clamp((40 - x) / 16, 0.f, 1.f);
}

TEST(VisibilityError, OfEqualPicturesIsNone) {
  const Image a = picture([](int x, int) { return ramp(static_cast<float>(x)); });
  const auto error = penumbraError({a, a, kAll});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->flip, 0);
  EXPECT_TRUE(std::isinf(error->psnr));
  EXPECT_NEAR(error->ssim, 1, 1e-6);
  const ShadowFaults faults = shadowFaults({a, a, kAll}, kAll);
  EXPECT_EQ(faults.leakPercent(), 0);
  EXPECT_EQ(faults.falseShadowPercent(), 0);
  EXPECT_EQ(faults.haloPercent(), 0);
  EXPECT_EQ(faults.lit, kWidth * kHeight);
}

// Only differences inside the penumbra and where the light shines count.
TEST(VisibilityError, IsThatInsideThePenumbra) {
  const Image reference = picture([](int x, int) { return ramp(static_cast<float>(x)); });
  const Image test = picture([](int x, int) {
    const float right = ramp(static_cast<float>(x));
    return right <= 0 || right >= 1 ? 1 - right : right + 0.05f;
  });
  const auto error = penumbraError({reference, test, kAll});
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->psnr, -20 * std::log10(0.05), 1.5) << "1 / 0.98 is cut off at one end";
  EXPECT_GT(error->flip, 0);
  const Image left = mask([](int x, int) { return x < 10; });
  EXPECT_FALSE(penumbraError({reference, test, left})) << "there is no penumbra";
  EXPECT_FALSE(penumbraError({reference, test, kAll}, kWidth * kHeight));
}

TEST(VisibilityError, LeakAndFalseShadowAreMeans) {
  const Image reference = picture([](int x, int) { return x < 32 ? 1.f : 0.f; });
  const Image test = picture([](int x, int) { return x < 32 ? 0.75f : 0.1f; });
  const Image lit = mask([](int x, int) { return x >= 16; });
  const ShadowFaults faults = shadowFaults({reference, test, lit}, kNone);
  EXPECT_NEAR(faults.leakPercent(), 10, 1e-4);
  EXPECT_NEAR(faults.falseShadowPercent(), 25, 1e-4);
  EXPECT_EQ(faults.clear, 16 * kHeight);
  EXPECT_EQ(faults.haloPercent(), 0);
  ShadowFaults both = faults;
  both.add(shadowFaults({reference, reference, lit}, kNone));
  EXPECT_NEAR(both.leakPercent(), 5, 1e-4);
}

TEST(VisibilityError, HalosAreWrongPixelsNearEdges) {
  const Image reference = picture([](int, int) { return 1.f; });
  const Image test = picture([](int x, int) { return x < 8 ? 0.85f : x < 16 ? 0.95f : 0.5f; });
  const Image near = mask([](int x, int) { return x < 12; });
  EXPECT_NEAR(shadowFaults({reference, test, kAll}, near).haloPercent(), 100. * 8 / kWidth, 1e-9);
}

// A slanted plane before another: reversed depth is linear over each.
TEST(DepthEdges, LieBetweenSurfacesAndNotOnThem) {
  const auto depth = [](int x, int y) {
    const float far = 0.1f + 0.0005f * static_cast<float>(x) + 0.0003f * static_cast<float>(y);
    return x < 30 ? 3 * far : far;
  };
  const Image near = nearDepthEdges(picture(depth), 3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      EXPECT_EQ(*near.pixel<std::uint8_t>(x, y) != 0, x >= 30 - 4 && x < 30 + 4) << x << ", " << y;
}

TEST(DepthEdges, AreNotWhereSurfacesMeet) {
  const Image near = nearDepthEdges(
      picture([](int x, int) { return 0.1f + 0.001f * static_cast<float>(std::abs(x - 20)); }), 1);
  EXPECT_EQ(std::ranges::count(near.as<std::uint8_t>(), 255), 0);
}

TEST(DepthEdges, SurfacesEndAtTheSky) {
  const Image near = nearDepthEdges(picture([](int, int y) { return y < 20 ? 0.f : 0.2f; }), 0);
  for (int y = 0; y < kHeight; ++y)
    EXPECT_EQ(*near.pixel<std::uint8_t>(5, y) != 0, y == 19 || y == 20) << y;
}

TEST(LargestDifference, IsThatOfLitPixels) {
  const Image a = picture([](int x, int) { return x == 3 ? 0.5f : 0.2f; });
  const Image b = picture([](int, int) { return 0.25f; });
  EXPECT_NEAR(largestDifference(a, b, kAll), 0.25, 1e-6);
  EXPECT_NEAR(largestDifference(a, b, mask([](int x, int) { return x != 3; })), 0.05, 1e-6);
}

// Seen from above, 1 m is 10 px.
scene::View fromAbove() {
  scene::View view;
  view.orthographic = true;
  view.clipFromView = glm::scale(mat4(1.f), vec3(20.f / kWidth, 20.f / kHeight, -0.01f));
  return view;
}

// What is left of a disc behind an edge.
float ofDisc(float t) {
  const float s = std::clamp(t, -1.f, 1.f);
  return 0.5f + (s * std::sqrt(1 - s * s) + std::asin(s)) / kPi;
}

TEST(PenumbraWidth, IsThatOfADisc) {
  for (const float width : {2.f, 3.f}) {  // m, around the picture's middle
    const Image image = picture([&](int x, int) {
      const float metres = (static_cast<float>(x) + 0.5f - 0.5f * kWidth) / 10;
      return ofDisc(-2 * metres / width);
    });
    const vec3 litW(-0.7f, 0, 0), darkW(0.7f, 0, 0);  // the walk need not be as long as it is wide
    const auto found = penumbraWidth(image, fromAbove(), litW, darkW);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, width, 0.02 * static_cast<double>(width));
  }
}

TEST(PenumbraWidth, IsUnknownWhereNothingIsCrossedOrSeen) {
  const Image clear = picture([](int, int) { return 1.f; });
  EXPECT_FALSE(penumbraWidth(clear, fromAbove(), {-0.5f, 0, 0}, {0.5f, 0, 0}));
  const Image image = picture([](int x, int) { return ramp(static_cast<float>(x)); });
  EXPECT_TRUE(penumbraWidth(image, fromAbove(), {-1, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(penumbraWidth(image, fromAbove(), {-3, 0, 0}, {3, 0, 0}));
}

TEST(Flicker, IsWhatASteadyChangeDoesNotHave) {
  const auto all = [](float value) { return picture([=](int, int) { return value; }); };
  EXPECT_NEAR(flickerOf(all(0.25f), all(0.5f), all(0.75f)), 0, 1e-6);
  EXPECT_NEAR(flickerOf(all(0.25f), all(0.75f), all(0.25f)), 1, 1e-6);
  const Image half = picture([](int x, int) { return x < kWidth / 2 ? 1.f : 0.f; });
  EXPECT_NEAR(flickerOf(all(0.f), half, all(0.f)), 1, 1e-6);
}

}  // namespace
}  // namespace lucerna::app::bench
