// Versions, copies, lifetimes, reuse, sizes, frequency and history.
#include "graph/schedule.hpp"

#include <gmock/gmock.h>

#include "graph/fake_pass.hpp"

namespace lucerna::graph {
namespace {

using gpu::Format;
using testing::ElementsAre;
using testing::HasSubstr;

class Schedules : public testing::Test {
 protected:
  Schedules() {
    add(registry_, FakePass("Make").out("color", Format::Rgba16Float));
    add(registry_,
        FakePass("Filter").in("color").out("color", Format::Rgba16Float).repeats("color"));
    add(registry_, FakePass("Update").inout("color"));
    add(registry_, FakePass("Start").inout("color", Format::Rgba16Float).optional().scaled(0.5f));
    add(registry_, FakePass("Mix").in("color").in("other").out("color", Format::Rgba16Float));
    add(registry_, FakePass("Trail").inout("color").in("past").history());
    add(registry_, FakePass("Mask").out("mask", Format::R8Unorm).fill(1).scaled(0.5f));
    add(registry_, FakePass("UseMask").in("mask").inout("color"));
  }

  Schedule of(std::vector<FakeRow> rows, const std::vector<std::string>& kept = {},
              uvec2 size = {640, 360}) {
    const Pipeline pipeline = pipelineOf(std::move(rows));
    const Validation result = validate(pipeline, registry_, gpu::Capabilities::baseline(), kept);
    EXPECT_TRUE(result.ok()) << result.text();
    return result.ok() ? makeSchedule(*result.plan, size) : Schedule{};
  }

  static std::vector<std::string> steps(const Schedule& schedule) {
    std::vector<std::string> names;
    for (const Step& step : schedule.steps) names.push_back(step.name);
    return names;
  }
  static const Version& version(const Schedule& schedule, const std::string& name) {
    for (const Version& v : schedule.versions)
      if (v.name == name) return v;
    ADD_FAILURE() << "no version " << name;
    return schedule.versions.at(0);
  }
  // No two values are in one texture at the same time.
  static void expectNoOverlap(const Schedule& s) {
    for (const PhysicalTexture& texture : s.textures)
      for (std::size_t i = 1; i < texture.versions.size(); ++i) {
        const Version& a = s.versions[texture.versions[i - 1]];
        const Version& b = s.versions[texture.versions[i]];
        EXPECT_EQ(a.texture, b.texture);
        // An update takes over at the step that last reads what it updates.
        EXPECT_LE(a.lastStep, b.firstStep) << a.name << " and " << b.name;
      }
  }

  static FakeRow row(const char* type, std::string name) {
    return FakeRow(type).named(std::move(name));
  }

