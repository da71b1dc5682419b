#include "app/session.hpp"

#include <future>

#include "app/baked_light.hpp"
#include "app/prepare_scene.hpp"
#include "core/log.hpp"
#include "core/parallel.hpp"
#include "graph/plugin.hpp"
#include "passes/register_passes.hpp"
#include "scene/load.hpp"
#include "script/load_pipeline.hpp"

namespace lucerna::app {
namespace {

constexpr std::string_view kScriptPrefix = "script.";

// Context, device and shaders.
Status openDevice(Session& session) {
  LUCERNA_TRY(context, gpu::Context::create(session.settings.gl));
  session.context = std::move(context);
  LUCERNA_TRY(device, gpu::Device::create(*session.context, session.registry.shaders()));
  session.device = std::move(device);
  if (!session.settings.shaderFolder.empty())
    session.device->shaderSources().setRoot(session.settings.shaderFolder);
  log::debug("{} ({})", session.device->description(), session.context->platform());
  return {};
}

Status takeScene(Session& session, Result<scene::Scene> loaded) {
  if (!loaded) return loaded.error();
  session.scene = std::move(loaded).value();
  LUCERNA_TRY(camera, prepareScene(session.scene, session.settings,
                                   session.cameraPath ? &*session.cameraPath : nullptr));
  session.camera = camera;
  if (session.settings.stereo.eyes() > 1 && session.scene.cameras[camera].orthographic)
    return error(ErrorKind::Usage,
                 "--stereo: the camera '{}' is orthographic and has no place for two eyes; take "
                 "another by --camera",
                 session.scene.cameras[camera].name);
  return {};
}

// A GBuffer that leaves baked light out, while the lights that were baked are off.
void warnOfDarkPipeline(const graph::Pipeline& pipeline) {
  for (const graph::PassRow& row : pipeline.passes) {
    if (row.type != "GBuffer" || !row.enabled) continue;
    const auto baked = row.params.find("baked");
    if (baked != row.params.end() && baked->second == graph::Value(true)) continue;
    log::warning(
        "--lightmap: the pipeline '{}' does not draw baked light, and the lights that were baked "
        "are off; wanted --pipeline lightmapped or forward, or {} with baked: true",
        pipeline.name, row.name);
    return;
  }
}

// Before the scene goes to the GPU: objects get meshes that know their places in the maps.
Status takeLightmaps(Session& session) {
  if (session.settings.lightmap.empty()) return {};
  scene::animate(session.scene, 0.f);  // lights as they stood when they were baked
  LUCERNA_TRY(maps, takeBakedLight(session.scene, session.settings));
  warnOfDarkPipeline(session.pipeline);
  return render::upload(*session.device, session.lightmaps, maps);
}

Status checkFolder(const std::string& folder) {
  std::error_code noFolder;
  if (folder.empty() || std::filesystem::is_directory(folder, noFolder)) return {};
  return error(ErrorKind::Usage, "--shaders: '{}' is not a folder; wanted one laid out like src/",
               folder);
}

}  // namespace

Result<graph::Registry> makeRegistry(const std::vector<std::string>& plugins) {
  graph::Registry registry;
  passes::registerPasses(registry);
  for (const std::string& plugin : plugins) LUCERNA_TRY_VOID(graph::loadPlugin(plugin, registry));
  return registry;
}

Result<graph::Pipeline> readPipeline(const graph::Registry& registry, const std::string& nameOrFile,
                                     const std::vector<std::string>& sets, std::uint64_t seed) {
  script::ScriptInput input{.params = {}, .seed = seed};
  std::vector<std::string> rowSettings;
  for (const std::string& setting : sets) {
    const std::size_t equals = setting.find('=');
    if (!setting.starts_with(kScriptPrefix) || equals == std::string::npos) {
      rowSettings.push_back(setting);
      continue;
    }
    input.params[setting.substr(kScriptPrefix.size(), equals - kScriptPrefix.size())] =
        setting.substr(equals + 1);
  }
  LUCERNA_TRY(pipeline, script::loadPipeline(nameOrFile, input));
  graph::resolveFiles(pipeline, registry);
  for (const std::string& setting : rowSettings)
    LUCERNA_TRY_VOID(graph::applySetting(pipeline, registry, setting));
  return pipeline;
}

Result<std::unique_ptr<Session>> openSession(const RenderSettings& settings,
                                             const std::vector<LayerKind>& layers) {
  LUCERNA_TRY(registry, makeRegistry(settings.plugins));
  return openSession(settings, std::move(registry), layers);
}

Result<std::unique_ptr<Session>> openSession(const RenderSettings& settings,
                                             graph::Registry registry,
                                             const std::vector<LayerKind>& layers) {
  setThreadCount(settings.threads);
  auto session = std::make_unique<Session>();
  session->settings = settings;
  session->wantedLayers = layers;
  session->registry = std::move(registry);
  LUCERNA_TRY_VOID(checkFolder(settings.shaderFolder));
  if (!settings.cameraPath.empty()) {
    LUCERNA_TRY(path, CameraPath::read(settings.cameraPath));
    session->cameraPath = std::move(path);
  }
  LUCERNA_TRY(pipeline,
              readPipeline(session->registry, settings.pipeline, settings.sets, settings.seed));
  session->pipeline = std::move(pipeline);
  std::error_code ignored;  // shipped pipelines have no file
  session->pipelineTime = std::filesystem::last_write_time(settings.pipeline, ignored);

  auto loading = std::async(std::launch::async, [&] { return scene::loadScene(settings.scene); });
  const Status opened = openDevice(*session);
  Result<scene::Scene> scene = loading.get();
  LUCERNA_TRY_VOID(opened);
  LUCERNA_TRY_VOID(takeScene(*session, std::move(scene)));
  LUCERNA_TRY_VOID(takeLightmaps(*session));

  gpu::Device& device = *session->device;
  scene::animate(session->scene, static_cast<float>(session->time()));
  render::upload(device, session->gpuScene, session->scene);
  render::updateLights(device, session->lights, session->scene);
  session->executor = std::make_unique<graph::Executor>(device, session->registry);
  return session;
}

}  // namespace lucerna::app
