#include "scene/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lucerna::scene {
namespace {

// The node's place without its scale: the view axis is kept, the others are made square to it.
mat4 withoutScale(const mat4& m) {
  vec3 z = vec3(m[2]);
  z = glm::length(z) > 0.f ? glm::normalize(z) : vec3(0.f, 0.f, 1.f);
  vec3 x = glm::cross(vec3(m[1]), z);
  if (glm::length(x) < 1e-12f)
    x = glm::cross(std::abs(z.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0), z);
  x = glm::normalize(x);
  return mat4(vec4(x, 0.f), vec4(glm::cross(z, x), 0.f), vec4(z, 0.f), vec4(vec3(m[3]), 1.f));
}

struct DepthRange {
  float near, far;  // m along the view axis; near is negative when the box reaches behind the eye
};

DepthRange depthRange(const mat4& viewFromWorld, const Aabb& box) {
  if (box.empty()) return {0.f, 1000.f};
  const Aabb inView = transformed(viewFromWorld, box);
  return {-inView.max.z, -inView.min.z};
}

// near and far where the camera leaves them open. Reversed float depth forgives a near plane that
// is very close, so it only has to be in front of what can be seen.
void chooseDepth(View& view, const Camera& camera, const Aabb& box) {
  const DepthRange range = depthRange(view.viewFromWorld, box);
  const float size = std::max(box.diagonal(), 1e-3f);
  view.far = camera.far > 0.f ? camera.far : std::max(1.01f * range.far, 0.01f * size);
  if (camera.orthographic || camera.near > 0.f) {
    view.near = camera.near;
  } else {
    const float close = 1e-4f * std::min(size, std::isinf(view.far) ? size : view.far);
    view.near = std::max(close, 0.5f * range.near);
  }
  if (!(view.far > view.near)) view.far = view.near + size;
}

// p' = p - 2 (n.p + d) n
mat4 reflectionIn(const vec4& planeW) {
  const vec3 n(planeW);
  mat4 m(1.f);
  for (int column = 0; column < 4; ++column) m[column] -= vec4(2.f * planeW[column] * n, 0.f);
  return m;
}

// The far plane beyond all that is up to `far` metres ahead, the picture the same.
void seeAll(View& view, float far) {
  view.far = view.orthographic ? std::max(view.far, far) : std::numeric_limits<float>::infinity();
  const float near = view.near;
  view.clipFromView[2].z = view.orthographic ? 1.f / (view.far - near) : 0.f;
  view.clipFromView[3].z = view.orthographic ? view.far / (view.far - near) : near;
}

}  // namespace

View viewOf(const Scene& scene, const Camera& camera, float aspect) {
  View view;
  view.orthographic = camera.orthographic;
  view.worldFromView =
      withoutScale(camera.node == kNone ? mat4(1.f) : scene.nodes[camera.node].worldFromNode);
  view.viewFromWorld = glm::inverse(view.worldFromView);
  chooseDepth(view, camera, scene.boundsW());

  // An output narrower than the camera's own frame keeps the frame's width, so that nothing the
  // camera was meant to show is cut off.
  const float widen = camera.aspect > aspect ? camera.aspect / aspect : 1.f;
  if (camera.orthographic) {
    const float top = 0.5f * camera.height * widen;
    const float right = top * aspect;
    view.clipFromView = orthographicReversed(-right, right, -top, top, view.near, view.far);
  } else {
    const float fovY = 2.f * std::atan(std::tan(0.5f * camera.fovY) * widen);
    view.clipFromView = perspectiveReversed(fovY, aspect, view.near, view.far);
  }
  return view;
}

// A point x to the right at distance d is at p00 x / d in clip space; seen from the eye it must be
// p00 (x - offset) / d - p20, so that p20 = -p00 offset / d. Orthographic views come out the same.
View eyeView(const View& view, float offset, float convergence) {
  CHECK(convergence > 0.f, "eyes that converge {} m ahead", convergence);
  View eye = view;
  eye.worldFromView[3] += view.worldFromView[0] * offset;
  eye.viewFromWorld = glm::inverse(eye.worldFromView);
  eye.clipFromView[2].x -= view.clipFromView[0].x * offset / convergence;
  return eye;
}

View reflectedView(const View& view, vec4 planeW, float clearance, const Aabb& boundsW) {
  const mat4 reflection = reflectionIn(planeW);
  View reflected = view;
  reflected.viewFromWorld = view.viewFromWorld * reflection;
  reflected.worldFromView = reflection * view.worldFromView;
  reflected.clipPlaneW = planeW - vec4(0.f, 0.f, 0.f, clearance);
  seeAll(reflected, 1.01f * depthRange(reflected.viewFromWorld, boundsW).far);
  return reflected;
}

}  // namespace lucerna::scene