  Registry registry_;
};

TEST_F(Schedules, AChainOfFiltersNeedsTwoTextures) {
  const Schedule s = of(
      {"Make", row("Filter", "F1"), row("Filter", "F2"), row("Filter", "F3"), row("Filter", "F4")});
  EXPECT_EQ(s.versions.size(), 5u);
  EXPECT_EQ(s.textures.size(), 2u);
  EXPECT_EQ(s.bytesWithoutReuse(), 5u * 640 * 360 * 8);
  EXPECT_EQ(s.bytes(), 2u * 640 * 360 * 8);
  expectNoOverlap(s);
}

TEST_F(Schedules, UpdatesStayInPlace) {
  const Schedule s = of({"Make", row("Update", "U1"), row("Update", "U2")});
  EXPECT_THAT(steps(s), ElementsAre("Make", "U1", "U2"));
  EXPECT_EQ(s.textures.size(), 1u);
  EXPECT_EQ(s.versions.size(), 3u);
  EXPECT_EQ(s.output, 2u);
}

TEST_F(Schedules, AnOptionalUpdateMakesWhatItDoesNotFind) {
  const Schedule made = of({"Start", "Update"});
  EXPECT_THAT(steps(made), ElementsAre("Start", "Update"));
  EXPECT_EQ(version(made, "Start.color").texture.width, 320);
  EXPECT_EQ(made.textures.size(), 1u);
  const Schedule updated = of({"Make", "Start"});
  EXPECT_EQ(version(updated, "Start.color").texture.width, 640) << "what it updates has its size";
  EXPECT_EQ(updated.textures.size(), 1u);
}

//    Make -> Update ---+
//      |               v
//      +------ other Mix
TEST_F(Schedules, ACopyStandsOnlyWhereAnOlderVersionIsStillRead) {
  const Schedule s = of({"Make", "Update", FakeRow("Mix").reads("other", "Make.color")});
  EXPECT_THAT(steps(s), ElementsAre("Make", "(copy) Make.color", "Update", "Mix"));
  EXPECT_NE(version(s, "Make.color").physical, version(s, "Update.color").physical);
  EXPECT_EQ(s.steps[1].from, 0u);
  EXPECT_EQ(s.steps[1].to, 1u);
  expectNoOverlap(s);
}

TEST_F(Schedules, OnlyTheLastOfTwoUpdatersWorksInPlace) {
  const Schedule s = of({"Make", row("Update", "U1"), row("Update", "U2").reads("color", "Make"),
                         FakeRow("Mix").reads("color", "U1").reads("other", "U2.color")});
  EXPECT_THAT(steps(s), ElementsAre("Make", "(copy) Make.color", "U1", "U2", "Mix"));
  EXPECT_EQ(version(s, "Make.color").physical, version(s, "U2.color").physical);
}

TEST_F(Schedules, ARowThatAlsoReadsWhatItUpdatesGetsACopy) {
  add(registry_, FakePass("Both").inout("color").in("other"));
  const Schedule s = of({"Make", FakeRow("Both").reads("other", "Make.color")});
  EXPECT_THAT(steps(s), ElementsAre("Make", "(copy) Make.color", "Both"));
}

TEST_F(Schedules, KeptVersionsAreCopiedBeforeAnUpdateAndLast) {
  const Schedule s =
      of({"Make", "Update", row("Filter", "F1"), row("Filter", "F2")}, {"Make.color"});
  EXPECT_THAT(steps(s), ElementsAre("Make", "(copy) Make.color", "Update", "F1", "F2"));
  EXPECT_EQ(version(s, "Make.color").lastStep, s.steps.size());
  EXPECT_EQ(s.kept, (std::vector<std::size_t>{0}));
  expectNoOverlap(s);
}

TEST_F(Schedules, TheOutputOutlivesAllSteps) {
  add(registry_, FakePass("Write").in("color"));  // no outputs: a sink
  const Schedule s = of({"Make", row("Filter", "F1"), "Write"});
  EXPECT_EQ(s.versions[s.output].lastStep, s.steps.size());
}

TEST_F(Schedules, StandInsAreFilledOnceAtTheSizeOfWhatTheyReplace) {
  const Schedule s = of({FakeRow("Mask").off(), "Make", "UseMask"}, {}, {641, 361});
  EXPECT_THAT(steps(s), ElementsAre("(fill) Mask.mask", "Make", "UseMask"));
  EXPECT_EQ(s.steps[0].kind, Step::Kind::Fill);
  EXPECT_EQ(s.steps[0].fill, vec4(1));
  const Version& mask = version(s, "Mask.mask");
  EXPECT_EQ(mask.texture.width, 321);
  EXPECT_EQ(mask.texture.height, 181);
  EXPECT_EQ(mask.texture.format, Format::R8Unorm);
  EXPECT_TRUE(s.textures[mask.physical].keepsContent);
}

TEST_F(Schedules, AStandInFollowsTheSizeOfADisabledRowsInput) {
  add(registry_, FakePass("Small").out("color", Format::Rgba16Float).size(100, 50));
  add(registry_,
      FakePass("Ao").in("color").out("ao", Format::R8Unorm).sizeOf("color", 0.5f).fill(1));
  add(registry_, FakePass("UseAo").in("ao").inout("color"));
  const Schedule s = of({"Small", FakeRow("Ao").off(), "UseAo"});
  EXPECT_EQ(version(s, "Ao.ao").texture.width, 50);
  EXPECT_EQ(version(s, "Ao.ao").texture.height, 25);
}

TEST_F(Schedules, AnUpdateOfAStandInCopiesIt) {
  add(registry_, FakePass("Change").inout("mask"));
  const Schedule s = of({FakeRow("Mask").off(), "Change", "Make", "UseMask"});
  EXPECT_THAT(steps(s),
              ElementsAre("(fill) Mask.mask", "(copy) Mask.mask", "Change", "Make", "UseMask"));
}

TEST_F(Schedules, SizesAreRelations) {
  add(registry_,
      FakePass("Half").in("color").out("color", Format::Rgba16Float).sizeOf("color", 0.5f));
  add(registry_, FakePass("Fixed").out("color", Format::Rgba16Float).size(7, 3));
  const auto size = [&](std::vector<FakeRow> rows, uvec2 output) {
    const Schedule s = of(std::move(rows), {}, output);
    const gpu::TextureDesc& desc = s.versions[s.output].texture;
    return uvec2(desc.width, desc.height);
  };
  EXPECT_EQ(size({"Make", "Half"}, {641, 361}), uvec2(321, 181));
  EXPECT_EQ(size({"Make", "Half", row("Half", "Quarter")}, {640, 360}), uvec2(160, 90));
  EXPECT_EQ(size({"Make", "Half"}, {1, 1}), uvec2(1, 1));
  EXPECT_EQ(size({"Fixed", "Update", "Half"}, {640, 360}), uvec2(4, 2));
}

TEST_F(Schedules, ScalesThatAreNoExactFloatsRoundAsWritten) {
  add(registry_, FakePass("Tenth").out("color", Format::Rgba16Float).scaled(0.1f));
  const Schedule s = of({"Tenth"}, {}, {640, 355});
  EXPECT_EQ(s.versions[0].texture.width, 64);
  EXPECT_EQ(s.versions[0].texture.height, 36);
}

TEST_F(Schedules, DifferentSizesDoNotShare) {
  add(registry_,
      FakePass("Half").in("color").out("color", Format::Rgba16Float).sizeOf("color", 0.5f));
  const Schedule s = of({"Make", "Half", row("Half", "Quarter")});
  EXPECT_EQ(s.textures.size(), 3u);
}

TEST_F(Schedules, HistoryIsDoubledAndKeepsItsTexture) {
  const Schedule s = of({"Make", FakeRow("Trail").reads("past", "Trail.color"), row("Filter", "F1"),
                         row("Filter", "F2")});
  const Version& trail = version(s, "Trail.color");
  EXPECT_TRUE(trail.history);
  EXPECT_TRUE(s.textures[trail.physical].history);
  EXPECT_TRUE(s.textures[trail.physical].perView);
  EXPECT_EQ(trail.lastStep, s.steps.size());
  for (const std::size_t v : s.textures[trail.physical].versions)
    EXPECT_THAT(s.versions[v].name, testing::AnyOf("Make.color", "Trail.color"));
}

TEST_F(Schedules, HistoryOfAnOlderVersionNeedsACopy) {
  const Schedule s = of({"Make", "Update", FakeRow("Trail").reads("past", "Make.color")});
  EXPECT_THAT(steps(s), ElementsAre("Make", "(copy) Make.color", "Update", "Trail"));
}

TEST_F(Schedules, PersistentOutputsKeepTheirTexture) {
  add(registry_, FakePass("Cache").out("color", Format::Rgba16Float).persistent());
  const Schedule s = of({"Cache", "Update", row("Filter", "F1"), row("Filter", "F2")});
  EXPECT_THAT(steps(s), ElementsAre("Cache", "(copy) Cache.color", "Update", "F1", "F2"));
  const auto& cache = s.textures[version(s, "Cache.color").physical];
  EXPECT_TRUE(cache.keepsContent);
  EXPECT_EQ(cache.versions.size(), 1u);
}

TEST_F(Schedules, RareStepsComeFirstAndTheirResultsLast) {
  add(registry_, FakePass("Sky").runs(Frequency::PerScene).out("sky", Format::Rgba16Float));
  add(registry_, FakePass("Group").runs(Frequency::PerViewGroup).out("group", Format::Rgba16Float));
  add(registry_, FakePass("Use").in("sky").in("group").inout("color"));
  const Schedule s = of({"Make", "Group", "Sky", "Use", row("Filter", "F1"), row("Filter", "F2")});
  EXPECT_THAT(steps(s), ElementsAre("Sky", "Group", "Make", "Use", "F1", "F2"));
  EXPECT_TRUE(s.textures[version(s, "Sky.sky").physical].keepsContent);
  EXPECT_FALSE(s.textures[version(s, "Sky.sky").physical].perView);
  EXPECT_EQ(version(s, "Group.group").lastStep, s.steps.size()) << "the next view reads it too";
  expectNoOverlap(s);
}

TEST_F(Schedules, AnUpdatePerViewOfAValuePerSceneCopies) {
  add(registry_, FakePass("Sky").runs(Frequency::PerScene).out("color", Format::Rgba16Float));
  EXPECT_THAT(steps(of({"Sky", "Update"})), ElementsAre("Sky", "(copy) Sky.color", "Update"));
}

TEST_F(Schedules, OptionalOutputsAreMadeOnlyIfRead) {
  add(registry_, FakePass("Two")
                     .out("color", Format::Rgba16Float)
                     .out("extra", Format::R8Unorm)
                     .optional()
                     .out("other", Format::R8Unorm));
  const Schedule s = of({"Two"});
  EXPECT_EQ(s.steps[0].versions[1], kNoVersion);
  EXPECT_EQ(version(s, "Two.other").lastStep, 0u) << "as short a life as can be";
  EXPECT_EQ(s.versions.size(), 2u);
  EXPECT_NE(of({"Two"}, {"Two.extra"}).steps[0].versions[1], kNoVersion);
}

TEST_F(Schedules, CulledRowsHaveNoStep) {
  const Schedule s = of({"Make", "Mask", "Update"});
  EXPECT_THAT(steps(s), ElementsAre("Make", "Update"));
}

TEST_F(Schedules, TenPassesNeedThreeTextures) {
  std::vector<FakeRow> rows{"Make"};
  for (int i = 1; i <= 8; ++i) rows.push_back(row("Filter", "F" + std::to_string(i)));
  rows.push_back(FakeRow("Mix").reads("other", "F2.color"));
  const Schedule s = of(std::move(rows));
  EXPECT_EQ(s.steps.size(), 10u);
  EXPECT_EQ(s.textures.size(), 3u);
  expectNoOverlap(s);
}

TEST_F(Schedules, TheSameInputGivesTheSameSchedule) {
  const auto print = [&] {
    const Pipeline pipeline = pipelineOf({"Make", FakeRow("Mask").off(), "UseMask", "Update",
                                          FakeRow("Mix").reads("other", "Make.color")});
    const Validation result = validate(pipeline, registry_, gpu::Capabilities::baseline());
    const Schedule s = makeSchedule(*result.plan, {640, 360});
    return printWiring(pipeline, *result.plan, s) + toSvg(pipeline, *result.plan, s);
  };
  EXPECT_EQ(print(), print());
  EXPECT_THAT(print(), HasSubstr("(copy) Make.color"));
}

}  // namespace
}  // namespace lucerna::graph
