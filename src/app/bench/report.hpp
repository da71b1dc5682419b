// Tables and drawings made of what was measured, as Markdown and as a page that stands alone.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "app/bench/results.hpp"
#include "app/bench/statistics.hpp"

namespace lucerna::app::bench {

// Every row has as many cells as the head.
struct Table {
  std::string title{};
  std::vector<std::string> head{};
  std::vector<std::vector<std::string>> rows{};
};
// corner: what stands over the rows' names.
Table tableOf(
    std::string title, std::string corner, const std::vector<std::string>& rows,
    const std::vector<std::string>& columns,
    const std::function<std::string(const std::string& row, const std::string& column)>& cell);

// Draws and primitives of the median frame: of the measurements named {size, row, scene}.
Table drawsTable(const Results& results, const std::string& size, std::string corner,
                 const std::vector<std::string>& rows, const std::vector<std::string>& scenes);

struct Curve {
  std::string name{};
  std::vector<glm::dvec2> points{};  // x rising
};
struct LinePlot {
  std::string title{}, xLabel{}, yLabel{};
  bool logarithmic = false;  // both axes, where all values are above 0; else from 0
  std::vector<Curve> curves{};
};

// Gives `plot` a curve of medians for each name; xs are numbers.
LinePlot medianPlot(LinePlot plot, const std::vector<std::string>& names,
                    const std::vector<std::string>& xs,
                    const std::function<std::vector<double>(const std::string& name,
                                                            const std::string& x)>& samplesOf);

// A bar of parts for each row.
struct BarPlot {
  std::string title{}, unit{};
  std::vector<std::string> rows{}, parts{};
  std::vector<std::vector<double>> values{};  // of each row, of each part
};

using Block = std::variant<std::string, Table, LinePlot, BarPlot>;  // text: one paragraph

struct Report {
  std::string title{};
  std::vector<Block> blocks{};
};

// "12.3 (11.9 to 12.8)": median and quartiles with three digits that count. One sample stands
// alone; "-" is none.
std::string spreadText(std::span<const double> samples);
// "0.12 (worst 0.34)": the median and one of the ends. One error stands alone; "-" is none.
std::string worstText(std::span<const double> errors, double Spread::* worst = &Spread::max);
std::string numberText(double value);                   // three digits that count
std::string ratioText(std::span<const double> ratios);  // "1.45": their median; "-" is none

std::string svgOf(const LinePlot& plot);
std::string svgOf(const BarPlot& plot);

// What all suites have in common comes first: the context and what was left out.
std::string benchMarkdown(const std::vector<Results>& results, const std::vector<Report>& reports);
std::string benchHtml(const std::vector<Results>& results, const std::vector<Report>& reports);

}  // namespace lucerna::app::bench
