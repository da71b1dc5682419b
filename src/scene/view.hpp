// A camera where it stands, for one picture.
#pragma once

#include "core/math/frustum.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

struct View {
  mat4 viewFromWorld{1.f};
  mat4 clipFromView{1.f};  // reversed depth, clip z in [0, w]
  mat4 worldFromView{1.f};
  float near = 0.1f, far = 1000.f;  // m; far may be infinity
  bool orthographic = false;

  mat4 clipFromWorld() const { return clipFromView * viewFromWorld; }
  vec3 positionW() const { return vec3(worldFromView[3]); }
  Frustum frustumW() const { return frustumOf(clipFromWorld()); }
};

// The view of a scene's camera for an output of the given aspect (width / height). The node's scale
// is taken out. near/far of 0 are chosen from the scene's box and the camera's place in it.
View viewOf(const Scene& scene, const Camera& camera, float aspect);

// The same from an eye `offset` metres to the right of the camera that looks the same way, through
// an off-axis frustum: what is `convergence` metres ahead stays where it is in the picture, nearer
// things move against the offset, farther ones with it. Offset 0 gives the same view, bit for bit.
View eyeView(const View& view, float offset, float convergence);

}  // namespace lucerna::scene
