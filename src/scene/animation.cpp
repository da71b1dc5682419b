#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/text.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {
namespace {

vec4 slerp(vec4 a, vec4 b, float t) {
  // glm::quat's constructor takes w first.
  const quat q = glm::slerp(quat(a.w, a.x, a.y, a.z), quat(b.w, b.x, b.y, b.z), t);
  return {q.x, q.y, q.z, q.w};
}

// Where a time lies among a channel's keys.
struct Moment {
  std::size_t key = 0;
  bool between = false;  // this key and the next; else the key itself counts
  float t = 0.f;         // 0 to 1 on the way
  float step = 0.f;      // s from key to key
};

Moment momentAt(const AnimationChannel& channel, float time) {
  const auto& times = channel.times;
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return {};
  Moment moment{.key = static_cast<std::size_t>(after - times.begin()) - 1};
  if (after == times.end() || channel.interpolation == Interpolation::Step) return moment;
  moment.between = true;
  moment.step = times[moment.key + 1] - times[moment.key];
  moment.t = (time - times[moment.key]) / moment.step;
  return moment;
}

// glTF 2.0, appendix C: keys are (in-tangent, value, out-tangent), Hermite between them.
// value(i): the i-th of the channel's values.
template <typename Value>
auto cubic(const Moment& m, Value value) {
  const float t = m.t, t2 = t * t, t3 = t2 * t;
  const auto v0 = value(3 * m.key + 1), out0 = value(3 * m.key + 2);
  const auto in1 = value(3 * m.key + 3), v1 = value(3 * m.key + 4);
  return (2.f * t3 - 3.f * t2 + 1.f) * v0 + m.step * (t3 - 2.f * t2 + t) * out0 +
         (-2.f * t3 + 3.f * t2) * v1 + m.step * (t3 - t2) * in1;
}

template <typename Value, typename Mix>
auto sample(const AnimationChannel& channel, const Moment& m, Value value, Mix mix) {
  if (channel.interpolation == Interpolation::CubicSpline)
    return m.between ? cubic(m, value) : value(3 * m.key + 1);
  return m.between ? mix(value(m.key), value(m.key + 1), m.t) : value(m.key);
}

void applyWeights(Node& node, const AnimationChannel& channel, const Moment& moment) {
  const std::size_t perKey = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
  const std::size_t targets = channel.weights.size() / (channel.times.size() * perKey);
  node.weights.resize(targets);
  for (std::size_t i = 0; i < targets; ++i)
    node.weights[i] = sample(
        channel, moment, [&](std::size_t at) { return channel.weights[at * targets + i]; },
        [](float a, float b, float t) { return a + (b - a) * t; });
}

void apply(Node& node, const AnimationChannel& channel, float time) {
  const Moment moment = momentAt(channel, time);
  if (channel.path == AnimationPath::Weights) return applyWeights(node, channel, moment);
  const bool turns = channel.path == AnimationPath::Rotation;
  const vec4 value = sample(
      channel, moment, [&](std::size_t at) { return channel.values[at]; },
      [&](vec4 a, vec4 b, float t) { return turns ? slerp(a, b, t) : glm::mix(a, b, t); });
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
    case AnimationPath::Weights:
      break;
  }
}

}  // namespace

float Animation::duration() const {
  float end = 0.f;
  for (const AnimationChannel& channel : channels)
    if (!channel.times.empty()) end = std::max(end, channel.times.back());
  return end;
}

Status chooseAnimation(Scene& scene, const std::string& choice) {
  auto& animations = scene.animations;
  std::vector<std::string> names, listed;
  for (const Animation& animation : animations) {
    listed.push_back(fmt::format("{} '{}'", names.size(), animation.name));
    names.push_back(animation.name);
  }
  auto chosen = static_cast<std::size_t>(std::ranges::find(names, choice) - names.begin());
  if (chosen == names.size() && choice != "none") {
    const char* end = choice.data() + choice.size();
    const auto [parsed, fault] = std::from_chars(choice.data(), end, chosen);
    if (fault != std::errc() || parsed != end || chosen >= names.size())
      return error(ErrorKind::Usage, "'{}' is not an animation of {}{}; it has {}", choice,
                   scene.name, didYouMean(choice, names),
                   names.empty() ? "none" : join(listed) + "; or give none");
  }
  for (std::size_t i = 0; i < animations.size(); ++i) animations[i].playing = i == chosen;
  return {};
}

std::vector<std::uint32_t> animate(Scene& scene, float time) {
  if (scene.animations.empty()) return {};
  std::vector<mat4> before;
  before.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes) before.push_back(node.worldFromNode);
  std::vector<std::uint32_t> versions;
  versions.reserve(scene.meshes.size());
  for (const Mesh& mesh : scene.meshes) versions.push_back(mesh.version);

  for (const Animation& animation : scene.animations) {
    if (!animation.playing) continue;
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
    const std::uint32_t node = scene.objects[i].node, mesh = scene.objects[i].mesh;
    if (before[node] != scene.nodes[node].worldFromNode ||
        versions[mesh] != scene.meshes[mesh].version)
      moved.push_back(static_cast<std::uint32_t>(i));
  }
  return moved;
}

}  // namespace lucerna::scene
