#include "app/bench/statistics.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace lucerna::app::bench {
namespace {

TEST(Statistics, QuantilesLieBetweenSamplesInProportion) {
  // Worked out by R: quantile(c(1, 2, 4, 8), c(0, .25, .5, .75, 1), type = 7)
  const Spread spread = spreadOf(std::vector<double>{8, 1, 4, 2});
  EXPECT_DOUBLE_EQ(spread.min, 1);
  EXPECT_DOUBLE_EQ(spread.lower, 1.75);
  EXPECT_DOUBLE_EQ(spread.median, 3);
  EXPECT_DOUBLE_EQ(spread.upper, 5);
  EXPECT_DOUBLE_EQ(spread.max, 8);
}

TEST(Statistics, OneSampleIsAllOfIt) {
  const Spread spread = spreadOf(std::vector<double>{7});
  EXPECT_EQ(spread.lower, 7);
  EXPECT_EQ(spread.median, 7);
  EXPECT_EQ(spread.upper, 7);
}

TEST(Statistics, OneBadSampleDoesNotMoveTheMedian) {
  EXPECT_DOUBLE_EQ(spreadOf(std::vector<double>{3, 3, 1000}).median, 3);
  EXPECT_DOUBLE_EQ(spreadOf({}).median, 0);
}

// y = 12 / x is straight on logarithmic axes.
TEST(Statistics, ACurveIsStraightOnLogarithmicAxes) {
  const std::vector<glm::dvec2> points{{1, 12}, {4, 3}, {6, 2}};
  EXPECT_NEAR(onLogCurve(points, 2), 6, 1e-12);
  EXPECT_NEAR(onLogCurve(points, 5), 2.4, 1e-12);
  EXPECT_DOUBLE_EQ(onLogCurve(points, 4), 3);
  EXPECT_DOUBLE_EQ(onLogCurve(points, 0.5), 12);
  EXPECT_DOUBLE_EQ(onLogCurve(points, 60), 2);
}

}  // namespace
}  // namespace lucerna::app::bench
