// One test per kind of fault, by name. Forbidden graphs are drawn above their tests: rows from top
// to bottom, arrows from a value's maker to its reader.
#include "graph/validate.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "graph/fake_pass.hpp"

namespace lucerna::graph {
namespace {

using gpu::Format;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Lists {
  static constexpr const char* kPortName = "Lists";
};

// Its parameter "b" exists while "a" is 2, its input "in" while "b" is 3.
class Unfolding final : public PassType {
 public:
  PassDescription describe(const ParamValues& values) const override {
    const auto is = [&](const char* name, std::int64_t number) {
      const auto value = values.find(name);
      return value != values.end() && value->second == Value(number);
    };
    FakePass pass("Unfolding");
    const auto number = [](const char* name) {
      return ParamDescription{.name = name,
                              .type = ParamType::Int,
                              .defaultValue = std::int64_t{0},
                              .min = 0,
                              .max = 9};
    };
    pass.param(number("a"));
    if (is("a", 2)) pass.param(number("b"));
    if (is("b", 3)) pass.in("in");
    pass.out("color", Format::Rgba8Unorm);
    PassDescription description = pass.describe({});
    if (is("a", 7)) description.faults.push_back({"a", "seven", "another number", "change it"});
    return description;
  }
  std::unique_ptr<PassInstance> create(gpu::Device&) const override {
    return std::make_unique<FakeInstance>();
  }
};

class Validate : public testing::Test {
 protected:
  Validate() {
    add(registry_,
        FakePass("GBuffer").out("depth", Format::Depth32F).out("normal", Format::Rg16Unorm));
    add(registry_, FakePass("Ao")
                       .in("depth", Format::Depth32F)
                       .out("mask", Format::R8Unorm)
                       .fill(1)
                       .param({.name = "radius", .defaultValue = 0.5, .min = 0.1, .max = 10})
                       .param({.name = "mode",
                               .type = ParamType::Choice,
                               .defaultValue = "Fast",
                               .choices = {"Fast", "Nice"}}));
    add(registry_,
        FakePass("Light").in("normal").in("mask").optional().out("color", Format::Rgba16Float));
    add(registry_, FakePass("Fog").inout("color", Format::Rgba16Float));
    add(registry_, FakePass("Blur")
                       .in("color", Format::Rgba16Float)
                       .out("color", Format::Rgba16Float)
                       .repeats("color"));
    add(registry_,
        FakePass("Tone").in("color", Format::Rgba16Float).out("color", Format::Rgba8Unorm));
    add(registry_,
        FakePass("Taa").in("color").in("past").history().out("color", Format::Rgba16Float));
    registry_.add(std::make_unique<Unfolding>());
    add(registry_, FakePass("MakeLists").data<Lists>("lists", Direction::Out));
    add(registry_, FakePass("SortLists").data<Lists>("lists", Direction::InOut));
    add(registry_, FakePass("DrawLists")
                       .data<Lists>("lists", Direction::In)
                       .out("color", Format::Rgba16Float));
  }

  Validation check(std::vector<FakeRow> rows, std::string output = "",
                   const std::vector<std::string>& kept = {}) {
    return validate(pipelineOf(std::move(rows), std::move(output)), registry_, capabilities_, kept);
  }

  // The only fault.
  Fault only(const Validation& result, FaultKind kind, Severity severity = Severity::Error) {
    EXPECT_EQ(result.faults.size(), 1u) << result.text();
    if (result.faults.size() != 1) return {};
    EXPECT_EQ(result.faults[0].kind, kind) << result.text();
    EXPECT_EQ(result.faults[0].severity, severity);
    EXPECT_EQ(result.ok(), severity == Severity::Warning);
    for (const std::string* part : {&result.faults[0].place, &result.faults[0].found,
                                    &result.faults[0].wanted, &result.faults[0].remedy})
      EXPECT_THAT(*part, testing::Not(IsEmpty())) << result.text();
    return result.faults[0];
  }

