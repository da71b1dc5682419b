// Small scenes for the tests of trace/.
#pragma once

#include "scene/scene.hpp"
#include "scene/view.hpp"

namespace lucerna::trace::testing {

// Nothing but a camera at the origin that looks along -z, and a black background.
scene::Scene emptyScene();
scene::View viewOf(const scene::Scene& scene, uvec2 size);

// White, Lambertian, both sides.
scene::Material& addMaterial(scene::Scene& scene);
// A square with corners center +- a +- b; its front is where cross(a, b) points. Material: the
// last.
void addSquare(scene::Scene& scene, vec3 center, vec3 a, vec3 b);
// The i-th of several panes that differ, as the last material: what it lets through.
vec3 addPane(scene::Scene& scene, int i);
// A light at a place, shining along a direction.
scene::Light& addLight(scene::Scene& scene, scene::LightKind kind, vec3 at, vec3 along);

}  // namespace lucerna::trace::testing
