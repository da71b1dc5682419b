// The JSON form and --set.
#include "graph/pipeline.hpp"

#include <gmock/gmock.h>

#include "graph/fake_pass.hpp"
#include "graph/validate.hpp"

namespace lucerna::graph {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// All faults of form, or why there is nothing to read.
std::string faultsOf(const std::string& text) {
  const auto result = pipelineFromJson(text, "bad.json");
  if (!result) {
    EXPECT_EQ(result.error().kind, ErrorKind::Pipeline);
    return result.error().message;
  }
  EXPECT_FALSE(result->formFaults.empty()) << text;
  std::string faults;
  for (const Fault& fault : result->formFaults) {
    EXPECT_EQ(fault.kind, FaultKind::BadForm);
    faults += fault.text() + "\n";
  }
  return faults;
}

constexpr const char* kWhole = R"({
  "lucerna": "pipeline/1",
  "name": "whole",
  "output": "Ao.mask",
  "passes": [
    {"type": "GBuffer"},
    {"name": "Ao", "type": "ScreenSpaceAo", "enabled": false,
     "reads": {"depth": "GBuffer.depth"},
     "params": {"b": true, "i": -3, "f": 0.1, "f2": 4.0, "t": "x", "v": [1, 2.5]}}
  ]
})";

TEST(PipelineJson, ReadsEveryKey) {
  const auto pipeline = pipelineFromJson(kWhole, "whole.json");
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  EXPECT_EQ(pipeline->name, "whole");
  EXPECT_EQ(pipeline->output, "Ao.mask");
  ASSERT_EQ(pipeline->passes.size(), 2u);
  EXPECT_EQ(pipeline->passes[0].name, "GBuffer");
  EXPECT_TRUE(pipeline->passes[0].enabled);
  EXPECT_EQ(pipeline->passes[0].place, "whole.json:6");
  const PassRow& ao = pipeline->passes[1];
  EXPECT_EQ(ao.type, "ScreenSpaceAo");
  EXPECT_FALSE(ao.enabled);
  EXPECT_EQ(ao.reads.at("depth"), "GBuffer.depth");
  EXPECT_EQ(ao.params.at("b"), Value(true));
  EXPECT_EQ(ao.params.at("i"), Value(std::int64_t{-3}));
  EXPECT_EQ(ao.params.at("f"), Value(0.1));
  EXPECT_EQ(ao.params.at("f2"), Value(4.0));
  EXPECT_EQ(ao.params.at("t"), Value(std::string("x")));
  EXPECT_EQ(ao.params.at("v"), Value(std::vector{1.0, 2.5}));
}

TEST(PipelineJson, ComesBackTheSame) {
  const auto first = pipelineFromJson(kWhole, "whole.json");
  const std::string text = toJson(*first);
  const auto second = pipelineFromJson(text, "again.json");
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ(toJson(*second), text);
  EXPECT_EQ(second->passes[1].params, first->passes[1].params);
  EXPECT_EQ(second->passes[1].reads, first->passes[1].reads);
  EXPECT_EQ(second->output, first->output);
}

TEST(PipelineJson, ARowMayCarryItsPlace) {
  const auto pipeline = pipelineFromJson(
      R"({"lucerna":"pipeline/1","passes":[{"type":"A","place":"a.js:7"}]})", "a.js");
  EXPECT_EQ(pipeline->passes[0].place, "a.js:7");
}

TEST(PipelineJson, EveryFaultOfFormAtOnce) {
  const std::string faults = faultsOf(R"({"lucerna": "pipeline/2", "nmae": "x", "output": 3,
  "passes": [
    {"typ": "A"},
    {"type": "A", "name": "a.b", "enabled": "no"},
    7,
    {"type": "A", "reads": {"x": 1}, "params": {"p": null, "q": [[1]]}},
    {"type": "A", "type": "B", "reads": [], "params": 1},
    {"name": "none"}
  ]})");
  EXPECT_THAT(
      faults,
      AllOf(HasSubstr("pipeline/2"), HasSubstr("did you mean 'name'"),
            HasSubstr("bad.json:1: /output [BadForm]\n  found:  3\n  wanted: a text"),
            HasSubstr("bad.json:3: /passes/0/typ [BadForm]\n  found:  the unknown key 'typ' "
                      "(did you mean 'type'?)"),
            HasSubstr("'a.b'"), HasSubstr("/passes/1/enabled [BadForm]\n  found:  \"no\""),
            HasSubstr("bad.json:5: /passes/2 [BadForm]\n  found:  7\n  wanted: an object")));
  EXPECT_THAT(faults,
              AllOf(HasSubstr("/passes/3/reads/x [BadForm]\n  found:  1"), HasSubstr("NaN"),
                    HasSubstr("/passes/3/params/q [BadForm]\n  found:  [[1]]"),
                    HasSubstr("bad.json:7 [BadForm]\n  found:  the key \"type\" stands twice"),
                    HasSubstr("/passes/4/reads [BadForm]\n  found:  []"),
                    HasSubstr("/passes/4/params [BadForm]"),
                    HasSubstr("bad.json:8: /passes/5 [BadForm]\n  found:  no \"type\"")));
}

