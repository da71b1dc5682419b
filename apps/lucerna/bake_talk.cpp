#include "bake_talk.hpp"

#include <algorithm>
#include <cmath>

#include "bake/light_set.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/time_text.hpp"

namespace lucerna::cli {
namespace {

double millions(std::uint64_t count) {
  return static_cast<double>(count) / 1e6;
}

// "4120", "31.3 million"
std::string amountText(std::uint64_t count) {
  return count < 1'000'000 ? fmt::format("{}", count)
                           : fmt::format("{:.1f} million", millions(count));
}

Json describe(const bake::SeamSteps& steps) {
  return {
      {"median", steps.median}, {"percentile_99", steps.percentile99}, {"largest", steps.largest}};
}

Json describe(const bake::SeamReport& seams) {
  Json encoded = Json::object();
  for (const bake::EncodedSteps& steps : seams.encoded)
    encoded[steps.encoding == bake::Encoding::Bc6h ? "bc6h" : "rgb9e5"] = describe(steps.after);
  return {{"edges", seams.seams},
          {"texels", seams.texels},
          {"samples", seams.samples},
          {"parts", seams.parts},
          {"most_iterations", seams.mostIterations},
          {"before", describe(seams.before)},
          {"after", describe(seams.after)},
          {"encoded", std::move(encoded)},
          {"seconds", seams.seconds}};
}

}  // namespace

Json describe(const bake::Plan& plan) {
  return {{"scene", plan.world.scene->name},
          {"triangles", plan.world.triangleCount()},
          {"charts", plan.charts.charts.size()},
          {"texels", plan.coveredTexels()},
          {"maps", plan.packed.packing.maps},
          {"side", plan.settings.pack.side},
          {"occupancy",
           bake::occupancy(plan.packed.packing, plan.packed.masks, plan.settings.pack.side)},
          {"units", plan.units.size()},
          {"lights", bake::lightCount(plan)},
          {"groups", plan.groups.size() - 1}};
}

Json describe(const bake::BakeReport& report) {
  const bake::LightCounters& c = report.counters;
  return {{"units", report.units},
          {"units_before", report.unitsBefore},
          {"texels", report.texels},
          {"pairs", c.pairs},
          {"rays", c.rays},
          {"seams", describe(report.seams)},
          {"seconds",
           {{"prepare", report.seconds.prepare},
            {"light", report.seconds.light},
            {"finish", report.seconds.finish}}},
          {"cpu_seconds",
           {{"sampling", report.samplingSeconds},
            {"shading", c.shadingSeconds},
            {"tracing", c.tracingSeconds}}}};
}

void sayPlan(const bake::Plan& plan) {
  const int side = plan.settings.pack.side;
  log::info("{} in {}, which cover {} texels of {} of {} x {}",
            counted(plan.world.triangleCount(), "triangle"),
            counted(plan.charts.charts.size(), "chart"), amountText(plan.coveredTexels()),
            counted(static_cast<std::uint64_t>(plan.packed.packing.maps), "map"), side, side);
}

void sayReport(const bake::BakeReport& report) {
  const bake::LightCounters& c = report.counters;
  log::info("lit in {}, with {} rays", secondsText(report.seconds.light), amountText(c.rays));
  log::debug(
      "{:.1f} million pairs of light and texel; of all threads {:.2f} s for samples, {:.2f} s for "
      "shading, {:.2f} s for rays ({:.1f} million a second)",
      millions(c.pairs), report.samplingSeconds, c.shadingSeconds, c.tracingSeconds,
      millions(c.rays) / std::max(c.tracingSeconds, 1e-9));
}

Json describe(const bake::Preflight& found) {
  return {{"not_finite", found.notFinite},
          {"huge", found.huge},
          {"degenerate", found.degenerate},
          {"duplicate", found.duplicate},
          {"larger_than_a_map", found.shrunk},
          {"unlit", found.unlit},
          {"moving", found.moving},
          {"bending", found.bending},
          {"lights_inside", found.buried}};
}

Json describe(const bake::Estimate& e) {
  return {{"sampled_units", e.units},
          {"emitter_cells", e.emitterCells},
          {"prepare_seconds", e.prepareSeconds},
          {"light_seconds", e.lightSeconds},
          {"deviation", e.deviation},
          {"threads", threadCount()},
          {"light_bytes", e.lightBytes},
          {"finish_bytes", e.finishBytes},
          {"log_bytes", e.logBytes}};
}

std::string estimateText(const bake::Plan& plan, const bake::Estimate& e) {
  const std::size_t charts = plan.charts.charts.size();
  std::string text = fmt::format(
      "charts     {}\ntexels     {} that they cover\nmaps       {} of {} x {}, {:.0f} % covered\n"
      "lights     ",
      charts, plan.coveredTexels(), plan.packed.packing.maps, plan.settings.pack.side,
      plan.settings.pack.side,
      100. * bake::occupancy(plan.packed.packing, plan.packed.masks, plan.settings.pack.side));
  text += fmt::format("{}, in {} that switch; {} of surfaces that shine\n", bake::lightCount(plan),
                      counted(plan.groups.size() - 1, "group"), counted(e.emitterCells, "cell"));
  text += fmt::format("light      {}, after {} to prepare, on {}: an estimate, by {} of {} units\n",
                      aboutText(e.lightSeconds, 2. * e.deviation), secondsText(e.prepareSeconds),
                      counted(static_cast<std::uint64_t>(threadCount()), "thread"), e.units,
                      plan.units.size());
  if (e.lightBytes != 0)
    text += fmt::format("memory     about {} while lighting, {} while writing maps\n",
                        bytesText(e.lightBytes), bytesText(e.finishBytes));
  return text +
         fmt::format("logs       about {}, until the maps are written\n", bytesText(e.logBytes));
}

}  // namespace lucerna::cli
