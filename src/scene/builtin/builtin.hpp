// Scenes made by code: no files needed, the same on every machine and for any number of threads.
//
// builtin:atrium     a colonnaded hall of two storeys, about 60,000 triangles
//   lights=16        0 to 4096, coloured, spread through the hall, reaches overlap
//   kind=spot        or point
//   moving=0         the share (0 to 1) of the objects other than the building that is animated
//   glass=0          1 adds translucent coloured panes
//   seed=1
//
// builtin:cornell    the Cornell box with its lamp
//   boxes=1          0: empty
//   ambient=0        0 to 1, where nothing computes interreflection
//
// builtin:materials  five cubes on a floor, one for each special material; no options
//
// builtin:mirrors    a room with planar mirrors, two of them face to face, one in part
//   twin=0           1: instead of the main mirror the room's mirror image, built
//   single=0         1: only the main mirror reflects, as to compare with twin=1
//
// builtin:nightcity  a city at night: about 40,000 triangles on 4 km^2, 106 lamps (13 switchable)
//   blocks=8         6 to 64 blocks a side, 250 m each; more than 16 are modelled finer
//   rotate=0         degrees about the vertical
//   jitter=0         0 to 1: how far single buildings turn away from the street
//   sun=E,A          adds a sun: elevation 0 to 90, azimuth in degrees (0: from -z, 90: from +x)
//   lamps=1          0: switched off
//   seed=1
//
// builtin:penumbra   occluders whose penumbrae are known in closed form (penumbra.hpp)
//   case=half-plane  or cards, fence, pole, grazing, panes, overlap
//   k=4              of overlap: 1 to 32 lights
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// "builtin:NAME" or "builtin:NAME?key=value&...". Errors (ErrorKind::Input) name what was unknown
// or out of range and what is wanted. World transforms and bounds are up to date; complete() has
// not been called.
Result<Scene> makeBuiltin(const std::string& spec);
std::vector<std::string> builtinNames();

}  // namespace lucerna::scene
