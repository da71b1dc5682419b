#include "app/bench/statistics.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.hpp"

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

TEST(Statistics, AnyQuantileCanBeAskedFor) {
  const std::vector<double> samples{8, 1, 4, 2};
  EXPECT_DOUBLE_EQ(quantileOf(samples, 0.25), spreadOf(samples).lower);
  EXPECT_DOUBLE_EQ(quantileOf(samples, 0.9), 6.8);
  EXPECT_EQ(quantileOf({}, 0.9), 0);
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
  EXPECT_NEAR(onLogCurve(points, 2).value(), 6, 1e-12);
  EXPECT_NEAR(onLogCurve(points, 5).value(), 2.4, 1e-12);
  EXPECT_EQ(onLogCurve(points, 4), 3);
}

TEST(Statistics, ACurveEndsAtItsPoints) {
  const std::vector<glm::dvec2> points{{1, 12}, {4, 3}, {6, 2}};
  EXPECT_EQ(onLogCurve(points, 0.99), std::nullopt);
  EXPECT_EQ(onLogCurve(points, 6.01), std::nullopt);
  EXPECT_EQ(onLogCurve(points, 1), 12);
  EXPECT_EQ(onLogCurve(points, 6), 2);
  EXPECT_EQ(onLogCurve({}, 1), std::nullopt);
}

// The third point took less time than the second: it still lies between its neighbours.
TEST(Statistics, ACurveGoesThroughItsPointsInTheirOrder) {
  const std::vector<glm::dvec2> points{{1, 12}, {4, 3}, {3, 2}, {9, 1}};
  EXPECT_EQ(onLogCurve(points, 3), 2);
  EXPECT_NEAR(onLogCurve(points, 2).value(), 6, 1e-12);
  EXPECT_NEAR(onLogCurve(points, std::sqrt(27.)).value(), std::sqrt(2.), 1e-12);
}

TEST(Statistics, WithoutErrorThereIsNoLogarithm) {
  EXPECT_EQ(onLogCurve(std::vector<glm::dvec2>{{1, 0}, {4, 3}}, 2), std::nullopt);
  EXPECT_EQ(onLogCurve(std::vector<glm::dvec2>{{1, 0}, {4, 3}}, 1), std::nullopt);
}

TEST(Statistics, SlopesAreThoseOfLeastSquares) {
  EXPECT_DOUBLE_EQ(slopeOf(std::vector<glm::dvec2>{{1, 7}, {4, 13}, {16, 37}}), 2);
  // Worked out by R: lm(c(1, 2, 2, 6) ~ c(0, 1, 2, 3))
  EXPECT_DOUBLE_EQ(slopeOf(std::vector<glm::dvec2>{{0, 1}, {1, 2}, {2, 2}, {3, 6}}), 1.5);
  EXPECT_EQ(slopeOf(std::vector<glm::dvec2>{{3, 1}, {3, 2}}), 0);
  EXPECT_EQ(slopeOf({}), 0);
}

TEST(Statistics, AnInfiniteSampleLeavesTheLowerQuantilesAlone) {
  const double infinite = std::numeric_limits<double>::infinity();
  const Spread spread = spreadOf(std::vector<double>{1, 2, infinite});
  EXPECT_EQ(spread.median, 2);
  EXPECT_EQ(spread.lower, 1.5);
  EXPECT_EQ(spread.max, infinite);
  EXPECT_EQ(spreadOf(std::vector<double>{infinite, infinite}).median, infinite);
}

// One camera is ten times as dear as the other: the ratio is 2 at both, that of the pooled medians
// anything.
TEST(Statistics, RatiosAreOfTheSameTurn) {
  EXPECT_EQ(pairedRatios(std::vector<double>{2, 20, 200}, std::vector<double>{1, 10, 100}),
            (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(pairedRatios(std::vector<double>{2, 3}, std::vector<double>{1, 0}),
            std::vector<double>{2});
  EXPECT_TRUE(pairedRatios(std::vector<double>{2, 3}, std::vector<double>{1}).empty());
}

TEST(Statistics, WhatGrowsWithTheSizeIsEstimatedExactly) {
  const Estimate estimate =
      estimateTotal(std::vector<double>{2, 6, 0}, std::vector<double>{1, 3, 0}, 40, 30);
  EXPECT_DOUBLE_EQ(estimate.total, 80);
  EXPECT_DOUBLE_EQ(estimate.share, 0.1);
  EXPECT_DOUBLE_EQ(estimate.error, 0);
}

TEST(Statistics, AnEstimateOfNothingIsNothing) {
  EXPECT_EQ(estimateTotal({}, {}, 40, 30).total, 0);
  EXPECT_EQ(estimateTotal(std::vector<double>{1}, std::vector<double>{0}, 40, 30).total, 0);
}

TEST(Statistics, AllOfItHasNoError) {
  const std::vector<double> cost{1, 2, 4}, size{1, 1, 1};
  const Estimate estimate = estimateTotal(cost, size, 3, 3);
  EXPECT_DOUBLE_EQ(estimate.total, 7);
  EXPECT_DOUBLE_EQ(estimate.error, 0);
}

// Over many samples the totals scatter by as much as each of them says.
TEST(Statistics, TheErrorOfAnEstimateIsHowFarItIsOff) {
  constexpr std::size_t kParts = 400, kSample = 40;
  Random random(7);
  std::vector<double> cost(kParts), size(kParts);
  double all = 0, allSize = 0;
  for (std::size_t i = 0; i < kParts; ++i) {
    size[i] = random.uniform(1, 5);
    cost[i] = 2 * size[i] * random.uniform(0.5f, 1.5f);
    all += cost[i];
    allSize += size[i];
  }
  double squares = 0, said = 0;
  constexpr int kTimes = 2000;
  for (int time = 0; time < kTimes; ++time) {
    std::vector<double> someCost, someSize;
    for (std::uint32_t i = 0; i < kSample; ++i) {
      const std::uint32_t other = i + random.below(kParts - i);
      std::swap(cost[i], cost[other]);
      std::swap(size[i], size[other]);
      someCost.push_back(cost[i]);
      someSize.push_back(size[i]);
    }
    const Estimate estimate = estimateTotal(someCost, someSize, allSize, kParts);
    squares += (estimate.total - all) * (estimate.total - all) / kTimes;
    said += estimate.error / kTimes;
  }
  EXPECT_NEAR(said / std::sqrt(squares), 1, 0.08);
}

}  // namespace
}  // namespace lucerna::app::bench
