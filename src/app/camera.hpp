// Which camera a picture is taken with: one of the scene, one from a JSON file, or a path of
// keyframes. docs/user/camera.md describes the files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna {
class JsonValue;
}

namespace lucerna::app {

// A camera that stands by itself.
struct CameraPose {
  vec3 position{0.f};
  vec3 target{0.f, 0.f, -1.f};  // what the picture's centre shows; differs from position
  vec3 up{0.f, 1.f, 0.f};
  float fovY = 0.9f;            // rad, full vertical angle
  float near = 0.f, far = 0.f;  // m; 0: chosen from the scene
};

// Placement of a pose's node: -z looks at the target. Where up is along the view, another axis
// stands in.
mat4 worldFromCamera(const CameraPose& pose);

Result<CameraPose> readCamera(const std::filesystem::path& path);

// A pose over time: cubic Hermite curves through the keyframes with Catmull-Rom tangents (Catmull
// and Rom, "A Class of Local Interpolating Splines", 1974) for keys that are not evenly spaced in
// time.
class CameraPath {
 public:
  static Result<CameraPath> read(const std::filesystem::path& path);
  static Result<CameraPath> fromJson(const std::string& text, const std::string& name);
  // Through these, at least one, at the times 0, 1, 2, ...
  static CameraPath through(std::span<const CameraPose> poses);

  // Before the first and after the last keyframe the pose stands still.
  CameraPose at(double time) const;

 private:
  struct Keyframe {
    double time = 0;  // s, rising
    CameraPose pose;
  };
  void readKeyframes(const JsonValue& root);

  std::vector<Keyframe> keys_;  // at least one
};

// The index in scene.cameras of `choice`: a camera's name, its index, or a .json file, which is
// added to the scene. "" is the first camera. An unknown one is ErrorKind::Usage with those there
// are.
Result<std::uint32_t> chooseCamera(scene::Scene& scene, const std::string& choice);

// Adds a camera with a node of its own; returns its index.
std::uint32_t addCamera(scene::Scene& scene, std::string name, const CameraPose& pose);
// Moves a camera that addCamera() made.
void moveCamera(scene::Scene& scene, std::uint32_t camera, const CameraPose& pose);

}  // namespace lucerna::app
