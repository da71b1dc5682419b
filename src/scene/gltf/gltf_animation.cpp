// Animations of nodes and of their meshes' morph targets.
#include <cmath>
#include <cstring>
#include <limits>

#include "scene/gltf/convert.hpp"

namespace lucerna::scene::gltf {

namespace {

const Accessor& accessorAt(const Context& context, const Place& owner, const char* key) {
  return context.accessors[owner.at(key).index(context.accessors.size(), "accessors")];
}

Interpolation readInterpolation(const Place& sampler) {
  const std::string name = sampler.text("interpolation", "LINEAR");
  if (name == "STEP") return Interpolation::Step;
  if (name == "LINEAR") return Interpolation::Linear;
  if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
  sampler.at("interpolation").refuse("\"STEP\", \"LINEAR\" or \"CUBICSPLINE\"");
}

void requireFinite(const std::vector<float>& values, const Accessor& accessor) {
  for (const float value : values) {
    if (!std::isfinite(value)) {
      accessor.place.refuse("a key that is infinite or not a number", "finite keys");
    }
  }
}

std::vector<float> readTimes(Context& context, const Accessor& accessor) {
  if (accessor.components != 1) accessor.place.refuse(typeName(accessor), "SCALAR times");
  auto times = readFloats(context.document, accessor, 1);
  requireFinite(times, accessor);
  float last = times[0];  // as the file says, before any key is moved
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] < last) {
      accessor.place.refuse(fmt::format("{} s after {} s at element {}", times[i], last, i),
                            "times that rise");
    }
    last = times[i];
    if (times[i] <= times[i - 1]) {  // a jump: two keys at one time
      times[i] = std::nextafter(times[i - 1], std::numeric_limits<float>::infinity());
      context.document.warn(accessor.place,
                            "has keys at the same time: moved apart by the least possible");
    }
  }
  return times;
}

// The sampler's keys; the channel's path is set. targets: of the node's mesh.
void readKeys(Context& context, const Place& sampler, std::size_t targets,
              AnimationChannel& channel) {
  channel.interpolation = readInterpolation(sampler);
  channel.times = readTimes(context, accessorAt(context, sampler, "input"));
  const Accessor& output = accessorAt(context, sampler, "output");
  const bool weights = channel.path == AnimationPath::Weights;
  const int components = weights ? 1 : channel.path == AnimationPath::Rotation ? 4 : 3;
  if (output.components != components) {
    output.place.refuse(typeName(output), fmt::format("{} for this animation",
                                                      weights ? std::string("SCALAR")
                                                              : fmt::format("VEC{}", components)));
  }
  const std::size_t perKey = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
  const std::size_t perTime = weights ? perKey * targets : perKey;
  if (output.count != channel.times.size() * perTime) {
    output.place.refuse(fmt::format("{} values for {} times", output.count, channel.times.size()),
                        fmt::format("{} a time", perTime));
  }
  auto values = readFloats(context.document, output, weights ? 1 : 4);
  requireFinite(values, output);
  if (weights) {
    channel.weights = std::move(values);
    return;
  }
  channel.values.resize(output.count);
  std::memcpy(&channel.values[0].x, values.data(), values.size() * sizeof(float));
}

std::optional<AnimationPath> pathNamed(const std::string& name) {
  if (name == "translation") return AnimationPath::Translation;
  if (name == "rotation") return AnimationPath::Rotation;
  if (name == "scale") return AnimationPath::Scale;
  if (name == "weights") return AnimationPath::Weights;
  return std::nullopt;
}

}  // namespace

void readAnimations(Context& context) {
  const auto nodes = context.document.root().elements("nodes");
  const auto animations = context.document.root().elements("animations");
  for (std::size_t i = 0; i < animations.size(); ++i) {
    const Place place = animations[i];
    Animation animation;
    animation.name = place.name(fmt::format("animations/{}", i));
    const auto samplers = place.at("samplers").elements();
    for (const Place& channelPlace : place.at("channels").elements()) {
      const Place target = channelPlace.at("target");
      const std::string& pathName = target.at("path").text();
      const auto path = pathNamed(pathName);
      if (!path) {
        context.document.warn(fmt::format("animation {} moves \"{}\", which is not animated",
                                          animation.name, pathName));
        continue;
      }
      const auto sampler = channelPlace.at("sampler").index(samplers.size(), "samplers");
      const auto node = target.index("node", context.sceneNodes.size(), "nodes");
      if (node == kNone || context.sceneNodes[node] == kNone) continue;  // outside the scene
      const auto mesh = nodes[node].index("mesh", context.meshes.size(), "meshes");
      const std::size_t targets = mesh == kNone ? 0 : context.meshes[mesh].targets;
      if (path == AnimationPath::Weights && targets == 0) {
        context.document.warn(
            channelPlace,
            fmt::format("moves the weights of node {}, which has no morph targets", node));
        continue;
      }
      AnimationChannel channel;
      channel.node = context.sceneNodes[node];
      channel.path = *path;
      readKeys(context, samplers[sampler], targets, channel);
      animation.channels.push_back(std::move(channel));
    }
    if (!animation.channels.empty()) context.scene.animations.push_back(std::move(animation));
  }
}

}  // namespace lucerna::scene::gltf
