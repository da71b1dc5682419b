#include "graph/reach.hpp"

#include <gmock/gmock.h>

#include "graph/fake_pass.hpp"

namespace lucerna::graph {
namespace {

using gpu::Format;

struct View {
  static constexpr const char* kPortName = "View";
};
struct Lights {
  static constexpr const char* kPortName = "Lights";
};

class Reaches : public testing::Test {
 protected:
  Reaches() {
    add(registry_, FakePass("Make").out("color", Format::Rgba16Float));
    add(registry_, FakePass("Blur").in("color").halo(3).out("color", Format::Rgba16Float));
    add(registry_,
        FakePass("Anywhere").in("color").halo(kWholeImage).out("color", Format::Rgba16Float));
    add(registry_, FakePass("Half").in("color").out("color", Format::Rgba16Float).scaled(0.5f));
    add(registry_, FakePass("Mix").in("color").in("other").out("color", Format::Rgba16Float));
    // Values of a size of their own: a mean, a middle pixel, a noise, a shadow map.
    add(registry_,
        FakePass("Mean").in("color").halo(kWholeImage).out("small", Format::R32Float).size(1, 1));
    add(registry_, FakePass("Middle").in("color").out("small", Format::R32Float).size(1, 1));
    add(registry_, FakePass("Noise").out("small", Format::R32Float).size(64, 64));
    add(registry_, FakePass("Sky").out("color", Format::Rgba16Float).runs(Frequency::PerViewGroup));
    registry_.addResource<View>("view", "", true);
    registry_.addResource<Lights>("lights", "");
    add(registry_, FakePass("OfLights")
                       .data<Lights>("lights", Direction::In)
                       .out("small", Format::R32Float)
                       .size(64, 64));
    add(registry_, FakePass("OfView")
                       .data<View>("view", Direction::In)
                       .out("small", Format::R32Float)
                       .size(64, 64));
    add(registry_, FakePass("Use").in("color").in("small").out("color", Format::Rgba16Float));
    add(registry_,
        FakePass("Trail").in("color").in("past").history().out("color", Format::Rgba16Float));
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

TEST_F(Reaches, GoThroughValuesOfASizeOfTheirOwn) {
  EXPECT_EQ(of({"Make", "Mean", "Use"}).whole, "Mean.color");
  EXPECT_EQ(of({"Make", "Middle", "Use"}).whole, "Middle.color") << "any pixel may come from any";
  EXPECT_EQ(of({"Make", "Anywhere", "Middle", FakeRow("Use").reads("color", "Make")}).whole,
            "Middle.color");
  EXPECT_EQ(of({"Make", "OfView", "Use"}).whole, "OfView.view");
  EXPECT_EQ(
      of({"Make", "OfView", FakeRow("Use").named("Last").reads("small", "OfView"), "Blur"}).why,
      "'small', which is made from it, has a size of its own");
}

TEST_F(Reaches, NameAPictureThatIsMadeOnceForAllTiles) {
  EXPECT_EQ(of({"Sky", "Blur"}).whole, "Sky.color");
  EXPECT_EQ(of({"Sky"}).whole, "Sky.color");
}

TEST_F(Reaches, CountNothingOfWhatIsTheSameInEveryTile) {
  EXPECT_EQ(of({"Make", "Noise", "Use", "Blur"}).whole, "");
  EXPECT_EQ(of({"Make", "OfLights", "Use", "Blur"}).whole, "");
  EXPECT_EQ(of({"Make", "OfLights", "Use", "Blur"}).pixels, 3);
}

TEST_F(Reaches, AddUpWithoutEndWhereHistoryClosesACircle) {
  const auto trail = [] { return FakeRow("Trail").reads("past", "Blur.color"); };
  const Reach reach = of({"Make", trail(), "Blur"});
  EXPECT_EQ(reach.whole, "Blur.color");
  EXPECT_THAT(reach.why, testing::HasSubstr("3 px adds up frame by frame"));
  EXPECT_EQ(of({"Make", "Blur", FakeRow("Trail").reads("past", "Trail.color")}).whole, "")
      << "a circle without a halo";
  EXPECT_EQ(of({"Make", "Blur", FakeRow("Trail").reads("past", "Trail.color")}).pixels, 3);
  EXPECT_EQ(of({"Make", FakeRow("Trail").reads("past", "Blur.color"),
                FakeRow("Blur").reads("color", "Make"),
                FakeRow("Mix").reads("color", "Trail").reads("other", "Blur.color")})
                .whole,
            "")
      << "history that is no circle";
}

// Wherever the walk begins.
TEST_F(Reaches, AreThoseOfAllRowsOnACircleWithoutAHalo) {
  const Reach reach =
      of({"Make", FakeRow("Blur").named("Soft"),
          FakeRow("Trail").named("A").reads("color", "Make").reads("past", "B.color"),
          FakeRow("Mix").named("B").reads("color", "A").reads("other", "Soft.color"),
          FakeRow("Blur").named("Softer").reads("color", "A"),
          FakeRow("Mix").reads("color", "B").reads("other", "Softer.color")});
  EXPECT_EQ(reach.whole, "");
  EXPECT_EQ(reach.pixels, 6);
}

}  // namespace
}  // namespace lucerna::graph
