// The rules of binding, in the order of the table in docs/dev/graph.md.
#include <gmock/gmock.h>

#include "graph/fake_pass.hpp"
#include "graph/validate.hpp"

namespace lucerna::graph {
namespace {

using gpu::Format;

struct Scene {
  static constexpr const char* kPortName = "Scene";
};

class Wiring : public testing::Test {
 protected:
  Wiring() {
    registry_.addResource<Scene>("scene", "");
    add(registry_, FakePass("Make").out("a", Format::R8Unorm));
    add(registry_, FakePass("Filter").in("a").out("a", Format::R8Unorm).repeats("a"));
    add(registry_, FakePass("White").out("a", Format::R8Unorm).fill(1));
    add(registry_, FakePass("Bare").out("a", Format::R8Unorm));
    add(registry_, FakePass("Update").inout("a"));
    add(registry_, FakePass("Start").inout("a", Format::R8Unorm).optional().fill(1));
    add(registry_, FakePass("Float").out("a", Format::R32Float));
    add(registry_, FakePass("Show").in("a").out("color", Format::Rgba8Unorm));
    add(registry_, FakePass("ShowIfAny").in("a").optional().out("color", Format::Rgba8Unorm));
    add(registry_,
        FakePass("Draw").data<Scene>("scene", Direction::In).out("color", Format::Rgba8Unorm));
    add(registry_, FakePass("Past").in("a").history().out("color", Format::Rgba8Unorm));
  }

  // What the last row's first input is bound to, as "Row.port", "fill Row.port", "resource" or "-".
  std::string source(std::vector<FakeRow> rows) { return source(std::move(rows), 0); }
  // The same of the row before the last.
  std::string updated(std::vector<FakeRow> rows) { return source(std::move(rows), 1); }
  std::string source(std::vector<FakeRow> rows, std::size_t fromBack) {
    const Pipeline pipeline = pipelineOf(std::move(rows));
    const Validation result = validate(pipeline, registry_, gpu::Capabilities::baseline());
    if (!result.ok()) return result.text();
    const auto& resolved = result.plan->rows;
    const Source& source = resolved.at(resolved.size() - 1 - fromBack).inputs.at(0).source;
    switch (source.kind) {
      case Source::Kind::Unbound:
        return "-";
      case Source::Kind::Resource:
        return "resource " + source.port;
      case Source::Kind::Output:
        return pipeline.passes[source.row].name + "." + source.port;
      case Source::Kind::Fill:
        return "fill " + pipeline.passes[source.row].name + "." + source.port;
    }
    return "";
  }

  static FakeRow make(std::string name) { return FakeRow("Make").named(std::move(name)); }

