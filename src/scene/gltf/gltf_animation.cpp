// Animations of nodes.
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
      context.document.warn(accessor.place.pointer() +
                            " has keys at the same time: moved apart by the least possible");
    }
  }
  return times;
}

// The sampler's keys; the channel's path is set.
void readKeys(Context& context, const Place& sampler, AnimationChannel& channel) {
  channel.interpolation = readInterpolation(sampler);
  channel.times = readTimes(context, accessorAt(context, sampler, "input"));
  const Accessor& output = accessorAt(context, sampler, "output");
  const int components = channel.path == AnimationPath::Rotation ? 4 : 3;
  if (output.components != components) {
    output.place.refuse(typeName(output), fmt::format("VEC{} for this animation", components));
  }
  const std::size_t perKey = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
  if (output.count != channel.times.size() * perKey) {
    output.place.refuse(fmt::format("{} values for {} times", output.count, channel.times.size()),
                        fmt::format("{} a time", perKey));
  }
  const auto values = readFloats(context.document, output, 4);
  requireFinite(values, output);
  channel.values.resize(output.count);
  std::memcpy(&channel.values[0].x, values.data(), values.size() * sizeof(float));
}

std::optional<AnimationPath> pathNamed(const std::string& name) {
  if (name == "translation") return AnimationPath::Translation;
  if (name == "rotation") return AnimationPath::Rotation;
  if (name == "scale") return AnimationPath::Scale;
  return std::nullopt;
}

}  // namespace

void readAnimations(Context& context) {
  for (const Place& place : context.document.root().elements("animations")) {
    Animation animation;
    animation.name = place.text("name", place.pointer().substr(1));
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
      AnimationChannel channel;
      channel.node = context.sceneNodes[node];
      channel.path = *path;
      readKeys(context, samplers[sampler], channel);
      animation.channels.push_back(std::move(channel));
    }
    if (!animation.channels.empty()) context.scene.animations.push_back(std::move(animation));
  }
}

}  // namespace lucerna::scene::gltf
