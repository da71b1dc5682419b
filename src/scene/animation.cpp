#include <algorithm>
#include <cmath>

#include "scene/scene.hpp"

namespace lucerna::scene {
namespace {

vec4 slerp(vec4 a, vec4 b, float t) {
  // glm::quat's constructor takes w first.
  const quat q = glm::slerp(quat(a.w, a.x, a.y, a.z), quat(b.w, b.x, b.y, b.z), t);
  return {q.x, q.y, q.z, q.w};
}

// glTF 2.0, appendix C: keys are (in-tangent, value, out-tangent), Hermite between them.
vec4 cubic(const AnimationChannel& channel, std::size_t key, float t, float step) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  const vec4& v0 = channel.values[3 * key + 1];
  const vec4& out0 = channel.values[3 * key + 2];
  const vec4& in1 = channel.values[3 * key + 3];
  const vec4& v1 = channel.values[3 * key + 4];
  return (2.f * t3 - 3.f * t2 + 1.f) * v0 + step * (t3 - 2.f * t2 + t) * out0 +
         (-2.f * t3 + 3.f * t2) * v1 + step * (t3 - t2) * in1;
}

vec4 sample(const AnimationChannel& channel, float time) {
  const bool spline = channel.interpolation == Interpolation::CubicSpline;
  const auto value = [&](std::size_t key) { return channel.values[spline ? 3 * key + 1 : key]; };
  const auto& times = channel.times;
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return value(0);
  const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end() || channel.interpolation == Interpolation::Step) return value(key);

  const float step = times[key + 1] - times[key];
  const float t = (time - times[key]) / step;
  if (spline) return cubic(channel, key, t, step);
  if (channel.path == AnimationPath::Rotation) return slerp(value(key), value(key + 1), t);
  return glm::mix(value(key), value(key + 1), t);
}

void apply(Node& node, const AnimationChannel& channel, float time) {
  const vec4 value = sample(channel, time);
  node.matrix.reset();
  switch (channel.path) {
    case AnimationPath::Translation:
      node.translation = vec3(value);
      break;
    case AnimationPath::Scale:
      node.scale = vec3(value);
      break;
    case AnimationPath::Rotation: {
      const float length = glm::length(value);
      if (length > 0.f) node.rotation = quat(value.w, value.x, value.y, value.z) / length;
      break;
    }
  }
}

}  // namespace

float Animation::duration() const {
  float end = 0.f;
  for (const AnimationChannel& channel : channels)
    if (!channel.times.empty()) end = std::max(end, channel.times.back());
  return end;
}

std::vector<std::uint32_t> animate(Scene& scene, float time) {
  if (scene.animations.empty()) return {};
  std::vector<mat4> before;
  before.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes) before.push_back(node.worldFromNode);

  for (const Animation& animation : scene.animations) {
    const float duration = animation.duration();
    float local = time;
    if (time < 0.f || time > duration) {  // at its very end it shows the last pose
      local = duration > 0.f ? std::fmod(time, duration) : 0.f;
      if (local < 0.f) local += duration;
    }
    for (const AnimationChannel& channel : animation.channels)
      if (channel.node != kNone && !channel.times.empty())
        apply(scene.nodes[channel.node], channel, local);
  }
  updateTransforms(scene);

  std::vector<std::uint32_t> moved;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::uint32_t node = scene.objects[i].node;
    if (before[node] != scene.nodes[node].worldFromNode)
      moved.push_back(static_cast<std::uint32_t>(i));
  }
  return moved;
}

}  // namespace lucerna::scene
