#include "render/shadow_projection.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/convex_body.hpp"

namespace lucerna::render {
namespace {

// The near plane of a lamp's map, in parts of its far plane's distance: reversed float depth
// forgives it.
constexpr float kNearShare = 1e-6f;

struct Range {
  float low = std::numeric_limits<float>::infinity(),
        high = -std::numeric_limits<float>::infinity();
  void grow(float value) { low = std::min(low, value), high = std::max(high, value); }
  float length() const { return high - low; }
};

Range along(vec3 axis, std::span<const vec3> points) {
  Range range;
  for (const vec3& point : points) range.grow(glm::dot(axis, point));
  return range;
}

vec3 anyAcross(vec3 axis) {
  const vec3 other = std::abs(axis.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
  return glm::normalize(glm::cross(axis, other));
}

vec3 normalizedOr(vec3 v, vec3 otherwise) {
  const float length = glm::length(v);
  return length > 1e-4f ? v / length : otherwise;
}

// The view direction as the light sees it: what the map's second axis follows. In line with the
// light it is the limit of what it is where the light comes from a little above.
vec3 acrossLight(vec3 toLightW, const Viewer& viewer) {
  const auto across = [&](vec3 v) { return v - glm::dot(v, toLightW) * toLightW; };
  const vec3 up = glm::dot(viewer.forwardW, toLightW) < 0.f ? viewer.upW : -viewer.upW;
  return normalizedOr(across(viewer.forwardW), normalizedOr(across(up), anyAcross(toLightW)));
}

// Rows: unit axes of the space.
mat4 spaceOf(vec3 right, vec3 up, vec3 back, vec3 origin) {
  const mat3 axes = glm::transpose(mat3(right, up, back));
  mat4 result(axes);
  result[3] = vec4(-(axes * origin), 1.f);
  return result;
}

}  // namespace

Viewer viewerOf(std::span<const scene::View> views) {
  Viewer viewer{.forwardW = vec3(0.f), .upW = vec3(0.f)};
  for (const scene::View& view : views) {
    viewer.positionW += view.positionW() / static_cast<float>(views.size());
    viewer.forwardW -= vec3(view.worldFromView[2]);
    viewer.upW += vec3(view.worldFromView[1]);
  }
  viewer.forwardW = normalizedOr(viewer.forwardW, {0.f, 0.f, -1.f});
  viewer.upW = normalizedOr(viewer.upW, {0.f, 1.f, 0.f});
  return viewer;
}

std::vector<vec3> visibleBody(std::span<const scene::View> views, const Aabb& boxW,
                              std::span<const vec4> furtherPlanes) {
  std::vector<vec3> body;
  for (const scene::View& view : views) {
    std::vector<vec4> planes = planesOf(boxW);
    const Frustum frustum = view.frustumW();
    planes.insert(planes.end(), frustum.planes.begin(), frustum.planes.end());
    planes.insert(planes.end(), furtherPlanes.begin(), furtherPlanes.end());
    const std::vector<vec3> corners = cornersOf(planes);
    body.insert(body.end(), corners.begin(), corners.end());
  }
  return body;
}

std::vector<vec3> visibleSamples(std::span<const scene::View> views, const scene::Bvh& bvh) {
  constexpr int kSide = 9;
  std::vector<vec3> samples;
  for (const scene::View& view : views) {
    const mat4 worldFromClip = glm::inverse(view.clipFromWorld());
    for (int pixel = 0; pixel < kSide * kSide; ++pixel) {
      const vec2 ndc = (2.f * vec2(pixel % kSide, pixel / kSide) + 1.f) / float(kSide) - 1.f;
      const vec4 onNear = worldFromClip * vec4(ndc, 1.f, 1.f);
      const vec4 beyond = worldFromClip * vec4(ndc, 0.5f, 1.f);
      const vec3 from = vec3(onNear) / onNear.w;
      const vec3 direction = glm::normalize(vec3(beyond) / beyond.w - from);
      const float distance = bvh.firstSide(from, direction);
      if (std::isfinite(distance)) samples.push_back(from + distance * direction);
    }
  }
  return samples;
}

namespace {

// EGSR 2004, section 4.2: n = (z_n + sqrt(z_n z_f)) / sin(gamma), z_f = z_n + d sin(gamma).
float warpOfThePaper(float depth, float sine, float zn) {
  const float zf = zn + depth * sine;
  return zn > 0.f ? depth * sine / (zn + std::sqrt(zn * zf)) : 0.f;
}

// What nearly all of the points lie behind.
float nearestOf(std::vector<float> distances) {
  if (distances.empty()) return 0.f;
  const auto tenth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 10);
  std::ranges::nth_element(distances, tenth);
  return *tenth;
}

// The warp from 0 to `most` for which a texel's area has the least geometric mean over the samples.
// In the terms of directionalProjection() a texel at t covers, up to a factor,
// half(warp) w^3 / (1 + warp).
float warpOfSmallestTexels(float most, std::span<const vec2> body, std::span<const float> samples) {
  const auto logArea = [&](float warp) {
    Range width;
    for (const vec2& point : body) width.grow(point.x / (1.f + warp * point.y));
    double sum = 0;
    for (const float t : samples) sum += std::log1p(warp * t);
    return std::log(width.length()) - std::log1p(warp) +
           3. * sum / static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  };
  // Golden sections of the logarithm of 1 + warp.
  constexpr float kGolden = 0.61803399f;
  float low = 0.f, high = std::log1p(most);
  for (int i = 0; i < 20; ++i) {
    const float a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (logArea(std::expm1(a)) <= logArea(std::expm1(b))) {
      high = b;
    } else {
      low = a;
    }
  }
  return low == 0.f ? 0.f : std::expm1(0.5f * (low + high));
}

}  // namespace

float automaticWarp(vec3 directionW, std::span<const vec3> bodyW, std::span<const vec3> samplesW,
                    const Viewer& viewer) {
  const vec3 up = acrossLight(-directionW, viewer), right = glm::cross(up, -directionW);
  const Range length = along(up, bodyW);
  const auto shareOf = [&](vec3 point) {
    return (glm::dot(up, point) - length.low) / std::max(length.length(), 1e-20f);
  };
  std::vector<vec2> body;
  for (const vec3& point : bodyW)
    body.emplace_back(glm::dot(right, point - viewer.positionW), shareOf(point));
  std::vector<float> samples, distances;
  for (const vec3& point : samplesW) {
    samples.push_back(std::max(shareOf(point), 0.f));
    distances.push_back(glm::dot(viewer.forwardW, point - viewer.positionW));
  }
  const float sine = glm::length(glm::cross(directionW, viewer.forwardW));
  const float most = warpOfThePaper(length.length(), sine, nearestOf(std::move(distances)));
  return warpOfSmallestTexels(most, body, samples);
}

// With t from 0 to 1 along the body and w = 1 + warp t, the second axis maps to
// u = t (1 + warp) / w, which is t without warp, and the first is divided by w. This is the
// perspective of the paper with n = 1 / warp bodies, written so that n may be infinite. Rays of
// light keep their t, so along each of them depth stays linear.
ShadowProjection directionalProjection(vec3 directionW, std::span<const vec3> bodyW,
                                       const Aabb& castersW, const Viewer& viewer, float warp,
                                       float margin) {
  const vec3 back = -directionW;  // towards the light
  const vec3 up = acrossLight(back, viewer), right = glm::cross(up, back);
  ShadowProjection result{.viewFromWorld = spaceOf(right, up, back, viewer.positionW)};
  std::vector<vec3> body;
  for (const vec3& point : bodyW) body.emplace_back(result.viewFromWorld * vec4(point, 1.f));

  const float least = 1e-4f * std::max(castersW.diagonal(), 1e-3f);
  const Range length = along({0, 1, 0}, body);
  const float depth = std::max(length.length(), least);
  Range width, height;
  for (const vec3& point : body) {
    width.grow(point.x / (1.f + warp * (point.y - length.low) / depth));
    height.grow(point.z - least);
  }
  height.grow(transformed(result.viewFromWorld, castersW).max.z + least);
  const float half = std::max(0.5f * width.length(), least);
  const float middle = 0.5f * (width.low + width.high);
  const float inner = 1.f - 2.f * margin;

  // w = offset + slope * y
  const float slope = warp / depth, offset = 1.f - slope * length.low;
  mat4& clip = result.clipFromView = mat4(0.f);
  clip[1].w = slope;
  clip[3].w = offset;
  clip[0].x = inner / half;
  clip[1].x = -inner * middle * slope / half;
  clip[3].x = -inner * middle * offset / half;
  clip[1].y = inner * (2.f * (1.f + warp) / depth - slope);
  clip[3].y = inner * (-2.f * (1.f + warp) * length.low / depth - offset);
  clip[2].z = 1.f / height.length();
  clip[3].z = -height.low / height.length();
  result.side = vec2(2.f * half, depth / (1.f + warp)) / inner;
  result.inner = inner;
  result.warped = warp > 0.f;
  result.depthRange = height.length();
  result.shear = slope * std::max(std::abs(width.low), std::abs(width.high));
  result.depthPlaneW = glm::transpose(result.viewFromWorld)[2] / height.length();
  result.depthPlaneW.w -= height.low / height.length();
  return result;
}

namespace {

// Axes of a pyramid's view.
struct PyramidAxes {
  vec3 back, right, up;
  explicit PyramidAxes(const LightPyramid& pyramid)
      : back(-pyramid.axisW), right(anyAcross(back)), up(glm::cross(back, right)) {}
};

}  // namespace

std::vector<vec3> litBody(const LightPyramid& pyramid, std::span<const scene::View> views,
                          const Aabb& boxW) {
  const auto [back, right, up] = PyramidAxes(pyramid);
  std::vector<vec4> planes;
  const auto add = [&](vec3 inward, float distance) {
    inward = glm::normalize(inward);
    planes.emplace_back(inward, distance - glm::dot(inward, pyramid.positionW));
  };
  for (const vec3 side : {right, -right, up, -up}) add(side + pyramid.tangent * pyramid.axisW, 0.f);
  if (!std::isinf(pyramid.reach)) add(back, pyramid.reach);
  return visibleBody(views, boxW, planes);
}

ShadowProjection localProjection(const LightPyramid& pyramid, std::span<const vec3> bodyW,
                                 float margin) {
  const auto [back, right, up] = PyramidAxes(pyramid);
  ShadowProjection result{.viewFromWorld = spaceOf(right, up, back, pyramid.positionW)};

  const float farthest =
      along(pyramid.axisW, bodyW).high - glm::dot(pyramid.axisW, pyramid.positionW);
  const float far = std::max(1.001f * farthest, 1e-6f);  // the farthest surfaces lie inside
  const float near = std::clamp(pyramid.near, kNearShare * far, 0.5f * far);
  Range width, height;
  for (const vec3& point : bodyW) {
    const vec3 p(result.viewFromWorld * vec4(point, 1.f));
    const float distance = std::max(-p.z, near);
    width.grow(std::clamp(p.x / distance, -pyramid.tangent, pyramid.tangent));
    height.grow(std::clamp(p.y / distance, -pyramid.tangent, pyramid.tangent));
  }
  const auto widened = [&](Range& range) {
    const float by = std::max(range.length() * margin / (1.f - 2.f * margin), 1e-4f);
    range.low -= by, range.high += by;
  };
  widened(width);
  widened(height);
  result.clipFromView = frustumReversed(near * width.low, near * width.high, near * height.low,
                                        near * height.high, near, far);
  result.side = vec2(std::max(width.length(), height.length()));
  result.inner = 1.f - 2.f * margin;
  return result;
}

}  // namespace lucerna::render
