#include "app/bench/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/html.hpp"
#include "core/markdown.hpp"
#include "core/svg.hpp"

namespace lucerna::app::bench {
namespace {

constexpr std::string_view kStyle =
    "td { white-space: nowrap; } ul { margin: .3rem 0; } dl { display: grid; gap: .2rem 1rem; "
    "grid-template-columns: max-content auto; } dd { margin: 0; } .wide { overflow-x: auto; }\n";

std::string markdownOf(const std::string& text) {
  return escapedMarkdown(text) + "\n";
}
std::string markdownOf(const Table& table) {
  return "**" + escapedMarkdown(table.title) + "**\n\n" + markdownTable(table.head, table.rows);
}
// The tables above have the numbers.
std::string markdownOf(const LinePlot&) {
  return "";
}
std::string markdownOf(const BarPlot&) {
  return "";
}

std::string htmlOf(const std::string& text) {
  return "<p>" + escapedXml(text) + "</p>\n";
}

std::string htmlRow(const std::vector<std::string>& cells, std::string_view tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, escapedXml(cell));
  return row + "</tr>\n";
}

std::string htmlOf(const Table& table) {
  std::string text =
      fmt::format("<h3>{}</h3>\n<div class=\"wide\"><table>\n<thead>\n{}</thead>\n<tbody>\n",
                  escapedXml(table.title), htmlRow(table.head, "th"));
  for (const auto& row : table.rows) text += htmlRow(row, "td");
  return text + "</tbody>\n</table></div>\n";
}

template <typename Plot>
std::string htmlOf(const Plot& plot) {
  return "<h3>" + escapedXml(plot.title) + "</h3>\n" + svgOf(plot);
}

std::vector<std::string> notesOf(const Results& results) {
  std::vector<std::string> notes = results.notes;
  if (results.cameras > 0)  // else nothing was drawn
    notes.insert(
        notes.begin(),
        fmt::format("{} {}camera{} a scene, pictures of {} px; each variant is drawn once to "
                    "warm up and then {} time{}, in turn with the others.",
                    results.cameras, results.ownCameras ? "of its own " : "seeded ",
                    results.cameras == 1 ? "" : "s", fmt::join(results.sizes, ", "), results.rounds,
                    results.rounds == 1 ? "" : "s"));
  if (results.cancelled) notes.insert(notes.begin(), "Cancelled: scenes are missing.");
  return notes;
}

}  // namespace

Table tableOf(
    std::string title, std::string corner, const std::vector<std::string>& rows,
    const std::vector<std::string>& columns,
    const std::function<std::string(const std::string& row, const std::string& column)>& cell) {
  Table table{.title = std::move(title), .head = {std::move(corner)}};
  table.head.insert(table.head.end(), columns.begin(), columns.end());
  for (const std::string& row : rows) {
    table.rows.push_back({row});
    for (const std::string& column : columns) table.rows.back().push_back(cell(row, column));
  }
  return table;
}

LinePlot medianPlot(LinePlot plot, const std::vector<std::string>& names,
                    const std::vector<std::string>& xs,
                    const std::function<std::vector<double>(const std::string& name,
                                                            const std::string& x)>& samplesOf) {
  for (const std::string& name : names) {
    Curve& curve = plot.curves.emplace_back(Curve{.name = name});
    for (const std::string& x : xs)
      curve.points.emplace_back(std::stod(x), spreadOf(samplesOf(name, x)).median);
  }
  return plot;
}

Table drawsTable(const Results& results, const std::string& size, std::string corner,
                 const std::vector<std::string>& rows, const std::vector<std::string>& scenes) {
  return tableOf("Draws, primitives at " + size + ": medians, each row by itself",
                 std::move(corner), rows, scenes,
                 [&](const std::string& row, const std::string& scene) -> std::string {
                   const Measurement* m = results.find({size, row, scene});
                   if (!m) return "-";
                   return fmt::format("{:.0f}, {:.0f}", spreadOf(m->samples("draws")).median,
                                      spreadOf(m->samples("primitives")).median);
                 });
}

std::string numberText(double value) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  if (value == 0) return "0";
  const double magnitude = std::floor(std::log10(std::abs(value)));
  if (magnitude < -4) return fmt::format("{:.2e}", value);
  return fmt::format("{:.{}f}", value, static_cast<int>(std::max(2 - magnitude, 0.0)));
}

std::string spreadText(std::span<const double> samples) {
  if (samples.empty()) return "-";
  const Spread spread = spreadOf(samples);
  if (samples.size() == 1) return numberText(spread.median);
  return fmt::format("{} ({} to {})", numberText(spread.median), numberText(spread.lower),
                     numberText(spread.upper));
}

std::string worstText(std::span<const double> errors, double Spread::* worst) {
  if (errors.empty()) return "-";
  const Spread spread = spreadOf(errors);
  if (errors.size() == 1) return numberText(spread.median);
  return fmt::format("{} (worst {})", numberText(spread.median), numberText(spread.*worst));
}

std::string ratioText(std::span<const double> ratios) {
  return ratios.empty() ? "-" : fmt::format("{:.2f}", spreadOf(ratios).median);
}

std::string benchMarkdown(const std::vector<Results>& results, const std::vector<Report>& reports) {
  std::string text = "# Measured by lucerna bench\n\n";
  for (const auto& [name, value] : sharedContext(results).described())
    text += fmt::format("- {}: {}\n", name, escapedMarkdown(value));
  for (std::size_t i = 0; i < reports.size(); ++i) {
    text += "\n## " + escapedMarkdown(reports[i].title) + "\n";
    text += "\n";
    for (const std::string& note : notesOf(results[i])) text += "- " + escapedMarkdown(note) + "\n";
    for (const Block& block : reports[i].blocks)
      if (const auto part = std::visit([](const auto& b) { return markdownOf(b); }, block);
          !part.empty())
        text += "\n" + part;
  }
  return text;
}

std::string benchHtml(const std::vector<Results>& results, const std::vector<Report>& reports) {
  std::string body = "<h1>Measured by lucerna bench</h1>\n";
  body += "<dl>\n";
  for (const auto& [name, value] : sharedContext(results).described())
    body += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escapedXml(value));
  body += "</dl>\n";
  for (std::size_t i = 0; i < reports.size(); ++i) {
    body += "<h2>" + escapedXml(reports[i].title) + "</h2>\n";
    std::string notes;
    for (const std::string& note : notesOf(results[i]))
      notes += "<li>" + escapedXml(note) + "</li>\n";
    if (!notes.empty()) body += "<ul class=\"quiet\">\n" + notes + "</ul>\n";
    for (const Block& block : reports[i].blocks)
      body += std::visit([](const auto& b) { return htmlOf(b); }, block);
  }
  return htmlText({.title = "Measured by lucerna bench",
                   .style = std::string(kSvgStyle) + std::string(kStyle),
                   .body = body});
}

}  // namespace lucerna::app::bench
