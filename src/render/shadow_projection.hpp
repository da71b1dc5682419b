// Projections for shadow maps: a light's view, focused on what the cameras' views can see of the
// scene. No GL.
#pragma once

#include <span>
#include <vector>

#include "scene/bvh.hpp"
#include "scene/view.hpp"

namespace lucerna::render {

// Light-space depth is reversed: 1 nearest to the light. The light's view space is rigid: metres.
struct ShadowProjection {
  mat4 viewFromWorld{1.f}, clipFromView{1.f};
  // What a row and a column of the map cover, in m, at a point of clip-space w: of lamps x * w
  // both; of directional lights x * w and y * w * w, and a step of the latter leads aside by up to
  // `shear` of its length, for columns of a warped map are not parallel.
  vec2 side{0.f};
  float shear = 0.f;
  // Part of the map, from its middle, that it is made for; the rest is for filters.
  float inner = 1.f;
  bool warped = false;     // of directional lights: columns are not parallel
  float depthRange = 0.f;  // m, of directional lights
  // Of directional lights, the depth that the map holds: dot(xyz, positionW) + w. Under a warp that
  // of clip space is not linear along the map, so that a wide texel holds the depths of other
  // distances: at the far end of a city metres of them.
  vec4 depthPlaneW{0.f};

  mat4 clipFromWorld() const { return clipFromView * viewFromWorld; }
  bool operator==(const ShadowProjection&) const = default;
};

// Several views that share maps, as one viewer: the mean of what they are.
struct Viewer {
  vec3 positionW{0.f};
  vec3 forwardW{0.f, 0.f, -1.f};  // unit
  vec3 upW{0.f, 1.f, 0.f};        // unit
};
Viewer viewerOf(std::span<const scene::View> views);

// Corners of all that the views see of the box: the union of their frusta cut off by it and by
// further planes (inward, as of core/math/convex_body.hpp). Empty if they see nothing of it.
std::vector<vec3> visibleBody(std::span<const scene::View> views, const Aabb& boxW,
                              std::span<const vec4> furtherPlanes = {});

// Points that the views probably show: where rays all over them enter the first object's box or
// leave one that they start in, as a room.
std::vector<vec3> visibleSamples(std::span<const scene::View> views, const scene::Bvh& bvh);

// The strength of a warp, d / n in the terms of light-space perspective shadow maps: d the body's
// depth along the view in light space, n the distance of the warp's centre before it. 0: none, a
// uniform map, also without samples. At most what the paper finds for a view across the light whose
// nearest point is that of the samples; it falls to 0 as light and view become parallel. Less where
// the geometric mean of the areas that texels cover at the samples is then smaller. (Where light
// and view are nearly in line the view spreads to all sides: the paper's warp would favour one of
// them.)
float automaticWarp(vec3 directionW, std::span<const vec3> bodyW, std::span<const vec3> samplesW,
                    const Viewer& viewer);

// Of a directional light that shines along directionW (unit) onto the body, past casters in their
// box. With a warp: Wimmer, Scherzer and Purgathofer, "Light Space Perspective Shadow Maps", EGSR
// 2004. margin: share of the map's side that stays free at each edge, for filters.
ShadowProjection directionalProjection(vec3 directionW, std::span<const vec3> bodyW,
                                       const Aabb& castersW, const Viewer& viewer, float warp,
                                       float margin);

// A square pyramid of light from a point.
struct LightPyramid {
  vec3 positionW{0.f};
  vec3 axisW{0.f, 0.f, -1.f};  // unit
  float tangent = 1.f;         // of the angle between the axis and a side
  float reach = 1.f;           // m along the axis; may be infinite
  float near = 0.f;            // m along the axis: nothing nearer is in the map
};

// Corners of what the views see of the box inside the pyramid; empty if that is nothing.
std::vector<vec3> litBody(const LightPyramid& pyramid, std::span<const scene::View> views,
                          const Aabb& boxW);

// Cropped to the body. margin: as of directionalProjection().
ShadowProjection localProjection(const LightPyramid& pyramid, std::span<const vec3> bodyW,
                                 float margin);

}  // namespace lucerna::render
