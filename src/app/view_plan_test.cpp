#include "app/view_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lucerna::app {
namespace {

// Every pixel another number.
Image numbered(uvec2 size) {
  Image image(static_cast<int>(size.x), static_cast<int>(size.y), 1, ComponentType::F32);
  const auto values = image.as<float>();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i + 1);
  return image;
}

// What a rendering of the window would show.
Image cut(const Image& picture, uvec2 origin, uvec2 size) {
  Image image(static_cast<int>(size.x), static_cast<int>(size.y), 1, ComponentType::F32);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      *image.pixel<float>(x, y) =
          *picture.pixel<float>(x + static_cast<int>(origin.x), y + static_cast<int>(origin.y));
  return image;
}

// The picture cut into the windows of a plan and joined again; `shift`: px that every rendering is
// off to the right.
Image joined(const Image& picture, const ViewPlan& plan, unsigned shift = 0) {
  Image result;
  for (const ViewPlan::Place& place : plan.places) {
    const uvec2 off(std::min(place.tile.window.x + shift, plan.picture.x - plan.window.x),
                    place.tile.window.y);
    placeTile(result, cut(picture, off, plan.window), plan, place.tile);
  }
  return result;
}

bool equal(const Image& a, const Image& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::ranges::equal(a.bytes(), b.bytes());
}

TEST(ViewPlan, OfOnePieceIsThePicture) {
  for (const int side : {0, 640, 4096}) {
    const ViewPlan plan = planViews({640, 360}, 1, side, 20);
    ASSERT_EQ(plan.places.size(), 1u) << side;
    EXPECT_EQ(plan.window, uvec2(640, 360));
    EXPECT_EQ(plan.places[0].tile.size, uvec2(640, 360));
  }
}

TEST(ViewPlan, TilesJoinToThePictureWhateverItsSize) {
  for (const uvec2 size : {uvec2(96, 64), uvec2(97, 63), uvec2(200, 16), uvec2(15, 300)})
    for (const int tile : {16, 32, 80})
      for (const int band : {0, 1, 16, 17, 60}) {
        SCOPED_TRACE(::testing::Message()
                     << size.x << "x" << size.y << " by " << tile << "+" << band);
        const Image picture = numbered(size);
        EXPECT_TRUE(equal(joined(picture, planViews(size, 1, tile, band)), picture));
      }
}

TEST(ViewPlan, AJoinThatIsOnePixelOffShows) {
  const Image picture = numbered({97, 64});
  const ViewPlan plan = planViews({97, 64}, 1, 32, 4);
  ASSERT_GT(plan.places.size(), 1u);
  EXPECT_TRUE(equal(joined(picture, plan), picture));
  EXPECT_FALSE(equal(joined(picture, plan, 1), picture));
}

TEST(ViewPlan, WindowsHoldTheGuardBandAndBeginOnTheGrid) {
  const uvec2 size(300, 200);
  for (const int band : {0, 5, 16, 40}) {
    const ViewPlan plan = planViews(size, 1, 64, band);
    const auto wide = static_cast<unsigned>(band);
    for (const ViewPlan::Place& place : plan.places) {
      const Tile& tile = place.tile;
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_EQ(tile.window[axis] % kTileGrid, 0u);
        const unsigned begin = tile.origin[axis], end = begin + tile.size[axis];
        EXPECT_LE(tile.window[axis], begin - std::min(begin, wide));
        EXPECT_GE(tile.window[axis] + plan.window[axis], std::min(end + wide, size[axis]));
        EXPECT_LE(tile.window[axis] + plan.window[axis], size[axis]) << "inside the picture";
      }
    }
  }
}

TEST(ViewPlan, EyesFollowEachOther) {
  const ViewPlan plan = planViews({64, 32}, 2, 32, 0);
  ASSERT_EQ(plan.places.size(), 4u);
  EXPECT_EQ(plan.eyes(), 2);
  EXPECT_EQ(plan.places[1].eye, 0);
  EXPECT_EQ(plan.places[2].eye, 1);
  EXPECT_EQ(plan.places[2].tile.origin, uvec2(0));
}

TEST(Eyes, StandBesideOrAboveEachOtherOrShareAPicture) {
  const auto pair = [] {
    std::vector<Image> eyes;
    for (const std::uint8_t value : {std::uint8_t{10}, std::uint8_t{20}}) {
      Image image(2, 1, 3, ComponentType::U8);
      std::ranges::fill(image.as<std::uint8_t>(), value);
      eyes.push_back(std::move(image));
    }
    return eyes;
  };
  const auto bytes = [](const Image& image) {
    const auto values = image.as<std::uint8_t>();
    return std::vector<int>(values.begin(), values.end());
  };
  const Image beside = joinEyes(pair(), StereoLayout::SideBySide);
  EXPECT_EQ(beside.width(), 4);
  EXPECT_EQ(bytes(beside), (std::vector<int>{10, 10, 10, 10, 10, 10, 20, 20, 20, 20, 20, 20}));
  const Image above = joinEyes(pair(), StereoLayout::TopBottom);
  EXPECT_EQ(above.height(), 2);
  EXPECT_EQ(bytes(above), bytes(beside));
  EXPECT_EQ(bytes(joinEyes(pair(), StereoLayout::Anaglyph)),
            (std::vector<int>{10, 20, 20, 10, 20, 20}));
}

}  // namespace
}  // namespace lucerna::app
