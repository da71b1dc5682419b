// What surfaces do with light: the formulas of docs/dev/materials-and-light.md, worked out apart
// from the shaders.
#pragma once

#include "trace/material_lookup.hpp"

namespace lucerna::trace {

// Radiance towards the eye for unit irradiance on a surface that faces the light: f(l, v) with the
// cosine inside. 0 where the light stands behind the shading normal.
vec3 reflected(const SurfacePoint& point, vec3 toLightW);

// Share of the light from all around that goes on as diffuse light.
vec3 diffuseAlbedo(const SurfacePoint& point);
// The same of ambient light, which counts as diffuse what a highlight would reflect.
vec3 ambientAlbedo(const SurfacePoint& point);

}  // namespace lucerna::trace
