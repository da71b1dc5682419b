#include "app/camera.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/file.hpp"
#include "core/json_value.hpp"
#include "core/text.hpp"
#include "scene/scene_json.hpp"

namespace lucerna::app {
namespace {

constexpr std::uint64_t kMaxFileBytes = 64ull << 20;
constexpr float kLongest = 1e9f;  // s

CameraPose readPose(const JsonValue& json) {
  CameraPose pose;
  json.require({"position", "target"});
  json.read("position", pose.position);
  json.read("target", pose.target);
  json.read("up", pose.up);
  json.readDegrees("fovY", pose.fovY, {0.1f, 175.f});
  scene::readDepthRange(json, pose.near, pose.far);
  if (json.has("position") && pose.position == pose.target)
    json.fault("position and target are the same point; they must differ for a direction");
  return pose;
}

// Of values p at times t around the segment [i, i + 1]; ends repeat.
template <typename T>
T hermite(const std::vector<double>& t, const std::vector<T>& p, std::size_t i, double time) {
  const double length = t[i + 1] - t[i];
  const auto s = static_cast<float>((time - t[i]) / length);
  const auto tangent = [&](std::size_t k) {
    const std::size_t a = k == 0 ? 0 : k - 1;
    const std::size_t b = std::min(k + 1, t.size() - 1);
    return (p[b] - p[a]) * static_cast<float>(length / (t[b] - t[a]));
  };
  const float s2 = s * s, s3 = s2 * s;
  return p[i] * (2 * s3 - 3 * s2 + 1) + tangent(i) * (s3 - 2 * s2 + s) +
         p[i + 1] * (3 * s2 - 2 * s3) + tangent(i + 1) * (s3 - s2);
}

}  // namespace

mat4 worldFromCamera(const CameraPose& pose) {
  const vec3 back = glm::normalize(pose.position - pose.target);
  vec3 right = glm::cross(pose.up, back);
  // Also where `up` vanishes, as it may between two keyframes.
  if (glm::length(right) <= std::max(1e-5f * glm::length(pose.up), 1e-6f))
    right = glm::cross(std::abs(back.y) > 0.5f ? vec3(0, 0, -1) : vec3(0, 1, 0), back);
  right = glm::normalize(right);
  return mat4(vec4(right, 0), vec4(glm::cross(back, right), 0), vec4(back, 0),
              vec4(pose.position, 1));
}

Result<CameraPose> readCamera(const std::filesystem::path& path) {
  LUCERNA_TRY(text, readText(path, kMaxFileBytes));
  LUCERNA_TRY(document, JsonDocument::parse(text, path.string(), ErrorKind::Input));
  const JsonValue root = document.root();
  CameraPose pose;
  if (root.object({"lucerna", "position", "target", "up", "fovY", "near", "far"})) {
    if (root.has("lucerna")) root.format("camera/1");
    pose = readPose(root);
  }
  LUCERNA_TRY_VOID(document.status());
  return pose;
}

Result<CameraPath> CameraPath::read(const std::filesystem::path& path) {
  LUCERNA_TRY(text, readText(path, kMaxFileBytes));
  return fromJson(text, path.string());
}

Result<CameraPath> CameraPath::fromJson(const std::string& text, const std::string& name) {
  LUCERNA_TRY(document, JsonDocument::parse(text, name, ErrorKind::Input));
  const JsonValue root = document.root();
  CameraPath path;
  if (root.object({"lucerna", "keyframes"})) {
    if (root.has("lucerna")) root.format("camera-path/1");
    path.readKeyframes(root);
  }
  LUCERNA_TRY_VOID(document.status());
  return path;
}

CameraPath CameraPath::through(std::span<const CameraPose> poses) {
  CHECK(!poses.empty());
  CameraPath path;
  for (const CameraPose& pose : poses)
    path.keys_.push_back({static_cast<double>(path.keys_.size()), pose});
  return path;
}

void CameraPath::readKeyframes(const JsonValue& root) {
  root.require({"keyframes"});
  if (!root.has("keyframes")) return;
  for (const JsonValue& entry : root.at("keyframes").elements()) {
    if (!entry.object({"time", "position", "target", "up", "fovY"})) continue;
    entry.require({"time"});
    float time = 0.f;
    const bool timed = entry.read("time", time, {-kLongest, kLongest, "s"});
    if (timed && !keys_.empty() && time <= keys_.back().time)
      entry.fault(fmt::format("its time {} does not come after the one before ({})", time,
                              keys_.back().time));
    keys_.push_back({time, readPose(entry)});
  }
  if (keys_.empty()) root.at("keyframes").wrong("a list with at least one keyframe");
}

CameraPose CameraPath::at(double time) const {
  if (time <= keys_.front().time) return keys_.front().pose;
  if (time >= keys_.back().time) return keys_.back().pose;
  std::size_t segment = 0;
  while (keys_[segment + 1].time <= time) ++segment;

  std::vector<double> times;
  std::vector<vec3> positions, targets, ups;
  std::vector<float> fovs;
  for (const Keyframe& key : keys_) {
    times.push_back(key.time);
    positions.push_back(key.pose.position);
    targets.push_back(key.pose.target);
    ups.push_back(key.pose.up);
    fovs.push_back(key.pose.fovY);
  }
  CameraPose pose = keys_[segment].pose;
  pose.position = hermite(times, positions, segment, time);
  pose.target = hermite(times, targets, segment, time);
  pose.up = hermite(times, ups, segment, time);
  pose.fovY = std::clamp(hermite(times, fovs, segment, time), 0.01f, 3.1f);
  // A curve may pass through its own target for an instant.
  if (pose.position == pose.target) pose.target += pose.target - keys_[segment].pose.position;
  if (pose.position == pose.target) pose.target.z -= 1.f;
  return pose;
}

std::uint32_t addCamera(scene::Scene& scene, std::string name, const CameraPose& pose) {
  scene::Camera camera;
  camera.name = name;
  camera.node = scene::addNode(scene, std::move(name), worldFromCamera(pose));
  scene.cameras.push_back(camera);
  const auto index = static_cast<std::uint32_t>(scene.cameras.size() - 1);
  moveCamera(scene, index, pose);
  return index;
}

void moveCamera(scene::Scene& scene, std::uint32_t index, const CameraPose& pose) {
  scene::Camera& camera = scene.cameras[index];
  camera.fovY = pose.fovY;
  camera.near = pose.near;
  camera.far = pose.far;
  scene::Node& node = scene.nodes[camera.node];
  const mat4 placement = worldFromCamera(pose);
  node.translation = vec3(placement[3]);
  node.rotation = glm::quat_cast(mat3(placement));
  node.scale = vec3(1.f);
  node.matrix.reset();
  node.worldFromNode = placement;
}

Result<std::uint32_t> chooseCamera(scene::Scene& scene, const std::string& choice) {
  if (choice.ends_with(".json")) {
    LUCERNA_TRY(pose, readCamera(choice));
    return addCamera(scene, choice, pose);
  }
  const auto count = static_cast<std::uint32_t>(scene.cameras.size());
  CHECK(count > 0, "complete() gives every scene a camera");
  if (choice.empty()) return 0u;
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (scene.cameras[i].name == choice) return i;
    names.push_back(scene.cameras[i].name);
  }
  std::uint32_t index = 0;
  const char* end = choice.data() + choice.size();
  const auto [parsed, fault] = std::from_chars(choice.data(), end, index);
  if (fault == std::errc() && parsed == end && index < count) return index;
  std::vector<std::string> listed;
  for (std::uint32_t i = 0; i < count; ++i) listed.push_back(fmt::format("{} '{}'", i, names[i]));
  return error(ErrorKind::Usage,
               "--camera: '{}' is not a camera of {}{}; it has {}; or give a camera file (.json)",
               choice, scene.name, didYouMean(choice, names), join(listed));
}

}  // namespace lucerna::app
