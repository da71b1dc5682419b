#include "app/bench/shadow_methods.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lucerna::app::bench {
namespace {

Row lighting(const std::string& shadows, std::vector<std::string> more = {}) {
  more.insert(more.begin(), "shadows=" + shadows);
  return {"TiledLighting", std::move(more)};
}

std::string setting(const char* param, int value) {
  return fmt::format("{}={}", param, value);
}

ShadowMethod pcf(int kernel) {
  return {.name = fmt::format("pcf {}", kernel),
          .lighting = lighting("pcf", {setting("kernel", kernel)}),
          .taps = {.perLight = static_cast<double>(kernel * kernel)}};
}

// comparison: of TiledLighting; the usual one is the hardware's.
ShadowMethod pcss(int search, int kernel, const std::string& comparison = "filtered") {
  const std::string more = comparison == "filtered" ? "" : ", " + comparison;
  return {.name = fmt::format("pcss {}+{}{}", search, kernel, more),
          .lighting = lighting("pcss", {setting("search", search), setting("kernel", kernel),
                                        "comparison=" + comparison}),
          .taps = {.perLight = static_cast<double>(search * search + kernel * kernel)}};
}

// As the pipeline `layered` has it, but for what is named. search: depths along each side, 0: by
// the minimum filter.
struct Layered {
  int kernel = 11, search = 0;
  bool full = false, published = false;
  bool exponential = false, sampled = false;  // values of the mask; penumbrae in the blur
};

std::string nameOf(const Layered& layered) {
  return fmt::format("layered {}{}{}{}{}{}", layered.kernel, layered.search > 0 ? ", search" : "",
                     layered.full ? ", full" : "", layered.published ? ", published" : "",
                     layered.exponential ? ", exponential" : "",
                     layered.sampled ? ", sampled" : "");
}

// Each light is looked up once for the mask. In each pixel of the layers its nearest blocker is
// read, by each axis if nothing is stored, or blockers are searched, and the two axes of the blur
// read the mask and the layers. Of bytes the mask is made and blurred by four layers.
ShadowTaps tapsOf(const Layered& layered) {
  const double share = layered.full ? 1 : 0.25, kernel = layered.kernel;
  const double blockers =
      layered.search > 0 ? layered.search * layered.search : (layered.sampled ? 2 : 1);
  return {.perLight = 1 + share * blockers,
          .perPixel = layered.exponential ? 0 : share * kernel,
          .perFourLayers = layered.exponential ? 2 + 2 * share * kernel : 1 + share * kernel};
}

ShadowMethod layered(const Layered& l) {
  const std::string resolution = l.full ? "resolution=full" : "resolution=half";
  ShadowMethod method{.name = nameOf(l), .lighting = lighting("layered"), .taps = tapsOf(l)};
  method.rows = {{"ShadowLayers", {"layers=32"}}, {"ShadowMask"}, {"ShadowTiles"}};
  if (l.exponential) method.rows[1].settings.push_back("values=exponential");
  if (l.search == 0) method.rows.push_back({"NearestBlockers"});
  const std::vector<std::string> widths =
      l.search > 0 ? std::vector<std::string>{"method=search", setting("search", l.search)}
                   : std::vector<std::string>{"method=minimum"};
  const auto row = [&](const char* pass, std::vector<std::string> settings) {
    settings.push_back(resolution);
    method.rows.push_back({pass, std::move(settings)});
  };
  if (!l.sampled) row("Penumbra", widths);
  row("ShadowBlur", {setting("kernel", l.kernel)});
  if (l.sampled) method.rows.back().settings.push_back("penumbrae=sampled");
  row("LayeredTransmittance", widths);
  method.rows.back().settings.push_back(setting("kernel", l.kernel));
  if (l.published)
    for (const char* pass : {"ShadowLayers", "ShadowMask", "Penumbra", "ShadowBlur"})
      std::ranges::find(method.rows, pass, &Row::pass)->settings.push_back("variant=published");
  return method;
}

const std::vector<ShadowMethod>& methods() {
  static const std::vector<ShadowMethod> all{
      {.name = "lighting alone", .lighting = lighting("none")},
      {.name = "hard", .lighting = lighting("hard", {"comparison=plane"}), .taps = {.perLight = 1}},
      pcf(5),
      pcf(11),
      pcf(23),
      pcss(5, 5),
      pcss(5, 11),
      pcss(5, 23),
      pcss(5, 11, "plane"),
      // A tap for the blockers' mean depth, one for the share that is blocked.
      {.name = "prefiltered",
       .rows = {{"PrefilteredShadows"}},
       .lighting = lighting("prefiltered"),
       .taps = {.perLight = 2}},
      layered({.kernel = 5}),
      layered({.kernel = 11}),
      layered({.kernel = 23}),
      layered({.kernel = 47}),
      layered({.kernel = 5, .full = true}),
      layered({.kernel = 11, .full = true}),
      layered({.kernel = 23, .full = true}),
      layered({.kernel = 11, .search = 5}),
      layered({.kernel = 5, .search = 5, .full = true}),
      layered({.kernel = 11, .search = 5, .full = true}),
      layered({.kernel = 23, .search = 5, .full = true}),
      layered({.kernel = 11, .published = true}),
      layered({.kernel = 11, .exponential = true}),
      layered({.kernel = 11, .sampled = true}),
  };
  return all;
}

}  // namespace

double ShadowTaps::at(double lights, int layers) const {
  const int fours = (layers + 3) / 4;
  return perPixel + perLight * lights + perFourLayers * fours;
}

const ShadowMethod& shadowMethod(std::string_view name) {
  const auto found = std::ranges::find(methods(), name, &ShadowMethod::name);
  CHECK(found != methods().end(), "no method '{}'", name);
  return *found;
}

std::vector<std::string> shadowMethodNames() {
  std::vector<std::string> names;
  for (const ShadowMethod& method : methods()) names.push_back(method.name);
  return names;
}

Chain chainOf(const ShadowMethod& method, const ShadowFrame& frame) {
  Chain chain{{{"Cull"}, {"GBuffer"}}};
  if (method.shadows())
    chain.rows.push_back({"ShadowMaps", {setting("localSize", frame.mapSize), "localLights=256"}});
  chain.rows.push_back({"TileLights"});
  for (Row row : method.rows) {
    if (row.pass == "ShadowLayers") row.settings.push_back("conflicts=" + frame.conflicts);
    chain.rows.push_back(std::move(row));
  }
  chain.rows.push_back(method.lighting);
  chain.rows.insert(chain.rows.end(), frame.afterLighting.begin(), frame.afterLighting.end());
  return chain;
}

}  // namespace lucerna::app::bench