// What is wrong in form hides nothing, and one slip is one fault.
TEST(PipelineJson, FaultsOfFormStandBesideThoseOfTheWiring) {
  Registry registry;
  add(registry, FakePass("Ao")
                    .param({.name = "radius", .defaultValue = 0.5, .min = 0, .max = 10})
                    .out("color", gpu::Format::Rgba8Unorm));
  const auto pipeline = pipelineFromJson(R"({"lucerna": "pipeline/1", "passes": [
    {"type": "Ao", "colour": 1, "params": {"radius": 11, "soft": null}},
    {"typ": "Ao", "name": "second"},
    {"name": "third"},
    {"type": "Oa"}
  ]})",
                                         "bad.json");
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const Validation validation = validate(*pipeline, registry, gpu::Capabilities::baseline());
  EXPECT_FALSE(validation.ok());
  std::vector<std::string> found;
  for (const Fault& fault : validation.faults)
    if (fault.severity == Severity::Error)
      found.push_back(std::string(nameOf(fault.kind)) + " " + fault.place);
  EXPECT_THAT(found, testing::ElementsAre(
                         "BadForm bad.json:2: /passes/0/colour",
                         "BadForm bad.json:2: /passes/0/params/soft",
                         "BadForm bad.json:3: /passes/1/typ", "BadForm bad.json:4: /passes/2",
                         "ValueOutOfRange bad.json:2, pass 'Ao', parameter 'radius'",
                         "UnknownPass bad.json:5, pass 'Oa'"));
}

TEST(PipelineJson, SyntaxFaultsHaveTheirLine) {
  EXPECT_THAT(faultsOf("{\n\"lucerna\": \"pipeline/1\",\n oops }"), HasSubstr("bad.json:3:"));
  EXPECT_THAT(faultsOf(""), HasSubstr("bad.json: is empty"));
  EXPECT_THAT(faultsOf("[]"), HasSubstr("bad.json:1: found [], wanted an object"));
  EXPECT_THAT(faultsOf("{\"lucerna\": \"pipeline/1\", \"passes\": [{\"type\": \"\xff\"}]}"),
              HasSubstr("bad.json:1:"));
  EXPECT_THAT(faultsOf(R"({"lucerna": "pipeline/1", "passes": [{"params": {"x": 1e999}}]})"),
              HasSubstr("found the number 1e999, wanted at most"));
}

TEST(PipelineJson, DepthAndRowsAreLimited) {
  EXPECT_THAT(faultsOf(std::string(1'000'000, '[')), HasSubstr("found more than 64 lists"));
  std::string rows;
  for (std::size_t i = 0; i <= kMaxPipelineRows; ++i) rows += i ? ",{}" : "{}";
  EXPECT_THAT(faultsOf(R"({"lucerna":"pipeline/1","passes":[)" + rows + "]}"),
              HasSubstr("257 rows"));
}

class Setting : public testing::Test {
 protected:
  Setting() {
    add(registry_, FakePass("Ao")
                       .param({.name = "radius", .defaultValue = 0.5, .min = 0, .max = 10})
                       .param({.name = "samples",
                               .type = ParamType::Int,
                               .defaultValue = std::int64_t{4},
                               .min = 1,
                               .max = 64})
                       .param({.name = "on", .type = ParamType::Bool, .defaultValue = false})
                       .param({.name = "mode",
                               .type = ParamType::Choice,
                               .defaultValue = "Fast",
                               .choices = {"Fast", "Nice"}})
                       .param({.name = "tint",
                               .type = ParamType::Color,
                               .defaultValue = std::vector{1.0, 1.0, 1.0},
                               .size = 3})
                       .in("depth"));
    pipeline_ = pipelineOf({FakeRow("Ao"), FakeRow("Ao").named("Ao2")});
  }
  void set(const std::string& setting) {
    const Status status = applySetting(pipeline_, registry_, setting);
    EXPECT_TRUE(status) << status.error().message;
  }
  std::string fault(const std::string& setting) {
    const std::string before = toJson(pipeline_);
    const Status status = applySetting(pipeline_, registry_, setting);
    EXPECT_FALSE(status) << setting;
    EXPECT_EQ(toJson(pipeline_), before) << "a refused setting changed something";
    if (status) return "";
    EXPECT_EQ(status.error().kind, ErrorKind::Usage);
    return status.error().message;
  }
  Registry registry_;
  Pipeline pipeline_;
};

