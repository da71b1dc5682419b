// Projections for shadow maps: a light's view, focused on what the cameras' views can see of the
// scene. No GL.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/view.hpp"

namespace lucerna::render {

// Light-space depth is reversed: 1 nearest to the light. The light's view space is rigid, so that
// its depth is in metres before projection.
struct ShadowProjection {
  mat4 viewFromWorld{1.f}, clipFromView{1.f};
  // What the map's whole side covers, in m, at a point of clip-space w: max(x * w, y * w * w).
  vec2 side{0.f};

  mat4 clipFromWorld() const { return clipFromView * viewFromWorld; }
};

// Several views that share maps, as one viewer: the mean of what they are.
struct Viewer {
  vec3 positionW{0.f};
  vec3 forwardW{0.f, 0.f, -1.f};  // unit
  vec3 upW{0.f, 1.f, 0.f};        // unit
  float near = 0.1f;              // m
  bool orthographic = false;
};
Viewer viewerOf(std::span<const scene::View> views);

// Corners of all that the views see of the box: the union of their frusta cut off by it and by
// further planes (inward, as of core/math/convex_body.hpp). Empty if they see nothing of it.
std::vector<vec3> visibleBody(std::span<const scene::View> views, const Aabb& boxW,
                              std::span<const vec4> furtherPlanes = {});

// d / n of light-space perspective shadow maps: d the body's depth along the view in light space, n
// the distance of the warp's centre before it. 0: none, a uniform map; it falls to 0 continuously
// as light and view become parallel. Wimmer, Scherzer and Purgathofer, "Light Space Perspective
// Shadow Maps", EGSR 2004, section 4.2: n = (z_n + sqrt(z_n z_f)) / sin(gamma).
float automaticWarp(vec3 directionW, std::span<const vec3> bodyW, const Viewer& viewer);

// Of a directional light that shines along directionW (unit) onto the body, past casters in their
// box. margin: share of the map's side that stays free at each edge, for filters.
ShadowProjection directionalProjection(vec3 directionW, std::span<const vec3> bodyW,
                                       const Aabb& castersW, const Viewer& viewer, float warp,
                                       float margin);

// A square pyramid of light from a point.
struct LightPyramid {
  vec3 positionW{0.f};
  vec3 axisW{0.f, 0.f, -1.f};  // unit
  float tangent = 1.f;         // of the angle between the axis and a side
  float reach = 1.f;           // m along the axis; may be infinite
};

// Cropped to what the views see of the box inside the pyramid; none if that is nothing.
std::optional<ShadowProjection> localProjection(const LightPyramid& pyramid,
                                                std::span<const scene::View> views,
                                                const Aabb& boxW, float margin);

}  // namespace lucerna::render
