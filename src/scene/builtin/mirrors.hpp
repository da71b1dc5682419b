// builtin:mirrors, a room with planar mirrors (options in builtin.hpp).
//
// Metres: the room is x from -4 to 4, y from 0 to 3.2, z from -3 to 3. The main mirror hangs on the
// wall z = -3; two mirrors face each other on the side walls, one leans in a corner, and a pool in
// the floor reflects partly.
//
// With `twin` there is an opening instead of the main mirror, and behind it the room again, built
// as a mirror image with lights of its own: what a perfect mirror must show. No light of one room
// reaches the other (there are no shadows to stop it): each is either too far from the plane for
// its range, or its cone points away from it.
#pragma once

#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

struct MirrorsOptions {
  bool twin = false;
  bool single = false;  // only the main mirror reflects: what `twin` is to be compared with
};

inline constexpr float kMirrorPlane = -3.f;  // z of the main mirror

Scene makeMirrors(const MirrorsOptions& options);

}  // namespace lucerna::scene::builtin
