#include "app/bench/shadow_methods.hpp"

#include <gmock/gmock.h>

#include "passes/register_passes.hpp"

namespace lucerna::app::bench {
namespace {

TEST(ShadowMethods, HaveRowsAndParametersThatExist) {
  graph::Registry registry;
  passes::registerPasses(registry);
  for (const std::string& name : shadowMethodNames())
    for (const Row& row : chainOf(shadowMethod(name), {}).rows) {
      const graph::PassType* type = registry.find(row.pass);
      ASSERT_TRUE(type) << name << ": " << row.pass;
      const graph::PassDescription description = type->describe({});
      for (const std::string& setting : row.settings)
        EXPECT_TRUE(description.param(setting.substr(0, setting.find('='))))
            << name << ": " << row.pass << "." << setting;
    }
}

TEST(ShadowMethods, MapsAreDrawnWhereThereAreShadows) {
  const auto hasMaps = [](const std::string& name) {
    return std::ranges::any_of(chainOf(shadowMethod(name), {}).rows,
                               [](const Row& row) { return row.pass == "ShadowMaps"; });
  };
  EXPECT_FALSE(hasMaps("lighting alone"));
  EXPECT_TRUE(hasMaps("hard"));
  EXPECT_TRUE(hasMaps("layered 11"));
}

TEST(ShadowMethods, TapsGrowWithTheSquareOfTheKernelOrNot) {
  EXPECT_EQ(shadowMethod("lighting alone").taps.at(16, 0), 0);
  EXPECT_EQ(shadowMethod("hard").taps.at(3, 0), 3);
  EXPECT_EQ(shadowMethod("pcss 5+11").taps.at(2, 0), 2 * (25 + 121));
  const auto taps = [](const char* name) { return shadowMethod(name).taps.at(3, 5); };
  // A blur of so many taps more, in a fourth of the pixels: of the mask, and of two times four
  // layers.
  EXPECT_DOUBLE_EQ(taps("layered 23") - taps("layered 11"), 12 * 0.25 * (1 + 2));
  // Each of three lights once more in a fourth of the pixels.
  EXPECT_DOUBLE_EQ(taps("layered 11, sampled") - taps("layered 11"), 3 * 0.25);
  // Bytes of two times four layers in place of the mask, which is made of them.
  EXPECT_DOUBLE_EQ(taps("layered 11, exponential") - taps("layered 11"), 2 + 11 * 0.25 * (2 - 1));
}

}  // namespace
}  // namespace lucerna::app::bench
