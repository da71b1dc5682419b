#include <algorithm>
#include <cmath>

#include "app/bench/bake_suite.hpp"
#include "app/bench/bake_workloads.hpp"

namespace lucerna::app::bench {
namespace {

constexpr double kThesisBytes = 1.94e9, kThesisTexels = 8. * 2048 * 2048;

const Load* thesisLoad(const std::string& name, const std::string& scene) {
  if (scene != "nightcity") return nullptr;
  const auto found = std::ranges::find(thesisLoads(), name, &Load::name);
  return found == thesisLoads().end() ? nullptr : &*found;
}

double of(const Measurement& m, std::string_view counter) {
  return spreadOf(m.samples(counter)).median;
}

std::string millions(double count) {
  return numberText(1e-6 * count);
}

std::string orNone(double value) {
  return value > 0 ? numberText(value) : "-";
}

std::vector<const Measurement*> allOf(const Results& results, const Name& begin) {
  std::vector<const Measurement*> found;
  for (const Measurement& m : results.measurements)
    if (m.name.size() > begin.size() && std::equal(begin.begin(), begin.end(), m.name.begin()))
      found.push_back(&m);
  return found;
}

// What an engine's sample lets expect of all of the light stage.
struct Expected {
  bool known = false;
  double shading = 0, tracing = 0, error = 0;  // s; the standard error of both together
  double rays = 0, raysError = 0, share = 0;
};
Expected expected(const Results& results, const std::string& engine, const Name& load) {
  const Measurement* m = results.find({kEngine, engine, load[1], load[2]});
  if (!m || m->samples("all_tracing_s").empty()) return {};
  return {.known = true,
          .shading = of(*m, "all_shading_s"),
          .tracing = of(*m, "all_tracing_s"),
          .error = std::hypot(of(*m, "all_shading_s_error"), of(*m, "all_tracing_s_error")),
          .rays = of(*m, "all_rays"),
          .raysError = of(*m, "all_rays_error"),
          .share = of(*m, "share")};
}

std::string withError(double value, double error) {
  return fmt::format("{} ± {}", numberText(value), numberText(error));
}

Table lightTable(const Results& results) {
  Table table{.title = "The light stage, all threads (tables 6.2 to 6.4)",
              .head = {"scene", "lights", "how many", "pairs after culling, M", "real rays, M",
                       "the thesis' pairs, M", "s", "the thesis' pairs a second, M", "thesis, s",
                       "thesis, M a second", "times as fast"}};
  for (const Measurement* m : allOf(results, {kLight})) {
    const Load* thesis = thesisLoad(m->name[1], m->name[2]);
    const double seconds = 1e-3 * spreadOf(m->realMs).median;
    table.rows.push_back(
        {m->name[2], m->name[1], fmt::format("{:.0f}", of(*m, "lights")), millions(of(*m, "pairs")),
         millions(of(*m, "rays")), millions(of(*m, "thesis_pairs")), numberText(seconds),
         millions(of(*m, "thesis_pairs") / seconds), thesis ? orNone(thesis->thesisSeconds) : "-",
         thesis ? orNone(thesis->thesisRate) : "-",
         thesis && !results.context.quick ? orNone(thesis->thesisSeconds / seconds) : "-"});
  }
  return table;
}

Table cpuTable(const Results& results) {
  Table table{.title = "Seconds of CPU of the light stage: Embree in full; the octree extrapolated",
              .head = {"scene", "lights", "places to light, both", "Embree, shading",
                       "Embree, rays", "Embree, all of it", "octree, shading", "octree, rays",
                       "octree, all of it (extrapolated)", "from % of the pairs",
                       "octree / Embree, all of it", "octree / Embree, light alone",
                       "Embree, shading and rays, extrapolated likewise"}};
  for (const Measurement* m : allOf(results, {kLight})) {
    const Expected octree = expected(results, kOctree, m->name);
    if (!octree.known) continue;
    const Expected embree = expected(results, kEmbree, m->name);
    const double sampling = of(*m, "sampling_s"), light = of(*m, "shading_s") + of(*m, "tracing_s");
    const double all = octree.shading + octree.tracing;
    table.rows.push_back(
        {m->name[2], m->name[1], numberText(sampling), numberText(of(*m, "shading_s")),
         numberText(of(*m, "tracing_s")), numberText(sampling + light), numberText(octree.shading),
         numberText(octree.tracing), withError(sampling + all, octree.error),
         numberText(100 * octree.share), numberText((sampling + all) / (sampling + light)),
         numberText(all / light), withError(embree.shading + embree.tracing, embree.error)});
  }
  return table;
}

// The octree beside what the thesis says of its own.
Table thesisTable(const Results& results) {
  Table table{.title = "The octree, the thesis' way, one thread (extrapolated)",
              .head = {"scene", "lights", "how many", "the thesis' pairs, M", "real rays, M",
                       "light stage, s", "the thesis' pairs a second, M", "thesis, s",
                       "thesis, M a second"}};
  for (const Measurement* m : allOf(results, {kLight})) {
    const Expected octree = expected(results, kOctree, m->name);
    if (!octree.known) continue;
    const Load* thesis = thesisLoad(m->name[1], m->name[2]);
    const double seconds = of(*m, "sampling_s") + octree.shading + octree.tracing;
    table.rows.push_back(
        {m->name[2], m->name[1], fmt::format("{:.0f}", of(*m, "lights")),
         millions(of(*m, "thesis_pairs")), withError(1e-6 * octree.rays, 1e-6 * octree.raysError),
         withError(seconds, octree.error), millions(of(*m, "thesis_pairs") / seconds),
         thesis ? orNone(thesis->thesisSeconds) : "-", thesis ? orNone(thesis->thesisRate) : "-"});
  }
  return table;
}

BarPlot cpuPlot(const Results& results) {
  BarPlot plot{.title = "Seconds of CPU of the light stage",
               .unit = "s",
               .parts = {"sampling", "shading", "tracing"}};
  for (const Measurement* m : allOf(results, {kLight})) {
    plot.rows.push_back(m->name[1] + ", " + m->name[2]);
    plot.values.push_back({of(*m, "sampling_s"), of(*m, "shading_s"), of(*m, "tracing_s")});
  }
  return plot;
}

Table engineTable(const Results& results) {
  Table table{.title = "The octree against Embree: the same units in turns, one thread",
              .head = {"scene", "lights", "units", "Embree, rays, M", "octree, rays, M",
                       "octree / Embree, all of it", "octree / Embree, tracing"}};
  for (const Measurement* m : allOf(results, {kEngine, kOctree})) {
    const Measurement* embree = results.find({kEngine, kEmbree, m->name[2], m->name[3]});
    table.rows.push_back(
        {m->name[3], m->name[2], fmt::format("{:.0f}", of(*m, "units")),
         millions(of(*embree, "rays")), millions(of(*m, "rays")),
         ratioText(pairedRatios(m->realMs, embree->realMs)),
         ratioText(pairedRatios(m->samples("tracing_s"), embree->samples("tracing_s")))});
  }
  return table;
}

// What the thesis' means are worth: its rays, in the order in which it follows them.
Table octreeTable(const Results& results) {
  Table table{.title = "The octree's own rays, million a second, one thread: the same in turns",
              .head = {"scene", "lights", "rays, M", "Embree, ray by ray", "the octree",
                       "octree / Embree", "without mailboxes", "unsorted"}};
  for (const Measurement* m : allOf(results, {kRate, kOctreeBare})) {
    const auto rates = [&](const std::string& how) {
      const Measurement* own = results.find({kRate, how, m->name[2], m->name[3]});
      return own ? own->samples("mrays_s") : std::vector<double>{};
    };
    table.rows.push_back({m->name[3], m->name[2], millions(of(*m, "rays")),
                          spreadText(rates(kOctreeBare)), spreadText(rates(kOctreeRays)),
                          ratioText(pairedRatios(rates(kOctreeRays), rates(kOctreeBare))),
                          spreadText(rates(kNoMailboxes)), spreadText(rates(kUnsorted))});
  }
  return table;
}

// share: of Embree's bare packets, round by round.
Table rateTable(const Results& results, bool share) {
  Table table{.title = share
                           ? "Rates as shares of Embree's packets of 16 alone: median of the rounds"
                           : "Million rays a second, one thread: the same rays in turns",
              .head = {"scene", "lights", "rays, M"}};
  table.head.insert(table.head.end(), kHows.begin(), kHows.end());
  for (const Measurement* m : allOf(results, {kRate, kBarePackets})) {
    table.rows.push_back({m->name[3], m->name[2], millions(of(*m, "rays"))});
    for (const std::string& how : kHows) {
      const Measurement* own = results.find({kRate, how, m->name[2], m->name[3]});
      const std::vector<double> rates = own ? own->samples("mrays_s") : std::vector<double>{};
      table.rows.back().push_back(share ? ratioText(pairedRatios(rates, m->samples("mrays_s")))
                                        : spreadText(rates));
    }
  }
  return table;
}

Table packingTable(const Results& results) {
  Table table{.title = "Packing: maps of 2048 x 2048, and how full all but the last are",
              .head = {"scene", "texels a unit", "charts", "charts made, s", "worst stretch",
                       "masks", "masks, s", "rectangles", "rectangles, s"}};
  const auto filled = [](const Measurement& m) {
    const double maps = of(m, "maps");
    return fmt::format("{:.0f} map{}, {:.1f} %", maps, maps == 1 ? "" : "s",
                       100 * of(m, "occupancy"));
  };
  for (const Measurement* m : allOf(results, {kPacking, kMasks})) {
    const Measurement* loose = results.find({kPacking, kRectangles, m->name[2]});
    table.rows.push_back(
        {m->name[2], numberText(of(*m, "density")), fmt::format("{:.0f}", of(*m, "charts")),
         numberText(of(*m, "charting_s")), fmt::format("{:.3f}", of(*m, "worst_stretch")),
         filled(*m), numberText(1e-3 * spreadOf(m->realMs).median), loose ? filled(*loose) : "-",
         loose ? numberText(1e-3 * spreadOf(loose->realMs).median) : "-"});
  }
  return table;
}

Table memoryTable(const Results& results) {
  Table table{
      .title = "Memory beyond what the loaded scene takes, MiB (bytes a texel of the charts)",
      .head = {"scene", "lights", "texels, M", "after planning", "light stage, peak",
               "finish, peak"}};
  for (const Measurement* m : allOf(results, {kLight})) {
    if (m->samples("plan_mib").empty()) continue;
    const double texels = of(*m, "texels");
    const auto cell = [&](std::string_view counter) {
      const double bytes = of(*m, counter) * (1 << 20);
      return fmt::format("{} ({:.1f})", numberText(of(*m, counter)), bytes / texels);
    };
    table.rows.push_back({m->name[2], m->name[1], millions(texels), cell("plan_mib"),
                          cell("light_peak_mib"), cell("finish_peak_mib")});
  }
  table.rows.push_back({"the thesis' city", "rays", millions(kThesisTexels), "-",
                        fmt::format("{} ({:.1f})", numberText(kThesisBytes / (1 << 20)),
                                    kThesisBytes / kThesisTexels),
                        "-"});
  return table;
}

}  // namespace

std::vector<Block> bakeReport(const Results& results) {
  std::vector<Block> blocks;
  const bool lit = !allOf(results, {kLight}).empty();
  if (lit) {
    blocks.emplace_back(
        "Pairs after culling are of a point of light and a sample that it may light; real rays are "
        "those of them that were traced; the thesis' pairs are lights x maps x 2048 x 2048. Its "
        "times are those of one thread of a laptop of 2013, and of another city. Its other rows: "
        "106 lights by OpenGL 2.25 min, with PCF 8x8 19.267; 202 lights, triangles unsorted "
        "960.546 s, with a spot effect too 12874.661; 150306 lights with mailboxes 1.322, "
        "2.635 and 5.222 h, at any distance 20.561 h (68.12 M a second).");
    blocks.emplace_back(lightTable(results));
    blocks.emplace_back(cpuTable(results));
    blocks.emplace_back(thesisTable(results));
    blocks.emplace_back(cpuPlot(results));
  }
  if (!allOf(results, {kEngine}).empty()) blocks.emplace_back(engineTable(results));
  if (!allOf(results, {kRate}).empty()) {
    blocks.emplace_back(rateTable(results, false));
    blocks.emplace_back(rateTable(results, true));
    blocks.emplace_back(octreeTable(results));
  }
  blocks.emplace_back(packingTable(results));
  if (lit) blocks.emplace_back(memoryTable(results));
  return blocks;
}

}  // namespace lucerna::app::bench
