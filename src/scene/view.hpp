// A camera where it stands, for one picture.
#pragma once

#include <optional>

#include "core/math/frustum.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

struct View {
  mat4 viewFromWorld{1.f};
  mat4 clipFromView{1.f};  // reversed depth, clip z in [0, w]
  mat4 worldFromView{1.f};
  float near = 0.1f, far = 1000.f;  // m; far may be infinity
  bool orthographic = false;
  // Of what a mirror shows (reflectedView()): nothing is seen where dot(clipPlaneW, (p, 1)) < 0.
  std::optional<vec4> clipPlaneW = std::nullopt;

  mat4 clipFromWorld() const { return clipFromView * viewFromWorld; }
  vec3 positionW() const { return vec3(worldFromView[3]); }
  // (position, 1); of an orthographic view (unit vector towards the eye, 0).
  vec4 eyeW() const {
    return orthographic ? vec4(glm::normalize(vec3(worldFromView[2])), 0.f)
                        : vec4(positionW(), 1.f);
  }
  // It shows the world as its mirror image: front faces are clockwise.
  bool mirrored() const { return glm::determinant(mat3(viewFromWorld)) < 0.f; }
  Frustum frustumW() const { return frustumOf(clipFromWorld()); }
};

// The view of a scene's camera for an output of the given aspect (width / height). The node's scale
// is taken out. near/far of 0 are chosen from the scene's box and the camera's place in it.
View viewOf(const Scene& scene, const Camera& camera, float aspect);

// The same from an eye `offset` metres to the right of the camera that looks the same way, through
// an off-axis frustum: what is `convergence` metres ahead stays where it is in the picture, nearer
// things move against the offset, farther ones with it. Offset 0 gives the same view, bit for bit.
View eyeView(const View& view, float offset, float convergence);

// What a mirror in the plane shows of the world, in the pixels where the view shows the mirror: the
// eye stands behind the plane, at its mirror image. planeW: a unit normal towards the view's eye
// and the distance. What is less than `clearance` metres before the plane is not seen. It sees as
// far as the box of all that there is, a perspective view without end.
View reflectedView(const View& view, vec4 planeW, float clearance, const Aabb& boundsW);

}  // namespace lucerna::scene
