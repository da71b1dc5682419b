#include "gpu/format.hpp"

#include <gtest/gtest.h>

#include "gpu/texture.hpp"

namespace lucerna::gpu {
namespace {

TEST(Format, TableFollowsTheEnumeration) {
  int index = 0;
  for (const FormatInfo& format : allFormats()) {
    EXPECT_EQ(static_cast<int>(format.format), index++) << format.name;
    EXPECT_EQ(&info(format.format), &format);
    EXPECT_EQ(formatFromName(format.name), format.format);
    EXPECT_EQ(format.bytes % format.channels,
              format.name == "R11G11B10Float" || format.name == "Rgb9E5" ? 4 % 3 : 0)
        << format.name;
  }
  EXPECT_EQ(index, static_cast<int>(Format::Depth32FStencil8) + 1);
}

TEST(Format, NamesAreExact) {
  EXPECT_EQ(formatFromName("rgba16float"), std::nullopt);
  EXPECT_EQ(formatFromName(""), std::nullopt);
  EXPECT_EQ(info(Format::Rgba16Float).bytes, 8);
}

TEST(TextureDesc, BytesCountLevelsLayersAndSamples) {
  EXPECT_EQ((TextureDesc{.width = 4, .height = 2}.bytes()), 4u * 2 * 4);
  // 4x2, 2x1, 1x1
  EXPECT_EQ((TextureDesc{.width = 4, .height = 2, .levels = 0}.bytes()), (8u + 2 + 1) * 4);
  EXPECT_EQ(
      (TextureDesc{.kind = TextureKind::Array2D, .width = 4, .height = 4, .layers = 3}.bytes()),
      16u * 3 * 4);
  EXPECT_EQ((TextureDesc{.kind = TextureKind::Multisample2D,
                         .format = Format::Rgba16Float,
                         .width = 8,
                         .height = 8,
                         .samples = 4}
                 .bytes()),
            64u * 8 * 4);
  // A 2 GiB texture does not overflow.
  EXPECT_EQ((TextureDesc{.format = Format::Rgba32Float, .width = 16384, .height = 16384}.bytes()),
            4ull << 30);
}

}  // namespace
}  // namespace lucerna::gpu
