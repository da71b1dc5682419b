#include "app/prepare_scene.hpp"

#include "core/log.hpp"
#include "core/text.hpp"

namespace lucerna::app {
namespace {

Status takeAnimation(scene::Scene& scene, const std::string& choice) {
  if (!choice.empty()) {
    const Status chosen = chooseAnimation(scene, choice);
    return chosen ? Status() : error(ErrorKind::Usage, "--animation: {}", chosen.error().message);
  }
  std::vector<std::string> others;
  for (const scene::Animation& animation : scene.animations)
    if (!animation.playing) others.push_back("'" + animation.name + "'");
  if (!others.empty())
    log::info("{} has more animations than play; --animation chooses one: {}", scene.name,
              join(others));
  return {};
}

}  // namespace

Result<std::uint32_t> prepareScene(scene::Scene& scene, const RenderSettings& settings,
                                   const CameraPath* path) {
  for (const std::string& warning : scene.warnings) log::warning("{}: {}", scene.name, warning);
  LUCERNA_TRY_VOID(takeAnimation(scene, settings.animation));
  if (settings.exposure) scene.exposure = *settings.exposure;
  LUCERNA_TRY(chosen, chooseCamera(scene, settings.camera));
  const std::uint32_t camera =
      path ? addCamera(scene, settings.cameraPath, path->at(settings.time)) : chosen;
  if (scene.headlight != scene::kNone)
    scene.lights[scene.headlight].node = scene.cameras[camera].node;
  return camera;
}

}  // namespace lucerna::app
