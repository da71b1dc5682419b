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

// Each light is looked up once for the mask. At half the size, in every fourth pixel: its blockers
// are searched, and the two axes of the blur read the mask and the layers. Lighting reads layers.
ShadowMethod layered(int search, int kernel) {
  const double share = 0.25;
  return {.name = fmt::format("layered {}+{}", search, kernel),
          .rows = {{"ShadowLayers", {"layers=32"}},
                   {"ShadowMask"},
                   {"Penumbra", {setting("search", search)}},
                   {"ShadowBlur", {setting("kernel", kernel)}}},
          .lighting = lighting("layered"),
          .taps = {.perLight = 1 + share * search * search,
                   .perPixel = share * kernel,
                   .perFourLayers = 1 + share * kernel}};
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
      layered(5, 5),
      layered(5, 11),
      layered(5, 23),
      layered(5, 47),
  };
  return all;
}

}  // namespace

double ShadowTaps::at(double lights, int layers) const {
  return perPixel + perLight * lights + perFourLayers * ((layers + 3) / 4);
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
