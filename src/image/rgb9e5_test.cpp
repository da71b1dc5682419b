#include "image/rgb9e5.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace lucerna {
namespace {

constexpr float kSmallestStep = 0x1p-24f;

TEST(Rgb9e5, HasTheValuesOfItsDefinition) {
  EXPECT_EQ(toRgb9e5(vec3(0.f)), 0u);
  EXPECT_EQ(toRgb9e5(vec3(1.f)), 16u << 27 | 256u << 18 | 256u << 9 | 256u);
  EXPECT_EQ(fromRgb9e5(16u << 27 | 256u), vec3(1.f, 0.f, 0.f));
  EXPECT_EQ(fromRgb9e5(31u << 27 | 511u << 9), vec3(0.f, kLargestRgb9e5, 0.f));
  EXPECT_EQ(fromRgb9e5(1u << 18), vec3(0.f, 0.f, kSmallestStep));
}

TEST(Rgb9e5, TakesWhatIsOutOfRangeForTheNearest) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(fromRgb9e5(toRgb9e5({-1.f, nan, 1.f})), vec3(0.f, 0.f, 1.f));
  EXPECT_EQ(fromRgb9e5(toRgb9e5(vec3(infinite))), vec3(kLargestRgb9e5));
  EXPECT_EQ(fromRgb9e5(toRgb9e5(vec3(1e6f, 0.f, 0.f))), vec3(kLargestRgb9e5, 0.f, 0.f));
  EXPECT_EQ(toRgb9e5(vec3(1e-30f)), 0u);
}

// Whose largest mantissa could not be halved stays itself.
TEST(Rgb9e5, RoundTripsWhatItCanSay) {
  Random random(1);
  for (std::uint32_t exponent = 0; exponent < 32; ++exponent)
    for (int i = 0; i < 2000; ++i) {
      std::uint32_t mantissas = random.below(1u << 27);
      if (exponent > 0) mantissas |= 256u << 9 * random.below(3);
      const std::uint32_t bits = mantissas | exponent << 27;
      ASSERT_EQ(toRgb9e5(fromRgb9e5(bits)), bits);
    }
}

TEST(Rgb9e5, IsTheNearestThereIs) {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const float scale = std::exp2(random.uniform(-20.f, 15.9f));
    const vec3 color = scale * vec3(random.uniform(), random.uniform(), random.uniform());
    const float largest = std::max({color.x, color.y, color.z});
    const vec3 found = fromRgb9e5(toRgb9e5(color));
    const float bound = std::max(largest / 512.f, 0.5f * kSmallestStep);
    for (int c = 0; c < 3; ++c) {
      ASSERT_LE(std::abs(found[c] - color[c]), bound) << largest;
      worst = std::max(worst, static_cast<double>(std::abs(found[c] - color[c]) / largest));
    }
  }
  EXPECT_GT(worst, 1 / 2000.);
}

}  // namespace
}  // namespace lucerna
