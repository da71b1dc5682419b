#include "trace/low_discrepancy.hpp"

#include <gtest/gtest.h>

#include <set>

namespace lucerna::trace {
namespace {

// The defining property of a (0, 2)-sequence: of 2^k points in a row that start at a multiple of
// 2^k, each box 2^-i by 2^-(k-i) holds one.
TEST(LowDiscrepancy, EveryElementaryBoxHoldsOnePoint) {
  constexpr int kBits = 6, kCount = 1 << kBits;
  for (const std::uint32_t sequence : {0u, 1u, 77u, 0xdeadbeefu})
    for (const std::uint32_t first : {0u, 64u, 960u})
      for (int i = 0; i <= kBits; ++i) {
        std::set<std::pair<int, int>> boxes;
        for (std::uint32_t n = 0; n < kCount; ++n) {
          const vec2 p = lowDiscrepancyPoint(first + n, sequence);
          ASSERT_TRUE(p.x >= 0.f && p.x < 1.f && p.y >= 0.f && p.y < 1.f);
          boxes.emplace(static_cast<int>(p.x * static_cast<float>(1 << i)),
                        static_cast<int>(p.y * static_cast<float>(1 << (kBits - i))));
        }
        EXPECT_EQ(boxes.size(), kCount) << sequence << ", " << first << ", " << i;
      }
}

// Neighbouring pixels and purposes must not see the same pattern.
TEST(LowDiscrepancy, SequencesAreUnrelated) {
  constexpr std::uint32_t kCount = 4096;
  double mean = 0, product = 0;
  for (std::uint32_t s = 0; s < kCount; ++s) {
    const vec2 a = lowDiscrepancyPoint(0, mixed(7, s)), b = lowDiscrepancyPoint(0, mixed(7, s + 1));
    mean += static_cast<double>(a.x) / kCount;
    product += static_cast<double>((a.x - 0.5f) * (b.x - 0.5f)) / kCount;
  }
  // Standard errors: 0.29 / 64 and 1/12 / 64; four of them.
  EXPECT_NEAR(mean, 0.5, 0.018);
  EXPECT_NEAR(product, 0.0, 0.0053);
}

}  // namespace
}  // namespace lucerna::trace
