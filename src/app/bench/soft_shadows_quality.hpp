// What the suite soft-shadows-quality measures, for its report.
#pragma once

#include <string>
#include <vector>

#include "app/bench/report.hpp"
#include "app/bench/results.hpp"
#include "scene/builtin/penumbra.hpp"

namespace lucerna::app::bench::quality {

// Methods (shadow_methods.hpp).
inline const std::string kAlone = "lighting alone", kPcss = "pcss 5+11", kLayered = "layered 11";
inline const std::vector<std::string> kMethods{"hard",
                                               "pcf 5",
                                               kPcss,
                                               "pcss 5+11, plane",
                                               "prefiltered",
                                               kLayered,
                                               "layered 11, search",
                                               "layered 11, full",
                                               "layered 11, published",
                                               "layered 11, exponential",
                                               "layered 11, sampled"};
// The reference once more, with other random numbers: what the comparison itself is worth.
inline const std::string kNoise = "reference";

inline const std::string kHall = "atrium, 16 lights", kManyLights = "atrium, 64 lights",
                         kMoving = "atrium, a tenth moves";
// A scene of builtin:penumbra, whose penumbrae are known.
struct KnownScene {
  std::string name, query;
  scene::builtin::PenumbraOptions options;
};
const std::vector<KnownScene>& knownScenes();
inline const std::string kExponents = "half-plane";  // where lights change their size

// Values in %, against the closed form.
inline constexpr const char *kWidths = "width_error", *kPaneWidths = "pane_width_error";

inline constexpr int kNearEdge = 3;         // px, see nearDepthEdges()
int tracedSamples(const Results& results);  // a pixel of the reference

std::vector<std::string> allMethods();  // kAlone and kMethods

// Measurements are named by method and scene.
std::vector<Block> report(const Results& results);

}  // namespace lucerna::app::bench::quality
