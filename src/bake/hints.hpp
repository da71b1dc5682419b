// What a scene says about its baking (scene/bake_hints.hpp), where nothing else was asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/plan.hpp"

namespace lucerna::bake {

// What was asked for; the scene's hints count for the rest.
struct Asked {
  std::optional<int> side;                         // texels along a side of a map
  std::optional<float> patchTolerance;             // as BakeSettings::patchTolerance
  std::optional<std::vector<std::string>> groups;  // as BakeSettings::groups
};

// `settings` with both. Error (ErrorKind::Usage): the hints leave nothing to bake.
Result<BakeSettings> withHints(BakeSettings settings, const Asked& asked,
                               const scene::Scene& scene);

}  // namespace lucerna::bake