TEST_F(Setting, IsParsedAsTheDeclaredType) {
  set("Ao.radius=2");
  set("Ao2.samples=64");
  set("Ao.on=true");
  set("Ao.mode=Nice");
  set("Ao.tint=[0, 0.5,1]");
  EXPECT_EQ(pipeline_.passes[0].params.at("radius"), Value(2.0));
  EXPECT_EQ(pipeline_.passes[0].params.at("on"), Value(true));
  EXPECT_EQ(pipeline_.passes[0].params.at("mode"), Value(std::string("Nice")));
  EXPECT_EQ(pipeline_.passes[0].params.at("tint"), Value(std::vector{0.0, 0.5, 1.0}));
  EXPECT_EQ(pipeline_.passes[1].params.at("samples"), Value(std::int64_t{64}));
}

TEST_F(Setting, EnablesAndRewires) {
  set("Ao2.enabled=false");
  set("Ao2.reads.depth=Other.depth");
  EXPECT_FALSE(pipeline_.passes[1].enabled);
  EXPECT_EQ(pipeline_.passes[1].reads.at("depth"), "Other.depth");
  set("Ao2.reads.depth=");
  EXPECT_TRUE(pipeline_.passes[1].reads.empty());
}

TEST_F(Setting, FilesAreRelativeToThePipelinesFileOrOnTheCommandLineToTheWorkingDirectory) {
  add(registry_, FakePass("Lut").param(
                     {.name = "table", .type = ParamType::File, .defaultValue = "built/in.lut"}));
  const auto tables = [&](const std::string& folder, const std::string& path) {
    Pipeline pipeline = pipelineOf({FakeRow("Lut").with("table", path), FakeRow("Lut")});
    pipeline.folder = folder;
    resolveFiles(pipeline, registry_);
    EXPECT_FALSE(pipeline.passes[1].params.contains("table"));
    return std::get<std::string>(pipeline.passes[0].params.at("table"));
  };
  EXPECT_EQ(tables("looks", "a.lut"), "./looks/a.lut");
  EXPECT_EQ(tables(".", "a.lut"), "./a.lut");
  EXPECT_EQ(tables("looks", "../a.lut"), "./a.lut");
  EXPECT_EQ(tables("..", "a.lut"), "../a.lut");
  EXPECT_EQ(tables("/home/looks", "a.lut"), "/home/looks/a.lut");
  EXPECT_EQ(tables("looks", "/a.lut"), "/a.lut");
  EXPECT_EQ(tables("", "built/in.lut"), "built/in.lut") << "of a shipped pipeline";

  pipeline_ = pipelineOf({FakeRow("Lut")});
  pipeline_.folder = "looks";
  set("Lut.table=a.lut");
  EXPECT_EQ(pipeline_.passes[0].params.at("table"), Value(std::string("./a.lut")));
}

TEST_F(Setting, FaultsSayWhatThereIs) {
  EXPECT_THAT(fault("Ao3.radius=1"), AllOf(HasSubstr("'Ao3'"), HasSubstr("did you mean 'Ao")));
  EXPECT_THAT(fault("Ao.raduis=1"), HasSubstr("did you mean 'radius'"));
  EXPECT_THAT(fault("Ao.reads.detph=X"), HasSubstr("did you mean 'depth'"));
  EXPECT_THAT(fault("Ao.radius=11"), HasSubstr("from 0 to 10"));
  EXPECT_THAT(fault("Ao.radius=nan"), HasSubstr("from 0 to 10"));
  EXPECT_THAT(fault("Ao.radius=1m"), HasSubstr("a number"));
  EXPECT_THAT(fault("Ao.samples=1.5"), HasSubstr("an integer"));
  EXPECT_THAT(fault("Ao.samples=99999999999999999999"), HasSubstr("an integer"));
  EXPECT_THAT(fault("Ao.mode=nice"), HasSubstr("did you mean 'Nice'"));
  EXPECT_THAT(fault("Ao.on=maybe"), HasSubstr("true or false"));
  EXPECT_THAT(fault("Ao.enabled=maybe"), HasSubstr("true or false"));
  EXPECT_THAT(fault("Ao.tint=1,2"), HasSubstr("a list of 3 numbers"));
  for (const char* text : {"Ao", "Ao.radius", "=1", ".radius=1", "Ao.=1", "radius=1"})
    EXPECT_THAT(fault(text), HasSubstr("wanted Pass.param=value"));
}

}  // namespace
}  // namespace lucerna::graph
