// builtin:penumbra, occluders whose penumbrae are known in closed form (options in builtin.hpp).
//
// Every light is a spot light, and so a disc of radius r across its axis; occluders are flat sheets
// without thickness, and a round pole. A receiver's point is in the penumbra of an edge if part of
// the disc is hidden by it: between the two lines that touch the edge and the disc's rim.
//
// Seen along a straight edge, the disc is the segment of its two outermost points P1 and P2 (axis
// across the edge) or a circle (axis along the edge). The penumbra on the receiver lies between the
// points where the lines P1-E and P2-E meet it; for a circle these are its tangents through E. With
// the light at height H, its disc level, and an edge at height h over a level floor, similar
// triangles give the line from (x_P, H) through (x_E, h) at
//
//   x = x_E + (x_E - x_P) h / (H - h),
//
// so that the width is 2 r h / (H - h): the light's diameter times (d_receiver - d_blocker) /
// d_blocker with the vertical distances d_receiver = H and d_blocker = H - h. All of this is exact
// for edges that reach beyond the rays concerned, as here.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace lucerna::scene::builtin {

struct PenumbraOptions {
  enum class Case { HalfPlane, Cards, Fence, Pole, Grazing, Panes, Overlap };
  Case which = Case::HalfPlane;
  std::uint32_t lights = 4;  // of Overlap, 1 to 32
};

// The way across one edge's penumbra on a receiver.
struct PenumbraEdge {
  std::string name;         // "card 2, left"
  std::uint32_t light = 0;  // index in Scene::lights
  vec3 litW{0.f};           // from here on the edge hides nothing of the disc
  vec3 darkW{0.f};          // from here on all of it
  // What reaches both ends of the light: 1, and 0 behind a card.
  vec3 litTransmittance{1.f}, darkTransmittance{0.f};
  float width() const { return glm::distance(litW, darkW); }  // m
};

Scene makePenumbra(const PenumbraOptions& options);
// Of the same scene; in world space, no GL.
std::vector<PenumbraEdge> expectedPenumbrae(const PenumbraOptions& options);

}  // namespace lucerna::scene::builtin
