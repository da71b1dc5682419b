// What --lightmap brings to a scene: its places in the maps, and the maps.
#pragma once

#include <string>
#include <vector>

#include "app/settings.hpp"
#include "image/image.hpp"
#include "lightmap/lightmap.hpp"
#include "scene/scene.hpp"

namespace lucerna::app {

// Reads settings.lightmap, gives the scene's objects their places and switches off the lights whose
// light is in the maps; the scene stands as at 0 s, as it was baked, and what has moved since is
// warned of. The lights' ambient share stays, unless settings.lightsOff names their group.
// Returns the maps (F32 RGB irradiance), without the groups that settings.lightsOff names or of
// which the scene has no light on. Errors: ErrorKind::Input where the folder is damaged or of
// another scene, ErrorKind::Usage for groups it does not know.
Result<std::vector<Image>> takeBakedLight(scene::Scene& scene, const RenderSettings& settings);

}  // namespace lucerna::app