  Registry registry_;
};

TEST_F(Wiring, NamedByReads) {
  EXPECT_EQ(source({make("A"), make("B"), FakeRow("Show").reads("a", "A.a")}), "A.a");
  EXPECT_EQ(source({make("A"), make("B"), FakeRow("Show").reads("a", "A")}), "A.a");
}

TEST_F(Wiring, NamedDisabledRowGivesItsStandIn) {
  EXPECT_EQ(
      source({make("A"), FakeRow("White").off(), make("B"), FakeRow("Show").reads("a", "White")}),
      "fill White.a");
  EXPECT_EQ(
      source({make("A"), FakeRow("Filter").off(), make("B"), FakeRow("Show").reads("a", "Filter")}),
      "A.a");
}

TEST_F(Wiring, NearestEarlierEnabledRow) {
  EXPECT_EQ(source({make("A"), make("B"), "Show"}), "B.a");
  EXPECT_EQ(source({make("A"), make("B").off(), "Show"}), "A.a");
  EXPECT_EQ(source({make("A"), "Update", "Show"}), "Update.a");
  EXPECT_EQ(source({make("A"), "Filter", FakeRow("Filter").named("Again"), "Show"}), "Again.a");
}

TEST_F(Wiring, AnOptionalUpdateMakesTheValueWhereThereIsNone) {
  EXPECT_EQ(source({make("A"), "Start", "Show"}), "Start.a");
  EXPECT_EQ(updated({make("A"), "Start", "Show"}), "A.a");
  EXPECT_EQ(updated({"Start", "Show"}), "-");
  EXPECT_EQ(updated({FakeRow("White").off(), "Start", "Show"}), "fill White.a");
  EXPECT_EQ(source({"Start", "Update", "Show"}), "Update.a");
  // Disabled, it repeats what it would update; else its own stand-in counts.
  EXPECT_EQ(source({make("A"), FakeRow("Start").off(), "Show"}), "A.a");
  EXPECT_EQ(source({FakeRow("Start").off(), "Show"}), "fill Start.a");
}

// Else a row in the wrong place would begin a new picture, and the one so far were lost.
TEST_F(Wiring, AnOptionalUpdateOfAnotherFormatIsAFault) {
  EXPECT_THAT(updated({"Float", "Start", "Show"}),
              testing::AllOf(testing::HasSubstr("pass 'Start', input 'a' [FormatMismatch]"),
                             testing::HasSubstr("found:  'Float.a', a 2D texture (R32Float)")));
}

TEST_F(Wiring, DisabledRowThatPassesThrough) {
  EXPECT_EQ(source({make("A"), FakeRow("Filter").off(), "Show"}), "A.a");
  EXPECT_EQ(source({make("A"), FakeRow("Update").off(), "Show"}), "A.a");
  EXPECT_EQ(source({FakeRow("White").off(), FakeRow("Filter").off(), "Show"}), "fill White.a");
}

TEST_F(Wiring, DisabledRowThatFills) {
  EXPECT_EQ(source({FakeRow("White").off(), "Show"}), "fill White.a");
  EXPECT_EQ(source({FakeRow("White").off(), FakeRow("Bare").off(), "Show"}), "fill White.a");
  EXPECT_EQ(source({FakeRow("White").off(), "Update", "Show"}), "Update.a");
}

TEST_F(Wiring, Resource) {
  EXPECT_EQ(source({"Draw"}), "resource scene");
}

TEST_F(Wiring, ResourceNamedByReads) {
  add(registry_,
      FakePass("Draw2").data<Scene>("world", Direction::In).out("color", Format::Rgba8Unorm));
  EXPECT_EQ(source({FakeRow("Draw2").reads("world", "scene")}), "resource scene");
}

TEST_F(Wiring, OptionalStaysUnbound) {
  EXPECT_EQ(source({"ShowIfAny"}), "-");
  EXPECT_EQ(source({FakeRow("Bare").off(), "ShowIfAny"}), "-");
}

TEST_F(Wiring, HistoryReadsAnyRow) {
  EXPECT_EQ(source({"Past"}), "-");
  EXPECT_EQ(source({make("A"), "Past"}), "A.a");
  const Pipeline pipeline =
      pipelineOf({FakeRow("Past").reads("a", "Later"), make("Later")}, "Past.color");
  const Validation result = validate(pipeline, registry_, gpu::Capabilities::baseline());
  ASSERT_TRUE(result.ok()) << result.text();
  EXPECT_EQ(result.plan->rows[0].inputs[0].source.row, 1u);
  EXPECT_FALSE(result.plan->rows[1].culled) << "a history reader needs its source";
}

TEST_F(Wiring, OutputIsTheLastColorUnlessNamed) {
  const auto output = [&](std::string name) {
    const Pipeline pipeline = pipelineOf({make("A"), "Show", FakeRow("Show").named("Last")}, name);
    return validate(pipeline, registry_, gpu::Capabilities::baseline()).plan->output.row;
  };
  EXPECT_EQ(output(""), 2u);
  EXPECT_EQ(output("Show"), 1u);
  EXPECT_EQ(output("A.a"), 0u);
}

TEST_F(Wiring, RowsAfterRowsOnlyMoveWhatTheyTouch) {
  // Any row may be moved, doubled or switched off without naming anything else.
  EXPECT_EQ(source({make("A"), "Filter", "Update", FakeRow("Filter").named("F2"), "Show"}), "F2.a");
  EXPECT_EQ(source({make("A"), "Update", "Filter", FakeRow("Filter").named("F2").off(), "Show"}),
            "Filter.a");
}

}  // namespace
}  // namespace lucerna::graph
