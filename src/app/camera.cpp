#include "app/camera.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/json_reader.hpp"
#include "core/file.hpp"
#include "core/text.hpp"

namespace lucerna::app {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxFileBytes = 64ull << 20;
constexpr double kLargest = 1e9;  // s or m: beyond it, floats lose the centimetres anyway

Result<CameraPose> poseFromJson(const Json& json, const std::string& place,
                                std::initializer_list<const char*> keys) {
  CameraPose pose;
  JsonReader reader(json, place);
  reader.allowOnly(keys);
  reader.require({"position", "target"});
  pose.position = reader.vector("position", pose.position);
  pose.target = reader.vector("target", pose.target);
  pose.up = reader.vector("up", pose.up);
  pose.fovY = glm::radians(reader.number("fovY", glm::degrees(pose.fovY), 0.1, 175));
  pose.near = reader.number("near", 0.f, 0, kLargest);
  pose.far = reader.number("far", 0.f, 0, kLargest);
  LUCERNA_TRY_VOID(reader.status());
  if (pose.position == pose.target)
    return error(ErrorKind::Input,
                 "{}: position and target are the same point; they must differ for a direction",
                 place);
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
  if (glm::length(right) < 1e-5f * glm::length(pose.up))
    right = glm::cross(std::abs(back.y) > 0.5f ? vec3(0, 0, -1) : vec3(0, 1, 0), back);
  right = glm::normalize(right);
  return mat4(vec4(right, 0), vec4(glm::cross(back, right), 0), vec4(back, 0),
              vec4(pose.position, 1));
}

Result<CameraPose> readCamera(const std::filesystem::path& path) {
  LUCERNA_TRY(text, readText(path, kMaxFileBytes));
  LUCERNA_TRY(document, parseDocument(text, path.string(), "camera/1"));
  return poseFromJson(document, path.string(),
                      {"lucerna", "position", "target", "up", "fovY", "near", "far"});
}

Result<CameraPath> CameraPath::read(const std::filesystem::path& path) {
  LUCERNA_TRY(text, readText(path, kMaxFileBytes));
  return fromJson(text, path.string());
}

Result<CameraPath> CameraPath::fromJson(const std::string& text, const std::string& name) {
  LUCERNA_TRY(document, parseDocument(text, name, "camera-path/1"));
  JsonReader reader(document, name);
  reader.allowOnly({"lucerna", "keyframes"});
  LUCERNA_TRY_VOID(reader.status());
  const Json keyframes = document.value("keyframes", Json());
  if (!keyframes.is_array() || keyframes.empty())
    return error(ErrorKind::Input, "{}: \"keyframes\" must be a list with at least one keyframe",
                 name);
  CameraPath path;
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const std::string place = fmt::format("{}, keyframe {}", name, i + 1);
    LUCERNA_TRY(pose,
                poseFromJson(keyframes[i], place, {"time", "position", "target", "up", "fovY"}));
    JsonReader time(keyframes[i], place);
    time.require({"time"});
    const double seconds = static_cast<double>(time.number("time", 0.f, -kLargest, kLargest));
    LUCERNA_TRY_VOID(time.status());
    if (i > 0 && seconds <= path.keys_.back().time)
      return error(ErrorKind::Input, "{}: its time {} does not come after the one before ({})",
                   place, seconds, path.keys_.back().time);
    path.keys_.push_back({seconds, pose});
  }
  return path;
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
