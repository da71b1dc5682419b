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

ShadowMethod pcss(int search, int kernel) {
  return {.name = fmt::format("pcss {}+{}", search, kernel),
          .lighting = lighting("pcss", {setting("search", search), setting("kernel", kernel)}),
          .taps = {.perLight = static_cast<double>(search * search + kernel * kernel)}};
}

// As the pipeline `layered` has it, but for what is named. search: depths along each side, 0: by
// the minimum filter.
struct Layered {
  int kernel = 11, search = 0;
  bool full = false, published = false;
};

std::string nameOf(const Layered& layered) {
  return fmt::format("layered {}{}{}{}", layered.kernel, layered.search > 0 ? ", search" : "",
                     layered.full ? ", full" : "", layered.published ? ", published" : "");
}

// Each light is looked up once for the mask. In each pixel of the layers its nearest blocker is
// read or blockers are searched, and the two axes of the blur read the mask and the layers.
ShadowTaps tapsOf(const Layered& layered) {
  const double share = layered.full ? 1 : 0.25, kernel = layered.kernel;
  const double blockers = layered.search > 0 ? layered.search * layered.search : 1;
  return {.perLight = 1 + share * blockers,
          .perPixel = share * kernel,
          .perFourLayers = 1 + share * kernel};
}

ShadowMethod layered(const Layered& l) {
  const std::string resolution = l.full ? "resolution=full" : "resolution=half";
  ShadowMethod method{.name = nameOf(l), .lighting = lighting("layered"), .taps = tapsOf(l)};
  method.rows = {{"ShadowLayers", {"layers=32"}}, {"ShadowMask"}, {"ShadowTiles"}};
  if (l.search == 0) method.rows.push_back({"NearestBlockers"});
  const std::vector<std::string> widths =
      l.search > 0 ? std::vector<std::string>{"method=search", setting("search", l.search)}
                   : std::vector<std::string>{"method=minimum"};
  std::vector<std::string> panes = widths;
  panes.push_back(setting("kernel", l.kernel));
  method.rows.push_back({"Penumbra", widths});
  method.rows.push_back({"ShadowBlur", {setting("kernel", l.kernel)}});
  method.rows.push_back({"LayeredTransmittance", panes});
  for (const char* pass : {"Penumbra", "ShadowBlur", "LayeredTransmittance"})
    std::ranges::find(method.rows, pass, &Row::pass)->settings.push_back(resolution);
  if (l.published)
    for (const char* pass : {"ShadowLayers", "ShadowMask", "Penumbra", "ShadowBlur"})
      std::ranges::find(method.rows, pass, &Row::pass)->settings.push_back("variant=published");
  return method;
}

const std::vector<ShadowMethod>& methods() {
  static const std::vector<ShadowMethod> all{
      {.name = "lighting alone", .lighting = lighting("none")},
      {.name = "hard", .lighting = lighting("hard"), .taps = {.perLight = 1}},
      pcf(5),
      pcf(11),
      pcf(23),
      pcss(5, 5),
      pcss(5, 11),
      pcss(5, 23),
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
  if (method.shadows()) chain.rows.push_back({"ShadowMaps", {setting("localSize", frame.mapSize)}});
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
