// Lights, cameras and animations of assimp's scene.
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

#include "scene/import/assimp_parts.hpp"

namespace lucerna::scene {
namespace {

vec3 toVec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

bool finite(vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool setKind(const aiLight& source, Light& light) {
  switch (source.mType) {
    case aiLightSource_DIRECTIONAL:
      light.kind = LightKind::Directional;
      return true;
    case aiLightSource_POINT:
      light.kind = LightKind::Point;
      return true;
    case aiLightSource_SPOT:
      light.kind = LightKind::Spot;
      return true;
    default:
      return false;
  }
}

void setStrength(const aiLight& source, Light& light) {
  const vec3 color(source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b);
  setRelativeStrength(finite(color) ? glm::max(color, vec3(0.f)) : vec3(0.f), light);
  const vec3 attenuation(source.mAttenuationConstant, source.mAttenuationLinear,
                         source.mAttenuationQuadratic);
  const bool usable = finite(attenuation) && attenuation.x >= 0.f && attenuation.y >= 0.f &&
                      attenuation.z >= 0.f && attenuation != vec3(0.f);
  light.attenuation = usable ? attenuation : vec3(1.f, 0.f, 0.f);
}

// Cone angles are full angles there, half-angles here.
void setCone(const aiLight& source, Light& light) {
  const auto half = [](float full) {
    return std::isfinite(full) ? std::clamp(0.5f * full, 0.f, 0.5f * kPi) : 0.25f * kPi;
  };
  light.outerCone = half(source.mAngleOuterCone);
  light.innerCone = std::min(half(source.mAngleInnerCone), light.outerCone);
}

// Some of assimp's readers give the field of view in degrees: no angle in radians is that large.
float fovYOf(const aiCamera& source) {
  const float aspect = source.mAspect > 0.f ? source.mAspect : 4.f / 3.f;
  float fovX = source.mHorizontalFOV;
  if (fovX > kPi) fovX = glm::radians(fovX);
  if (!(fovX > 0.01f && fovX < 3.1f)) return Camera{}.fovY;
  return 2.f * std::atan(std::tan(0.5f * fovX) / aspect);
}

// Keys of one path; those that do not rise in time or are not finite are left out.
template <typename Key, typename Convert>
void addChannel(Animation& animation, std::uint32_t node, AnimationPath path, const Key* keys,
                unsigned count, double ticksPerSecond, Convert convert) {
  if (count < 2) return;  // a single key says what the node's transform says
  AnimationChannel channel;
  channel.node = node;
  channel.path = path;
  for (unsigned i = 0; i < count; ++i) {
    const auto time = static_cast<float>(keys[i].mTime / ticksPerSecond);
    const vec4 value = convert(keys[i].mValue);
    const bool rises = channel.times.empty() || time > channel.times.back();
    if (!std::isfinite(time) || time < 0.f || !rises || !finite(vec3(value)) ||
        !std::isfinite(value.w))
      continue;
    channel.times.push_back(time);
    channel.values.push_back(value);
  }
  if (!channel.times.empty()) animation.channels.push_back(std::move(channel));
}

}  // namespace

std::uint32_t addLookingNode(Scene& scene, const NodesByName& nodes, const std::string& name,
                             vec3 position, vec3 direction, vec3 up) {
  Node node;
  node.name = name;
  if (const auto parent = nodes.find(name); parent != nodes.end()) node.parent = parent->second;
  node.translation = finite(position) ? position : vec3(0.f);
  if (!finite(direction) || glm::length(direction) < 1e-6f) direction = vec3(0.f, 0.f, -1.f);
  direction = glm::normalize(direction);
  if (!finite(up) || glm::length(glm::cross(direction, up)) < 1e-4f)
    up = std::abs(direction.y) < 0.9f ? vec3(0.f, 1.f, 0.f) : vec3(1.f, 0.f, 0.f);
  node.rotation = glm::quatLookAt(direction, glm::normalize(up));
  return addNode(scene, node);
}

void setRelativeStrength(vec3 color, Light& light) {
  const float brightest = std::max({color.x, color.y, color.z, 1.f});
  light.color = color / brightest;
  light.intensity = brightest * kPi;
}

void convertLights(const aiScene& source, const NodesByName& nodes, Scene& scene) {
  for (unsigned i = 0; i < source.mNumLights; ++i) {
    const aiLight& from = *source.mLights[i];
    Light light;
    light.name = from.mName.C_Str();
    setStrength(from, light);
    if (from.mType == aiLightSource_AMBIENT) {
      scene.ambient += light.color * (light.intensity / kPi);
      continue;
    }
    if (!setKind(from, light)) {
      scene.warnings.push_back(fmt::format(
          "light '{}' is of a kind other than directional, point, spot and ambient; it is left out",
          light.name));
      continue;
    }
    if (light.kind == LightKind::Spot) setCone(from, light);
    light.node = addLookingNode(scene, nodes, light.name, toVec3(from.mPosition),
                                toVec3(from.mDirection), toVec3(from.mUp));
    scene.lights.push_back(light);
  }
}

void convertCameras(const aiScene& source, const NodesByName& nodes, Scene& scene) {
  for (unsigned i = 0; i < source.mNumCameras; ++i) {
    const aiCamera& from = *source.mCameras[i];
    Camera camera;
    camera.name = from.mName.C_Str();
    camera.fovY = fovYOf(from);
    camera.aspect = std::isfinite(from.mAspect) && from.mAspect > 0.f ? from.mAspect : 0.f;
    // near and far are left open: assimp cannot tell a stated value from its default.
    camera.node = addLookingNode(scene, nodes, camera.name, toVec3(from.mPosition),
                                 toVec3(from.mLookAt), toVec3(from.mUp));
    scene.cameras.push_back(camera);
  }
}

void convertAnimations(const aiScene& source, const NodesByName& nodes, Scene& scene) {
  constexpr double kDefaultTicksPerSecond = 25.;
  for (unsigned i = 0; i < source.mNumAnimations; ++i) {
    const aiAnimation& from = *source.mAnimations[i];
    const double ticks = from.mTicksPerSecond > 0. ? from.mTicksPerSecond : kDefaultTicksPerSecond;
    Animation animation;
    animation.name = from.mName.C_Str();
    const auto vector = [](const aiVector3D& v) { return vec4(v.x, v.y, v.z, 0.f); };
    const auto rotation = [](const aiQuaternion& q) { return vec4(q.x, q.y, q.z, q.w); };
    for (unsigned c = 0; c < from.mNumChannels; ++c) {
      const aiNodeAnim& keys = *from.mChannels[c];
      const auto node = nodes.find(keys.mNodeName.C_Str());
      if (node == nodes.end()) continue;
      addChannel(animation, node->second, AnimationPath::Translation, keys.mPositionKeys,
                 keys.mNumPositionKeys, ticks, vector);
      addChannel(animation, node->second, AnimationPath::Rotation, keys.mRotationKeys,
                 keys.mNumRotationKeys, ticks, rotation);
      addChannel(animation, node->second, AnimationPath::Scale, keys.mScalingKeys,
                 keys.mNumScalingKeys, ticks, vector);
    }
    if (!animation.channels.empty()) scene.animations.push_back(std::move(animation));
  }
}

}  // namespace lucerna::scene
