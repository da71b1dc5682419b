#include "app/bench/report.hpp"

#include <gmock/gmock.h>

namespace lucerna::app::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Samples = std::vector<double>;

TEST(BenchReport, NumbersHaveThreeDigitsThatCount) {
  EXPECT_EQ(numberText(1234.4), "1234");
  EXPECT_EQ(numberText(99.94), "99.9");
  EXPECT_EQ(numberText(1), "1.00");
  EXPECT_EQ(numberText(0.01236), "0.0124");
  EXPECT_EQ(numberText(0.000000703), "7.03e-07");
  EXPECT_EQ(numberText(0), "0");
  EXPECT_EQ(numberText(std::numeric_limits<double>::infinity()), "inf");
}

TEST(BenchReport, SpreadsAreMediansWithQuartiles) {
  EXPECT_EQ(spreadText(Samples{1, 2, 3}), "2.00 (1.50 to 2.50)");
  EXPECT_EQ(spreadText(Samples{5}), "5.00");
  EXPECT_EQ(spreadText({}), "-");
}

TEST(BenchReport, ErrorsAreMediansWithTheWorst) {
  EXPECT_EQ(worstText(Samples{1, 2, 9}), "2.00 (worst 9.00)");
  EXPECT_EQ(worstText(Samples{20, 30, 40}, &Spread::min), "30.0 (worst 20.0)");
  EXPECT_EQ(worstText(Samples{2}), "2.00");
  EXPECT_EQ(worstText({}), "-");
}

TEST(BenchReport, ARatioIsTheMedianOfRatios) {
  EXPECT_EQ(ratioText(Samples{1, 1.5, 100}), "1.50");
  EXPECT_EQ(ratioText({}), "-");
}

TEST(BenchReport, ATableHasACellForEveryRowAndColumn) {
  const Table table = tableOf("ms", "pass", {"Cull", "Ao"}, {"a", "b"},
                              [](const std::string& r, const std::string& c) { return r + c; });
  EXPECT_EQ(table.head, (std::vector<std::string>{"pass", "a", "b"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"Ao", "Aoa", "Aob"}));
}

// 10 at the bottom and 1000 at the top of the y axis, 1 to 2 along x: the middle is 100.
TEST(BenchPlot, LogarithmicAxesSpaceRatiosEvenly) {
  const std::string svg = svgOf(LinePlot{.title = "t",
                                         .xLabel = "x",
                                         .yLabel = "y",
                                         .logarithmic = true,
                                         .curves = {{"c", {{1, 10}, {2, 100}, {4, 1000}}}}});
  // From (70, 290) to (630, 20), x from 1 to 5.
  EXPECT_THAT(svg, HasSubstr("<polyline points=\"70.0,290.0 311.2,155.0 552.4,20.0 \""));
  EXPECT_THAT(svg, HasSubstr("<title>c: 2, 100</title>"));
}

TEST(BenchPlot, LinearAxesBeginAtZero) {
  const std::string svg = svgOf(
      LinePlot{.title = "t", .xLabel = "x", .yLabel = "y", .curves = {{"c", {{0, 5}, {2, 10}}}}});
  EXPECT_THAT(svg, HasSubstr("<polyline points=\"70.0,155.0 630.0,20.0 \""));
}

// Where a value is 0 there is no logarithm.
TEST(BenchPlot, NothingBreaksIt) {
  for (const auto& points : {std::vector<glm::dvec2>{}, {{1, 0}, {2, 0}}, {{3, 3}}, {{0, 0}}}) {
    for (const bool logarithmic : {false, true}) {
      const std::string svg = svgOf(LinePlot{.title = "t",
                                             .xLabel = "x",
                                             .yLabel = "y",
                                             .logarithmic = logarithmic,
                                             .curves = {{"c", points}}});
      EXPECT_THAT(svg, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
    }
  }
  EXPECT_THAT(svgOf(BarPlot{.rows = {"a"}, .parts = {"p"}, .values = {{0}}}),
              Not(HasSubstr("nan")));
}

TEST(BenchPlot, BarsAreStackedAndAsLongAsTheirValues) {
  const std::string svg = svgOf(BarPlot{.title = "t",
                                        .unit = "ms",
                                        .rows = {"a", "b"},
                                        .parts = {"p", "q"},
                                        .values = {{1, 3}, {2, 0}}});
  // 640 px are 4 ms.
  EXPECT_THAT(svg, HasSubstr("<rect x=\"340.00\" y=\"4.00\" width=\"480.00\""));
  EXPECT_THAT(svg, HasSubstr("<title>a, q: 3.00 ms</title>"));
  EXPECT_THAT(svg, HasSubstr(">4.00 ms</text>"));
}

struct Example {
  Example() { results.context.driver = "llvmpipe"; }
  Results results{.suite = "passes", .cameras = 1, .rounds = 2};
  Report report{.title = "passes <1>",
                .blocks = {"A paragraph.", Table{"ms", {"pass", "a|b"}, {{"Ao", "1 < 2"}}},
                           LinePlot{.title = "Plot", .curves = {{"c", {{1, 2}}}}}}};
};

TEST(BenchReport, MarkdownHasNotesTextAndTables) {
  Example example;
  example.results.note("Skipped: sponza.");
  example.results.cancelled = true;
  EXPECT_THAT(
      benchMarkdown({example.results}, {example.report}),
      AllOf(HasSubstr(
                "## passes \\<1\\>\n\n- Cancelled: scenes are missing.\n- 1 seeded camera a scene"),
            HasSubstr("- Skipped: sponza.\n\nA paragraph.\n\n**ms**\n\n| pass | a\\|b |\n"),
            HasSubstr("| Ao | 1 \\< 2 |\n"), Not(HasSubstr("Plot"))));
}

TEST(BenchReport, WhereNothingIsDrawnThereAreNoCamerasAndNoDriver) {
  Example example;
  example.results.cameras = 0;
  example.results.context.driver.clear();
  EXPECT_THAT(benchMarkdown({example.results}, {example.report}),
              AllOf(Not(HasSubstr("camera")), Not(HasSubstr("OpenGL")), HasSubstr("- seed: 0\n")));
}

TEST(BenchReport, ThePageHasAllOfItAndNeedsNothingElse) {
  const Example example;
  const std::string page = benchHtml({example.results}, {example.report});
  EXPECT_THAT(page, AllOf(HasSubstr("<h2>passes &lt;1&gt;</h2>"), HasSubstr("<p>A paragraph.</p>"),
                          HasSubstr("<td>1 &lt; 2</td>"), HasSubstr("<h3>Plot</h3>\n<svg "),
                          HasSubstr("<dt>OpenGL</dt>"), Not(HasSubstr("<script")),
                          Not(HasSubstr("src=")), Not(HasSubstr("href="))));
}

}  // namespace
}  // namespace lucerna::app::bench
