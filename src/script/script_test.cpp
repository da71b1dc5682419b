#include "script/script.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>

#include "script/load_pipeline.hpp"

namespace lucerna::script {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string failureOf(const std::string& source, const ScriptInput& input = {}) {
  const auto result = runPipelineSource(source, "test.js", input);
  if (result) return "it succeeded";
  EXPECT_EQ(result.error().kind, ErrorKind::Pipeline);
  return result.error().message;
}

TEST(Script, MakesRowsWithPlacesReadsAndParams) {
  const auto pipeline = runPipelineSource(
      "const g = pass('GBuffer');\n"
      "\n"
      "const l = pass('TiledLighting', {name: 'Light', enabled: false, reads: {depth: g.depth, "
      "normal: "
      "g},\n"
      "                            params: {a: 1}, b: [0.5, 2], c: 'x', d: true});\n"
      "pipeline({name: 'mine', output: l.color});\n",
      "test.js");
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  EXPECT_EQ(pipeline->name, "mine");
  EXPECT_EQ(pipeline->output, "Light.color");
  ASSERT_EQ(pipeline->passes.size(), 2u);
  EXPECT_EQ(pipeline->passes[0].place, "test.js:1");
  const graph::PassRow& row = pipeline->passes[1];
  EXPECT_EQ(row.place, "test.js:3");
  EXPECT_EQ(row.name, "Light");
  EXPECT_EQ(row.type, "TiledLighting");
  EXPECT_FALSE(row.enabled);
  EXPECT_EQ(row.reads.at("depth"), "GBuffer.depth");
  EXPECT_EQ(row.reads.at("normal"), "GBuffer");
  EXPECT_EQ(graph::toText(row.params.at("a")), "1");
  EXPECT_EQ(std::get<std::vector<double>>(row.params.at("b")), (std::vector<double>{0.5, 2}));
  EXPECT_EQ(std::get<std::string>(row.params.at("c")), "x");
  EXPECT_TRUE(std::get<bool>(row.params.at("d")));
}

TEST(Script, PlaceIsTheLineOfTheCallInALoopAndInAFunction) {
  const auto pipeline = runPipelineSource(
      "function add(i) {\n  pass('Cull', {name: 'Cull' + i});\n}\nfor (let i = 0; i < 2; ++i) "
      "add(i);",
      "folder/my file.js");
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  EXPECT_EQ(pipeline->passes[1].place, "folder/my file.js:2");
}

TEST(Script, FaultsCarryFileAndLine) {
  EXPECT_THAT(failureOf("pass('A'\n\n;"), StartsWith("test.js:3: SyntaxError"));
  EXPECT_THAT(failureOf("\nnope()"), StartsWith("test.js:2: ReferenceError"));
  EXPECT_THAT(failureOf("\n\nthrow new Error('stop')"), StartsWith("test.js:3: Error: stop"));
  EXPECT_THAT(failureOf("throw 'bare'"), HasSubstr("bare"));
  EXPECT_THAT(failureOf("\npass(3)"), StartsWith("test.js:2: TypeError: the type of pass()"));
  EXPECT_THAT(failureOf("import x from 'y'"), StartsWith("test.js:1: SyntaxError"));
  EXPECT_THAT(failureOf("pipeline({nam: 'x'})"), HasSubstr("'nam'"));
}

TEST(Script, RefusesNumbersThatJsonWouldLose) {
  EXPECT_THAT(failureOf("\npass('Ao', {radius: 0 / 0})"),
              StartsWith("test.js:2: RangeError: parameter 'radius' of 'Ao' is NaN"));
  EXPECT_THAT(failureOf("pass('Ao', {color: [1, 1 / 0, 0]})"), HasSubstr("[1] is Infinity"));
  EXPECT_THAT(failureOf("pass('Ao', {radius: null})"), HasSubstr("is null"));
}

TEST(Script, ParametersCanBeOverridden) {
  const std::string source =
      "const n = param('count', 2, {min: 1, max: 4});\n"
      "for (let i = 0; i < n; ++i) pass('Cull', {name: 'C' + i});";
  EXPECT_EQ(runPipelineSource(source, "test.js")->passes.size(), 2u);
  EXPECT_EQ(runPipelineSource(source, "test.js", {.params = {{"count", "4"}}})->passes.size(), 4u);
  EXPECT_THAT(failureOf(source, {.params = {{"count", "9"}}}), HasSubstr("from 1 to 4"));
  EXPECT_THAT(failureOf(source, {.params = {{"count", "many"}}}), HasSubstr("a number is wanted"));
  const auto unknown = runPipelineSource(source, "test.js", {.params = {{"cout", "3"}}});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
  EXPECT_THAT(unknown.error().message, HasSubstr("did you mean 'count'"));
}

TEST(Script, ParametersThatContradictThemselvesAreRefused) {
  EXPECT_THAT(failureOf("\nparam('a', 5, {min: 1, max: 3})"),
              StartsWith("test.js:2: RangeError: the default of param(\"a\") is 5"));
  EXPECT_THAT(failureOf("param('a', 1);\nparam('a', 2)"), HasSubstr("is called twice"));
}

TEST(Script, TheSameSeedGivesTheSamePipelineAndThereIsNoClock) {
  const std::string source = "pass('Cull', {a: Math.random(), b: Math.random()});";
  const auto json = [&](std::uint64_t seed) {
    return graph::toJson(*runPipelineSource(source, "test.js", {.params = {}, .seed = seed}));
  };
  EXPECT_EQ(json(1), json(1));
  EXPECT_NE(json(1), json(2));
  for (const char* clock : {"Date.now()", "new Date()", "Intl", "performance.now()"})
    EXPECT_THAT(failureOf(clock), HasSubstr("has no clock")) << clock;
}

TEST(Script, AnEndlessLoopIsKilledInTime) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THAT(failureOf("for (;;) {}"), HasSubstr("a script may take 5 s"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
}

TEST(Script, AMemoryBombIsKilled) {
  EXPECT_THAT(failureOf("const all = []; for (;;) all.push(new Float64Array(1 << 20).fill(1));"),
              HasSubstr("512 MiB"));
}

TEST(Script, HugeOutputIsAnError) {
  EXPECT_THAT(failureOf("const s = 'x'.repeat(1 << 20);\n"
                        "for (let i = 0; i < 64; ++i) pass('Cull', {name: 'n' + i, text: s});"),
              HasSubstr("16 MiB of output"));
  const auto rows =
      runPipelineSource("for (let i = 0; i < 5000; ++i) pass('C', {name: 'c' + i});", "test.js");
  ASSERT_TRUE(rows) << rows.error().message;
  ASSERT_EQ(rows->formFaults.size(), 1u);
  EXPECT_THAT(rows->formFaults[0].text(), HasSubstr("5000 rows"));
}

TEST(Script, AScriptThatTampersWithTheEngineGetsAnErrorNotACrash) {
  for (const char* source :
       {"Object.prototype.toJSON = () => 1", "Array.prototype.push = null; pass('A')",
        "Map.prototype.has = 0; param('x', 1)", "globalThis.JSON = null; pass('A')",
        "Array.prototype.toJSON = () => '\\u0000'; pass('A')"}) {
    const auto result = runPipelineSource(source, "test.js");
    if (!result) {
      EXPECT_EQ(result.error().kind, ErrorKind::Pipeline) << source;
    }
  }
}

TEST(Script, AMissingWorkerIsNamedWithTheWayOut) {
  const char* named = std::getenv("LUCERNA_WORKER");
  const std::string before = named ? named : "";
  setenv("LUCERNA_WORKER", "/nowhere/lucerna_worker", 1);
  const auto made = runPipelineSource("pass('Cull')", "a.js", {});
  setenv("LUCERNA_WORKER", before.c_str(), 1);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::Failed);  // the script is not to blame
  EXPECT_THAT(made.error().message,
              AllOf(HasSubstr("/nowhere/lucerna_worker"), HasSubstr("build or install it again")));
}

TEST(LoadPipeline, ShippedOnesLoadAndUnknownNamesAreAnsweredWithThem) {
  ASSERT_FALSE(shippedPipelineNames().empty());
  for (const std::string& name : shippedPipelineNames()) {
    const auto pipeline = loadPipeline(name);
    ASSERT_TRUE(pipeline) << pipeline.error().message;
    EXPECT_EQ(pipeline->name, name);
    EXPECT_FALSE(pipeline->passes.empty());
  }
  const auto unknown = loadPipeline("defered");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::Usage);
  EXPECT_THAT(unknown.error().message, HasSubstr("did you mean 'deferred'"));
  EXPECT_THAT(unknown.error().message, HasSubstr("gbuffer"));
}

TEST(LoadPipeline, MissingFilesAreInputErrors) {
  for (const char* name : {"/nowhere/x.js", "/nowhere/x.json"}) {
    const auto result = loadPipeline(name);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::Input);
    EXPECT_THAT(result.error().message, HasSubstr("/nowhere/x"));
  }
}

}  // namespace
}  // namespace lucerna::script