  Registry registry_;
  gpu::Capabilities capabilities_ = gpu::Capabilities::baseline();
};

TEST_F(Validate, SoundPipelineHasNoFault) {
  const Validation result = check({"GBuffer", "Ao", "Light", "Fog", "Blur", "Tone"});
  EXPECT_THAT(result.text(), IsEmpty());
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.plan->output.row, 5u);
}

TEST_F(Validate, UnknownPass) {
  const Fault fault = only(check({"GBufer", "Light", "Tone"}), FaultKind::UnknownPass);
  EXPECT_THAT(fault.place, HasSubstr("row 1, pass 'GBufer'"));
  EXPECT_THAT(fault.remedy, HasSubstr("did you mean 'GBuffer'"));
  EXPECT_THAT(only(check({"GBuffer", "Light", "Zzz"}), FaultKind::UnknownPass).remedy,
              HasSubstr("GBuffer, Ao, Light"));
}

TEST_F(Validate, UnknownPort) {
  const Fault reader = only(check({"GBuffer", FakeRow("Light").reads("nromal", "GBuffer.normal")}),
                            FaultKind::UnknownPort);
  EXPECT_THAT(reader.place, HasSubstr("reads 'nromal'"));
  EXPECT_THAT(reader.remedy, HasSubstr("did you mean 'normal'"));
  const Fault port = only(check({"GBuffer", FakeRow("Light").reads("normal", "GBuffer.nrmal")}),
                          FaultKind::UnknownPort);
  EXPECT_THAT(port.remedy, HasSubstr("did you mean 'GBuffer.normal'"));
  const Fault row = only(check({"GBuffer", FakeRow("Light").reads("normal", "GBufer.normal")}),
                         FaultKind::UnknownPort);
  EXPECT_THAT(row.remedy, HasSubstr("did you mean 'GBuffer'"));
}

TEST_F(Validate, UnknownParameter) {
  const Fault fault = only(check({"GBuffer", FakeRow("Ao").with("raduis", 1.0), "Light"}),
                           FaultKind::UnknownParameter);
  EXPECT_THAT(fault.place, HasSubstr("parameter 'raduis'"));
  EXPECT_THAT(fault.remedy, HasSubstr("did you mean 'radius'"));
}

//    Light <- normal ?
TEST_F(Validate, MissingInput) {
  const Fault fault = only(check({"Light"}), FaultKind::MissingInput);
  EXPECT_THAT(fault.place, HasSubstr("pass 'Light', input 'normal'"));
  EXPECT_THAT(fault.remedy, HasSubstr("GBuffer"));
}

//    Light <---+ normal
//    GBuffer --+
TEST_F(Validate, MissingInputThatALaterPassMakes) {
  const Validation result = check({"Light", "GBuffer"});
  ASSERT_FALSE(result.faults.empty());
  EXPECT_EQ(result.faults[0].kind, FaultKind::MissingInput);
  EXPECT_THAT(result.faults[0].remedy, HasSubstr("move 'GBuffer' before 'Light'"));
}

//    GBuffer -- normal --> DrawLists.lists
TEST_F(Validate, TypeMismatch) {
  const Fault fault =
      only(check({"GBuffer", FakeRow("DrawLists").reads("lists", "GBuffer.normal")}),
           FaultKind::TypeMismatch);
  EXPECT_THAT(fault.found, AllOf(HasSubstr("GBuffer.normal"), HasSubstr("a 2D texture")));
  EXPECT_THAT(fault.wanted, HasSubstr("Lists data"));
}

TEST_F(Validate, TypeMismatchOfTextureKinds) {
  add(registry_, FakePass("Array")
                     .out("color", Format::Rgba16Float)
                     .spec({gpu::TextureKind::Array2D, {Format::Rgba16Float}, 4}));
  const Fault fault = only(check({"Array", "Tone"}), FaultKind::TypeMismatch);
  EXPECT_THAT(fault.found, HasSubstr("4 layers"));
}

//    Light -> Tone (makes Rgba8Unorm) -> Fog (wants Rgba16Float)
TEST_F(Validate, FormatMismatch) {
  const Fault fault = only(check({"GBuffer", "Light", "Tone", "Fog"}), FaultKind::FormatMismatch);
  EXPECT_THAT(fault.found, HasSubstr("Rgba8Unorm"));
  EXPECT_THAT(fault.wanted, HasSubstr("Rgba16Float"));
}

//    Light -> Half -> Over      (color: half the output's size)
//    GBuffer ----------^        (depth: the output's)
TEST_F(Validate, SizeMismatch) {
  add(registry_, FakePass("Half")
                     .in("color")
                     .out("color", Format::Rgba16Float)
                     .sizeOf("color", 0.5f)
                     .repeats("color"));
  add(registry_,
      FakePass("HalfDepth").in("depth").out("depth", Format::Depth32F).sizeOf("depth", 0.5f));
  add(registry_, FakePass("Over")
                     .in("depth", Format::Depth32F)
                     .inout("color", Format::Rgba16Float)
                     .sameSizeAs("depth"));
  const Fault fault =
      only(check({"GBuffer", "Light", "Half", "Over", "Tone"}), FaultKind::SizeMismatch);
  EXPECT_THAT(fault.place, HasSubstr("'Over', input 'color'"));
  EXPECT_THAT(fault.found, HasSubstr("'Half.color', of 0.5 x the output's size"));
  EXPECT_THAT(fault.wanted, HasSubstr("'GBuffer.depth': the output's size"));
  EXPECT_TRUE(check({"GBuffer", "Light", "Half", "HalfDepth", "Over", "Tone"}).ok());
  EXPECT_TRUE(check({"GBuffer", "Light", FakeRow("Half").off(), "Over", "Tone"}).ok());
}

//    Ao <------+ depth, named by `reads`
//    GBuffer --+
TEST_F(Validate, ReadBeforeWrite) {
  const Fault fault =
      only(check({FakeRow("Ao").reads("depth", "GBuffer.depth"), "GBuffer", "Light"}),
           FaultKind::ReadBeforeWrite);
  EXPECT_THAT(fault.remedy, HasSubstr("move 'GBuffer' before 'Ao'"));
}

//    MakeLists -> SortLists -> Draw1
//        |        (in place)
//        +------------> Draw2
TEST_F(Validate, ReadAfterUpdate) {
  add(registry_, FakePass("Sink").in("color"));
  const Fault fault =
      only(check({"MakeLists", "SortLists", FakeRow("DrawLists").named("Draw1"), "Sink",
                  FakeRow("DrawLists").named("Draw2").reads("lists", "MakeLists")}),
           FaultKind::ReadAfterUpdate);
  EXPECT_THAT(fault.place, HasSubstr("'Draw2'"));
  EXPECT_THAT(fault.found, HasSubstr("'SortLists' updates"));
}

TEST_F(Validate, AnUpdateThatIsLeftOutDisturbsNobody) {
  only(check({"MakeLists", "SortLists", FakeRow("DrawLists").reads("lists", "MakeLists")}),
       FaultKind::OutputNeverRead, Severity::Warning);
}

//    MakeLists (per scene) -> SortLists (per view) -> DrawLists
TEST_F(Validate, WrongFrequencyOfAnUpdate) {
  add(registry_,
      FakePass("MakeOnce").runs(Frequency::PerScene).data<Lists>("lists", Direction::Out));
  EXPECT_THAT(only(check({"MakeOnce", "SortLists", "DrawLists"}), FaultKind::WrongFrequency).found,
              HasSubstr("made per scene only"));
}

//    A -> B -> C -+
//    ^            |
//    +------------+
TEST_F(Validate, Cycle) {
  const Fault fault = only(check({FakeRow("Blur").named("A").reads("color", "C.color"),
                                  FakeRow("Blur").named("B"), FakeRow("Blur").named("C")}),
                           FaultKind::Cycle);
  EXPECT_THAT(fault.found, HasSubstr("A reads C, which reads B, which reads A"));
}

TEST_F(Validate, CycleOfOneRow) {
  only(check({FakeRow("Blur").reads("color", "Blur")}), FaultKind::Cycle);
}

//    A (off) <-> B (off) -> Tone
TEST_F(Validate, CycleOfDisabledRowsEnds) {
  const Validation result = check({FakeRow("Blur").named("A").reads("color", "B").off(),
                                   FakeRow("Blur").named("B").reads("color", "A").off(), "Tone"});
  only(result, FaultKind::DisabledWithoutStandIn);
}

TEST_F(Validate, DuplicateName) {
  const Fault fault = only(check({"GBuffer", "Light", "Blur", "Blur"}), FaultKind::DuplicateName);
  EXPECT_THAT(fault.found, HasSubstr("row 3, pass 'Blur' has too"));
}

TEST_F(Validate, ValueOutOfRange) {
  for (const double value : {0.0, 10.5, std::nan(""), HUGE_VAL, 1e300}) {
    const Fault fault = only(check({"GBuffer", FakeRow("Ao").with("radius", value), "Light"}),
                             FaultKind::ValueOutOfRange);
    EXPECT_THAT(fault.wanted, HasSubstr("from 0.1 to 10"));
  }
  const Fault choice = only(check({"GBuffer", FakeRow("Ao").with("mode", "Fsat"), "Light"}),
                            FaultKind::ValueOutOfRange);
  EXPECT_THAT(choice.remedy, HasSubstr("did you mean 'Fast'"));
}

TEST_F(Validate, WrongValueType) {
  const Fault fault = only(check({"GBuffer", FakeRow("Ao").with("radius", "big"), "Light"}),
                           FaultKind::WrongValueType);
  EXPECT_THAT(fault.found, HasSubstr("'big' (a text)"));
  const std::int64_t integer = 2;
  EXPECT_TRUE(check({"GBuffer", FakeRow("Ao").with("radius", integer), "Light"}).ok());
}

//    GBuffer -> Light -> Tone -> (output)
//        |
//        +-> Ao -> nobody                      Light does not read it here
TEST_F(Validate, ParametersAndPortsThatExistForSomeValuesOnly) {
  const auto row = [](std::int64_t a, std::int64_t b) {
    return FakeRow("Unfolding").with("a", a).with("b", b);
  };
  EXPECT_THAT(only(check({row(1, 3)}), FaultKind::UnknownParameter).place, HasSubstr("'b'"));
  EXPECT_THAT(only(check({row(2, 10)}), FaultKind::ValueOutOfRange).place, HasSubstr("'b'"));
  EXPECT_THAT(only(check({row(2, 3)}), FaultKind::MissingInput).place, HasSubstr("input 'in'"));
  EXPECT_THAT(check({"GBuffer", row(2, 3).reads("in", "GBuffer.normal")}).text(), IsEmpty());
}

// Faults that follow from it are not reported: what the row sets and reads may be right.
TEST_F(Validate, UnusableValue) {
  const Fault fault = only(check({"GBuffer", FakeRow("Unfolding")
                                                 .with("a", std::int64_t{7})
                                                 .with("c", 1.0)
                                                 .reads("in", "GBuffer.normal")}),
                           FaultKind::UnusableValue);
  EXPECT_THAT(fault.place, HasSubstr("row 2, pass 'Unfolding', parameter 'a'"));
  EXPECT_EQ(fault.found, "seven");
}

TEST_F(Validate, OutputNeverRead) {
  const Validation result = check({"GBuffer", "Ao", "Light", FakeRow("Ao").named("Ao2"), "Tone"});
  const Fault fault = only(result, FaultKind::OutputNeverRead, Severity::Warning);
  EXPECT_THAT(fault.place, HasSubstr("'Ao2'"));
  EXPECT_TRUE(result.plan->rows[3].culled);
  EXPECT_FALSE(result.plan->rows[0].culled);
}

TEST_F(Validate, KeptValuesAreRead) {
  const Validation result =
      check({"GBuffer", "Ao", "Light", FakeRow("Ao").named("Ao2"), "Tone"}, "", {"Ao2.mask"});
  EXPECT_THAT(result.text(), IsEmpty());
  EXPECT_FALSE(result.plan->rows[3].culled);
}

//    GBuffer (off) -> Light
TEST_F(Validate, DisabledWithoutStandIn) {
  const Fault fault =
      only(check({FakeRow("GBuffer").off(), "Light"}), FaultKind::DisabledWithoutStandIn);
  EXPECT_THAT(fault.remedy, HasSubstr("enable 'GBuffer'"));
  only(check({"GBuffer", FakeRow("GBuffer").named("Off").off(),
              FakeRow("Light").reads("normal", "Off.normal")}),
       FaultKind::DisabledWithoutStandIn);
}

//    Ao1 -- mask --+     Ao2, nearer but off, would stand for white
//    Ao2 (off)     |
//    Light <-------+
TEST_F(Validate, ProducerChanged) {
  const Validation result =
      check({"GBuffer", FakeRow("Ao").named("Ao1"), FakeRow("Ao").named("Ao2").off(), "Light"});
  const Fault fault = only(result, FaultKind::ProducerChanged, Severity::Warning);
  EXPECT_THAT(fault.found, AllOf(HasSubstr("Ao1.mask"), HasSubstr("'Ao2'")));
  EXPECT_THAT(fault.wanted, HasSubstr("the constant (1, 1, 1, 1)"));
}

TEST_F(Validate, MadeLater) {
  const std::string text = check({"GBuffer", "Light", "Ao"}, "Light").text();
  EXPECT_THAT(text,
              AllOf(HasSubstr("MadeLater"), HasSubstr("only a later pass, 'Ao', makes 'mask'"),
                    HasSubstr("move 'Ao' before 'Light'")));
}

TEST_F(Validate, NoWarningWhenTheStandInIsTheProducer) {
  EXPECT_THAT(
      check({"GBuffer", "Light", FakeRow("Blur").off(), FakeRow("Fog").off(), "Tone"}).text(),
      IsEmpty());
}

TEST_F(Validate, MissingFeature) {
  add(registry_, FakePass("Rays").needs("ray-query").out("color", Format::Rgba16Float));
  const Fault fault = only(check({"Rays"}), FaultKind::MissingFeature);
  EXPECT_THAT(fault.wanted, HasSubstr("ray-query"));
  capabilities_.features.insert("ray-query");
  EXPECT_TRUE(check({"Rays"}).ok());
  capabilities_.maxColorTargets = 0;
  only(check({"Rays"}), FaultKind::MissingFeature);
}

TEST_F(Validate, UnsupportedFormat) {
  capabilities_.renderable.erase(Format::Rgba16Float);
  const Fault fault = only(check({"GBuffer", "Light", FakeRow("Tone").off()}, "Light"),
                           FaultKind::UnsupportedFormat);
  EXPECT_THAT(fault.place, HasSubstr("output 'color'"));
  EXPECT_THAT(fault.wanted, HasSubstr("Rgba16Float"));
}

TEST_F(Validate, UnsupportedSize) {
  add(registry_, FakePass("Big").out("color", Format::Rgba16Float).size(20000, 10));
  EXPECT_THAT(only(check({"Big"}), FaultKind::UnsupportedFormat).wanted, HasSubstr("20000 x 10"));
}

TEST_F(Validate, BadOutput) {
  EXPECT_THAT(only(check({"GBuffer", "Light"}, "Lihgt.color"), FaultKind::BadOutput).remedy,
              HasSubstr("did you mean 'Light'"));
  EXPECT_THAT(only(check({"GBuffer", "Light"}, "Light.colour"), FaultKind::BadOutput).remedy,
              HasSubstr("did you mean 'Light.color'"));
  only(check({"GBuffer"}), FaultKind::BadOutput);
  only(check({"MakeLists"}, "MakeLists.lists"), FaultKind::BadOutput);
  only(check({"GBuffer", "Light"}, "", {"Ligth.color"}), FaultKind::BadOutput);
}

TEST_F(Validate, EmptyPipeline) {
  EXPECT_THAT(only(check({}), FaultKind::EmptyPipeline).found, HasSubstr("no passes"));
  EXPECT_THAT(only(check({FakeRow("GBuffer").off()}), FaultKind::EmptyPipeline).found,
              HasSubstr("only disabled"));
}

//    GBuffer (per view) -- depth --> Probe (per scene)
TEST_F(Validate, WrongFrequency) {
  add(registry_,
      FakePass("Probe").runs(Frequency::PerScene).in("depth").out("color", Format::Rgba16Float));
  const Fault fault = only(check({"GBuffer", "Probe"}), FaultKind::WrongFrequency);
  EXPECT_THAT(fault.found, HasSubstr("made per view"));
  EXPECT_THAT(fault.wanted, HasSubstr("per scene"));
}

TEST_F(Validate, WrongFrequencyOfResources) {
  registry_.addResource<Lists>("lists", "", true);
  add(registry_, FakePass("Once")
                     .runs(Frequency::PerScene)
                     .data<Lists>("lists", Direction::In)
                     .out("color", Format::Rgba16Float));
  only(check({"Once"}), FaultKind::WrongFrequency);
}

TEST_F(Validate, PassesMayNotChangeResources) {
  registry_.addResource<Lists>("lists", "");
  EXPECT_THAT(only(check({"SortLists", "DrawLists"}), FaultKind::TypeMismatch).found,
              HasSubstr("the resource 'lists'"));
}

TEST_F(Validate, EveryFaultAtOnceInTheOrderOfTheRows) {
  const Validation result =
      check({"GBufer", FakeRow("Ao").with("radius", -1.0).with("x", 1.0),
             FakeRow("Light").reads("normal", "Nobody"), FakeRow("Ao"), "Tone"},
            "Tone.x");
  std::vector<FaultKind> kinds;
  for (const Fault& fault : result.faults)
    if (fault.severity == Severity::Error) kinds.push_back(fault.kind);
  EXPECT_THAT(kinds, ElementsAre(FaultKind::UnknownPass, FaultKind::ValueOutOfRange,
                                 FaultKind::UnknownParameter, FaultKind::UnknownPort,
                                 FaultKind::DuplicateName, FaultKind::BadOutput));
  EXPECT_THAT(result.text(), AllOf(HasSubstr("error: row 2, pass 'Ao', parameter 'radius'"),
                                   HasSubstr("found:"), HasSubstr("to do:")));
}

TEST_F(Validate, FaultsAreTheSameEveryTime) {
  const auto once = [&] {
    return check({"Light", FakeRow("Blur").reads("color", "Tone"), "Zzz", "Tone", "Fog"}).text();
  };
  EXPECT_EQ(once(), once());
}

TEST_F(Validate, RowsKeepTheirPlace) {
  Pipeline pipeline = pipelineOf({"Light"});
  pipeline.passes[0].place = "a.js:12";
  const Validation result = validate(pipeline, registry_, capabilities_);
  EXPECT_EQ(result.faults[0].place, "a.js:12, pass 'Light', input 'normal'");
}

}  // namespace
}  // namespace lucerna::graph
