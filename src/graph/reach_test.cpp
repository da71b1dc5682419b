#include "graph/reach.hpp"

#include <gtest/gtest.h>

#include "graph/fake_pass.hpp"

namespace lucerna::graph {
namespace {

using gpu::Format;

class Reaches : public testing::Test {
 protected:
  Reaches() {
    add(registry_, FakePass("Make").out("color", Format::Rgba16Float));
    add(registry_, FakePass("Blur").in("color").halo(3).out("color", Format::Rgba16Float));
    add(registry_,
        FakePass("Anywhere").in("color").halo(kWholeImage).out("color", Format::Rgba16Float));
    add(registry_, FakePass("Half").in("color").out("color", Format::Rgba16Float).scaled(0.5f));
    add(registry_, FakePass("Mix").in("color").in("other").out("color", Format::Rgba16Float));
  }

  Reach of(std::vector<FakeRow> rows, const std::vector<std::string>& kept = {}) {
    const Validation result =
        validate(pipelineOf(std::move(rows)), registry_, gpu::Capabilities::baseline(), kept);
    EXPECT_TRUE(result.ok()) << result.text();
    return result.ok() ? reachOf(*result.plan) : Reach{};
  }

  Registry registry_;
};

TEST_F(Reaches, AddUpAlongTheWay) {
  EXPECT_EQ(of({"Make"}).pixels, 0);
  EXPECT_EQ(of({"Make", "Blur", FakeRow("Blur").named("B2")}).pixels, 6);
}

TEST_F(Reaches, AreTheGreatestOfSeveralWays) {
  const Reach reach = of({"Make", "Blur", FakeRow("Blur").named("B2"),
                          FakeRow("Mix").reads("color", "Make.color").reads("other", "B2.color")});
  EXPECT_EQ(reach.pixels, 6);
  EXPECT_EQ(
      of({"Make", "Blur", FakeRow("Mix").reads("color", "Make.color").reads("other", "Make.color")},
         {"Blur.color"})
          .pixels,
      3)
      << "kept values count, too";
}

TEST_F(Reaches, ArePixelsOfTheOutputAlsoOfSmallTextures) {
  EXPECT_EQ(of({"Make", "Half", "Blur"}).pixels, 6);
}

TEST_F(Reaches, NameAnInputThatReadsEverywhere) {
  EXPECT_EQ(of({"Make", "Anywhere", "Blur"}).whole, "Anywhere.color");
  EXPECT_EQ(of({"Make", "Blur"}).whole, "");
}

}  // namespace
}  // namespace lucerna::graph
