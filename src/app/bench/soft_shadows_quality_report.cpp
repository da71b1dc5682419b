// The tables of the suite soft-shadows-quality.
#include <cmath>
#include <optional>

#include "app/bench/soft_shadows_quality.hpp"

namespace lucerna::app::bench::quality {
namespace {

constexpr double kNoiseFactor = 3;  // errors below so many times the noise are not told apart

// The reports' columns: the methods, and the noise.
std::vector<std::string> columns(bool withAlone) {
  std::vector<std::string> all = withAlone ? allMethods() : kMethods;
  all.push_back(kNoise);
  return all;
}

Table errorTable(const Results& results, const std::string& title, const std::string& counter,
                 double Spread::* worst, bool withAlone = false) {
  return tableOf(title, "scene", results.parts(1), columns(withAlone),
                 [&](const std::string& scene, const std::string& method) {
                   return worstText(results.samples({method, scene}, counter), worst);
                 });
}

double noiseOf(const Results& results, const std::string& scene) {
  return spreadOf(results.samples({kNoise, scene}, "flip")).max;
}

// FLIP that is lost in the noise is not told.
Table flipTable(const Results& results) {
  return tableOf("FLIP of the frame: median (worst)", "scene", results.parts(1), columns(true),
                 [&](const std::string& scene, const std::string& method) {
                   const auto flips = results.samples({method, scene}, "flip");
                   const double bound = kNoiseFactor * noiseOf(results, scene);
                   if (method != kNoise && !flips.empty() && spreadOf(flips).median < bound)
                     return "below " + numberText(bound);
                   return worstText(flips);
                 });
}

double filterMs(const Results& results, const std::string& method, const std::string& scene) {
  return spreadOf(results.times({method, scene})).median -
         spreadOf(results.times({kAlone, scene})).median;
}

// What is wanted of layered shadows; the others stand beside, and what is not blurred should miss
// it.
struct Bar {
  enum class Of { Value, ShareOfPcss, AbovePcss, FromOne };
  std::string what, scene, counter;  // scene "": all
  double bound;
  bool atLeast = false;
  Of of = Of::Value;
};

const std::string kFilter = "filter";

std::vector<Bar> bars() {
  using Of = Bar::Of;
  std::vector<Bar> all{
      {"FLIP", kHall, "flip", 0.025},
      {"FLIP, share of pcss's", kHall, "flip", 0.8, false, Of::ShareOfPcss},
      {"filter time, share of pcss's", kHall, kFilter, 0.5, false, Of::ShareOfPcss},
      {"FLIP", kManyLights, "flip", 0.03}};
  for (const std::string& scene : {kHall, kManyLights})
    all.insert(all.end(),
               {{"PSNR in penumbrae, dB", scene, "penumbra_psnr", 28, true},
                {"PSNR above pcss's, dB", scene, "penumbra_psnr", 0, true, Of::AbovePcss},
                {"leak, %", scene, "leak", 0.5},
                {"false shadow, %", scene, "false_shadow", 0.5},
                {"halo pixels, %", scene, "halo", 0.3}});
  all.insert(all.end(),
             {{"error of widths, %", "", kWidths, 10},
              {"exponent of the size, distance from 1", "", "exponent", 0.03, false, Of::FromOne},
              {"others' steps of 255", "overlap 32", "others_steps", 2},
              {"others' steps of 255", kHall, "others_steps", 2}});
  return all;
}

std::optional<double> valueOf(const Results& results, const Bar& bar, const std::string& method) {
  if (bar.counter == kFilter) {
    if (results.times({method, bar.scene}).empty()) return std::nullopt;
    return filterMs(results, method, bar.scene);
  }
  Name name{method};
  if (!bar.scene.empty()) name.push_back(bar.scene);
  const auto samples = results.samples(name, bar.counter);
  return samples.empty() ? std::nullopt : std::optional(spreadOf(samples).median);
}

std::string judged(const Results& results, const Bar& bar, const std::string& method) {
  auto value = valueOf(results, bar, method);
  if (!value) return "-";
  if (bar.of == Bar::Of::FromOne) *value = std::abs(*value - 1);
  if (bar.of == Bar::Of::ShareOfPcss || bar.of == Bar::Of::AbovePcss) {
    const auto pcss = valueOf(results, bar, kPcss);
    if (!pcss) return "-";
    *value = bar.of == Bar::Of::ShareOfPcss ? *value / *pcss : *value - *pcss;
  }
  const bool met = bar.atLeast ? *value >= bar.bound : *value <= bar.bound;
  return numberText(*value) + (met ? ", met" : ", missed");
}

Table barsTable(const Results& results) {
  Table table{.title =
                  "What is wanted of layered shadows, medians; 'hard' is what they are "
                  "without blur",
              .head = {"", "scene", "wanted"}};
  table.head.insert(table.head.end(), kMethods.begin(), kMethods.end());
  for (const Bar& bar : bars()) {
    if (!valueOf(results, bar, kLayered)) continue;
    std::vector<std::string> row{
        bar.what, bar.scene.empty() ? "all that are known" : bar.scene,
        fmt::format("at {} {}", bar.atLeast ? "least" : "most", bar.bound)};
    for (const std::string& method : kMethods) row.push_back(judged(results, bar, method));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table widthsTable(const Results& results) {
  const std::string all = "all but panes: median, wanted at most 10",
                    exponent = "exponent of the light's size, wanted 1.00 +- 0.03";
  std::vector<std::string> rows;
  for (const KnownScene& known : knownScenes())
    for (const char* widths : {kWidths, kPaneWidths})
      if (!results.samples({kNoise, known.name}, widths).empty()) rows.push_back(known.name);
  rows.insert(rows.end(), {all, exponent});
  return tableOf(
      "Error of penumbrae's widths against the closed form, %: median (worst)", "scene", rows,
      columns(false), [&](const std::string& row, const std::string& method) {
        if (row == all) return worstText(results.samples({method}, kWidths));
        if (row == exponent) return spreadText(results.samples({method, kExponents}, "exponent"));
        return worstText(results.samples({method, row}, row == "panes" ? kPaneWidths : kWidths));
      });
}

Table filterTable(const Results& results) {
  const std::string flip = "FLIP, layered / pcss", time = "filter time, layered / pcss";
  std::vector<std::string> columnNames = kMethods;
  columnNames.insert(columnNames.end(), {flip, time});
  return tableOf(
      "Filter time in ms, beyond lighting alone, maps kept; and FLIP beside it (wanted at 16 "
      "lights: FLIP at most 0.80 at no more than 0.50 of the time)",
      "scene", results.parts(1), columnNames,
      [&](const std::string& scene, const std::string& column) -> std::string {
        if (column == flip)
          return ratioText(pairedRatios(results.samples({kLayered, scene}, "flip"),
                                        results.samples({kPcss, scene}, "flip")));
        if (column == time) {
          const double pcss = filterMs(results, kPcss, scene);
          return pcss > 0 ? fmt::format("{:.2f}", filterMs(results, kLayered, scene) / pcss) : "-";
        }
        return results.times({column, scene}).empty()
                   ? "-"
                   : numberText(filterMs(results, column, scene));
      });
}

BarPlot flipPlot(const Results& results, const std::string& scene) {
  BarPlot plot{.title = "FLIP of the frame, " + scene + ", medians",
               .unit = "",
               .rows = columns(true),
               .parts = {"FLIP"}};
  for (const std::string& method : plot.rows)
    plot.values.push_back({spreadOf(results.samples({method, scene}, "flip")).median});
  return plot;
}

}  // namespace

std::vector<Block> report(const Results& results) {
  std::vector<Block> blocks;
  blocks.emplace_back(fmt::format(
      "The distance from a picture that is traced in the same process with {} rays a light and "
      "pixel through each pixel's centre, shaded from the lights' centres; all surfaces are plain. "
      "'{}' is that picture once more with other random numbers: the noise; nothing is told of "
      "FLIP below {} times it. A light's visibility is its own picture as a share of that without "
      "shadows, all lights on; its penumbra the pixels where the reference has 0.02 to 0.98. Leak "
      "is the mean visibility where the reference has none, false shadow what is missing where it "
      "has all, halo pixels those wrong by more than 0.1 within {} pixels of an edge of depth, of "
      "all that the light reaches.",
      tracedSamples(results), kNoise, kNoiseFactor, kNearEdge));
  blocks.emplace_back(barsTable(results));
  blocks.emplace_back(flipTable(results));
  blocks.emplace_back(filterTable(results));
  blocks.emplace_back(errorTable(results,
                                 "PSNR in dB inside each light's penumbra: median (worst light)",
                                 "penumbra_psnr", &Spread::min));
  blocks.emplace_back(errorTable(results, "SSIM inside each light's penumbra: median (worst light)",
                                 "penumbra_ssim", &Spread::min));
  blocks.emplace_back(errorTable(results, "FLIP inside each light's penumbra: median (worst light)",
                                 "penumbra_flip", &Spread::max));
  blocks.emplace_back(errorTable(results, "Leak, %", "leak", &Spread::max));
  blocks.emplace_back(errorTable(results, "False shadow, %", "false_shadow", &Spread::max));
  blocks.emplace_back(errorTable(results, "Halo pixels, %", "halo", &Spread::max));
  blocks.emplace_back(errorTable(
      results, "How far other lights change a light's visibility, most of all pixels, steps of 255",
      "others_steps", &Spread::max));
  blocks.emplace_back(widthsTable(results));
  if (!results.samples({kAlone, kMoving}, "flicker").empty())
    blocks.emplace_back(tableOf(
        "Flicker where a tenth of the objects moves, 120 frames at 30 a second: how far a frame is "
        "from what lies between "
        "those before and after it, steps of 255, median (worst frame)",
        "scene", {kMoving}, allMethods(), [&](const std::string& scene, const std::string& method) {
          return worstText(results.samples({method, scene}, "flicker"));
        }));
  blocks.emplace_back(flipPlot(results, results.parts(1).front()));
  return blocks;
}

}  // namespace lucerna::app::bench::quality
