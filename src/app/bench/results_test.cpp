#include "app/bench/results.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace lucerna::app::bench {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

Results exampleResults() {
  Results results{.suite = "passes", .context = contextOfMachine(), .cameras = 2, .rounds = 3};
  results.context.driver = "llvmpipe";
  Measurement& cull = results.at({"800x600", "Cull", "atrium"});
  for (const double ms : {3.0, 1.0, 2.0}) {
    cull.add(ms, ms / 10);
    cull.count("draws", 4);
  }
  results.at({"800x600", "GBuffer", "atrium"}).add(7, 1);
  results.at({"1600x1200", "Cull", "city"}).add(5, 1);
  return results;
}

TEST(BenchResults, AreFoundByTheirNames) {
  const Results results = exampleResults();
  ASSERT_NE(results.find({"800x600", "Cull", "atrium"}), nullptr);
  EXPECT_EQ(results.find({"800x600", "Cull"}), nullptr);
  EXPECT_THAT(results.parts(0), ElementsAre("800x600", "1600x1200"));
  EXPECT_THAT(results.parts(1, {"800x600"}), ElementsAre("Cull", "GBuffer"));
  EXPECT_THAT(results.times({"800x600"}), ElementsAre(3, 1, 2, 7));
  EXPECT_THAT(results.samples({"800x600"}, "draws"), ElementsAre(4, 4, 4));
  EXPECT_THAT(results.samples({"800x600"}, "primitives"), IsEmpty());
}

TEST(BenchResults, RatiosPairScenesAndSamples) {
  Results results;
  for (const char* scene : {"atrium", "city"})
    for (const char* chain : {"slow", "fast"}) results.at({chain, scene});
  results.at({"slow", "city"}).realMs = {40, 90};
  results.at({"fast", "city"}).realMs = {10, 30};
  results.at({"fast", "atrium"}).realMs = {1};
  results.at({"slow", "atrium"}).realMs = {2};
  results.at({"slow", "elsewhere"}).realMs = {7};
  EXPECT_THAT(results.ratios({"slow"}, {"fast"}), ElementsAre(2, 4, 3));
  EXPECT_THAT(results.ratios({"slow", "city"}, {"fast", "city"}), ElementsAre(4, 3));
  EXPECT_THAT(results.ratios({"slow"}, {"none"}), IsEmpty());
}

TEST(BenchResults, ANoteIsSaidOnce) {
  Results results;
  results.note("Skipped: sponza");
  results.note("Skipped: sponza");
  EXPECT_THAT(results.notes, ElementsAre("Skipped: sponza"));
}

TEST(BenchResults, WhatFailsIsNotedAndTheFirstKindKept) {
  Results results{.suite = "passes"};
  results.fail("broken", {ErrorKind::Input, "broken.gltf: no\ngood"});
  results.fail("Cull", {ErrorKind::Pipeline, "does not fit"});
  EXPECT_THAT(results.notes,
              ElementsAre("Failed: broken: broken.gltf: no good", "Failed: Cull: does not fit"));
  EXPECT_EQ(results.failed, ErrorKind::Input);
}

TEST(BenchResults, TheContextIsThatOfASuiteThatOpenedAScene) {
  Results unread, opened = exampleResults();
  unread.context.version = "other";
  EXPECT_EQ(sharedContext({unread, opened}).driver, "llvmpipe");
  EXPECT_EQ(sharedContext({unread}).version, "other");
  EXPECT_EQ(sharedContext({}).driver, "");
}

// The keys that Google Benchmark's own tools read (tools/gbench/report.py there).
TEST(BenchJson, HasTheShapeOfGoogleBenchmark) {
  const Json document = Json::parse(googleBenchmarkJson({exampleResults()}));
  for (const char* key : {"date", "executable", "num_cpus", "load_avg", "library_build_type",
                          "json_schema_version", "driver", "suites"})
    EXPECT_TRUE(document["context"].contains(key)) << key;
  // Of each measurement a run a sample and five aggregates.
  ASSERT_EQ(document["benchmarks"].size(), 5u + 3 * 5u);
  for (const Json& run : document["benchmarks"])
    for (const char* key : {"name", "run_name", "run_type", "repetitions", "threads", "iterations",
                            "real_time", "cpu_time", "time_unit"})
      EXPECT_TRUE(run.contains(key)) << key << " of " << run.dump();
}

TEST(BenchJson, ASampleIsAnIterationAndTheMedianAnAggregate) {
  const Json document = Json::parse(googleBenchmarkJson({exampleResults()}));
  const Json& first = document["benchmarks"][0];
  EXPECT_EQ(first["name"], "passes/800x600/Cull/atrium");
  EXPECT_EQ(first["run_type"], "iteration");
  EXPECT_EQ(first["repetition_index"], 0);
  EXPECT_EQ(first["real_time"], 3.0);
  EXPECT_EQ(first["time_unit"], "ms");
  const Json& median = document["benchmarks"][3];
  EXPECT_EQ(median["name"], "passes/800x600/Cull/atrium_median");
  EXPECT_EQ(median["run_type"], "aggregate");
  EXPECT_EQ(median["aggregate_name"], "median");
  EXPECT_EQ(median["real_time"], 2.0);
  EXPECT_EQ(median["cpu_time"], 0.2);
  EXPECT_EQ(median["iterations"], 3);
  EXPECT_EQ(median["draws"], 4.0);
}

TEST(BenchJson, WhatIsInfiniteIsLeftOut) {
  Results results = exampleResults();
  Measurement& cull = results.at({"800x600", "Cull", "atrium"});
  for (const double psnr : {30., 40., std::numeric_limits<double>::infinity()})
    cull.count("psnr", psnr);
  const std::string text = googleBenchmarkJson({results});
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("null")));
  const Json runs = Json::parse(text)["benchmarks"];
  EXPECT_EQ(runs[3]["psnr"], 40.0);
  EXPECT_EQ(runs[7]["name"], "passes/800x600/Cull/atrium_max");
  EXPECT_FALSE(runs[7].contains("psnr"));
}

TEST(BenchJson, SaysHowMuchEachSuiteMeasured) {
  const Json document = Json::parse(googleBenchmarkJson({exampleResults()}));
  EXPECT_EQ(document["context"]["suites"]["passes"]["cameras"], 2);
  EXPECT_EQ(document["context"]["suites"]["passes"]["rounds"], 3);
  EXPECT_EQ(document["context"]["suites"]["passes"]["cancelled"], false);
}

}  // namespace
}  // namespace lucerna::app::bench
