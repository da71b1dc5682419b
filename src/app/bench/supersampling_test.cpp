#include "app/bench/supersampling.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace lucerna::app::bench {
namespace {

constexpr uvec2 kSize{4, 3};
constexpr int kAcross = 4;

scene::View squareView() {
  scene::View view;
  view.clipFromView[1][1] = 2.f;
  return view;
}

// Samples whose reversed depth is what `depthAt` says of each column.
template <typename DepthAt>
Image samplesOf(const DepthAt& depthAt) {
  Image depth(kAcross * kSize.x, kAcross * kSize.y, 1, ComponentType::F32);
  for (int y = 0; y < depth.height(); ++y)
    for (int x = 0; x < depth.width(); ++x)
      *depth.pixel<float>(x, y) = depthAt(static_cast<float>(x));
  return depth;
}

// The columns of pixels that hold edges.
std::vector<int> edgeColumns(const Image& depth) {
  const Image edges = edgesOfSamples(depth, squareView(), kSize);
  std::vector<int> columns;
  for (int x = 0; x < edges.width(); ++x)
    if (*edges.pixel<std::uint8_t>(x, 1) != 0) columns.push_back(x);
  return columns;
}

// No sample of a neighbour has a share, however near it is.
TEST(Supersampling, APixelIsThePlainMeanOfItsOwnSamples) {
  Image samples(2 * kSize.x, 2 * kSize.y, 4, ComponentType::U8);
  std::ranges::fill(samples.as<std::uint8_t>(), 255);
  for (const int x : {2, 3, 4})
    for (int c = 0; c < 3; ++c) samples.pixel<std::uint8_t>(x, 0)[c] = 0;
  const Image mean = meanOfSamples(samples, kSize);
  ASSERT_EQ(mean.channels(), 3);
  EXPECT_FLOAT_EQ(mean.pixel<float>(0, 0)[0], 1.f);
  EXPECT_FLOAT_EQ(mean.pixel<float>(1, 0)[1], srgbFromLinear(0.5f));
  EXPECT_FLOAT_EQ(mean.pixel<float>(2, 0)[2], srgbFromLinear(0.75f));
  EXPECT_FLOAT_EQ(mean.pixel<float>(3, 0)[0], 1.f);
}

TEST(Supersampling, OneSampleIsThePicture) {
  Image samples(kSize.x, kSize.y, 4, ComponentType::U8);
  samples.pixel<std::uint8_t>(3, 2)[1] = 51;
  const Image mean = meanOfSamples(samples, kSize);
  EXPECT_NEAR(mean.pixel<float>(3, 2)[1], 0.2f, 1e-5f);
  EXPECT_EQ(mean.pixel<float>(3, 2)[0], 0.f);
}

TEST(Supersampling, APlaneHasNoEdgesHoweverSteep) {
  EXPECT_THAT(edgeColumns(samplesOf([](float x) { return 0.1f + 0.05f * x; })), testing::IsEmpty());
}

TEST(Supersampling, WhereTheDistanceJumpsIsAnEdge) {
  // Between the samples 5 and 6, both of column 1.
  EXPECT_THAT(edgeColumns(samplesOf([](float x) { return x < 6.f ? 0.2f : 0.1f; })),
              testing::ElementsAre(1));
}

TEST(Supersampling, WhereTwoSurfacesMeetIsAnEdge) {
  EXPECT_THAT(edgeColumns(samplesOf([](float x) { return 0.5f + 0.02f * std::abs(x - 9.f); })),
              testing::ElementsAre(2));
}

}  // namespace
}  // namespace lucerna::app::bench
