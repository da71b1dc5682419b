// What tests of shadow maps' readers share: a half-plane's edge, and the maps of its light.
#pragma once

#include "passes/shadow_maps/shadow_maps.hpp"
#include "support/testing.hpp"

namespace lucerna::testing {

constexpr float kHalfPlaneWall = 6.f;  // m before the camera
constexpr float kLampX = -1.f;         // m; the half-plane's edge is at 0, half way to the wall

// A spot lamp beside the camera, a half-plane between it and a wall: two depths in its map, and a
// straight edge. radius: of the lamp, m.
inline scene::Scene halfPlane(float radius) {
  scene::Scene scene = emptyScene();
  addWall(scene, kHalfPlaneWall);
  addBox(scene, {-20, 0, -0.5f * kHalfPlaneWall}, {40, 40, 1e-3f});
  scene::Light light;
  light.kind = scene::LightKind::Spot;
  light.intensity = 100.f;
  light.radius = radius;
  light.outerCone = 1.f;
  addLight(scene, light, {kLampX, 0.5f, 0}, {kLampX, 0.5f, -kHalfPlaneWall});
  updateTransforms(scene);
  return scene;
}

// Maps for what the renderer drew last.
inline render::ShadowMaps mapsFor(const SceneRenderer& renderer,
                                  const passes::ShadowMaps::Params& params) {
  graph::PassContext context{.device = device()};
  const render::ViewGroup views{{renderer.view.view}};
  render::ShadowMaps maps;
  passes::ShadowMaps::Ports ports;
  ports.scene.bind(&renderer.gpuScene);
  ports.lights.bind(&renderer.lights);
  ports.views.bind(&views);
  ports.shadowMaps.bind(&maps);
  passes::ShadowMaps(device()).execute(context, params, ports);
  return maps;
}

}  // namespace lucerna::testing
