// builtin:cornell, the Cornell box in the measures of ../shared's cornell_boxes (about 2 m a side).
// Goral et al., "Modeling the Interaction of Light Between Diffuse Surfaces", SIGGRAPH 1984;
// measured data of the Cornell Program of Computer Graphics, 1998.
//
// Materials are called as in CornellBox-Original.mtl. The lamp's surface shines as its Ke says; a
// spot light gives what such a surface sends out: a disc of the same area, of intensity Ke * area *
// cos.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

struct CornellOptions {
  bool boxes = true;    // false: the empty box
  float ambient = 0.f;  // stands in for interreflection where nothing computes it
};

Scene makeCornell(const CornellOptions& options);

}  // namespace lucerna::scene::builtin
