#include "app/frame.hpp"

#include <utility>

#include "core/log.hpp"
#include "core/progress.hpp"
#include "scene/view.hpp"

namespace lucerna::app {
namespace {

void moveLights(Session& s) {
  render::updateLights(*s.device, s.lights, s.scene);
  s.gpuScene.changes.lights = true;
}

// The scene at this frame's time, on the CPU and on the GPU.
void applySceneChanges(Session& s) {
  if (!s.scene.animations.empty()) {
    const auto moved = scene::animate(s.scene, static_cast<float>(s.time()));
    render::updateMoved(*s.device, s.gpuScene, moved);
    moveLights(s);
  }
  if (s.cameraPath) {
    moveCamera(s.scene, s.camera, s.cameraPath->at(s.time()));
    if (s.scene.headlight != scene::kNone) moveLights(s);
  }
  const uvec2 size = s.settings.renderSize();
  const float aspect =
      static_cast<float>(s.settings.size.x) / static_cast<float>(s.settings.size.y);
  render::updateView(*s.device, s.view, scene::viewOf(s.scene, s.scene.cameras[s.camera], aspect),
                     size);
}

bool pipelineFileChanged(Session& s) {
  std::error_code noFile;
  const auto time = std::filesystem::last_write_time(s.settings.pipeline, noFile);
  return !noFile && time != std::exchange(s.pipelineTime, time);
}

// Descriptions may follow from shaders: before those are compiled anew, the pipeline must fit them.
Status reload(Session& s) {
  graph::Pipeline pipeline = s.pipeline;
  if (s.pipelineChanged) {
    LUCERNA_TRY(read,
                readPipeline(s.registry, s.settings.pipeline, s.settings.sets, s.settings.seed));
    pipeline = std::move(read);
  }
  const auto validation = graph::validate(pipeline, s.registry, s.device->capabilities());
  if (!validation.ok()) return error(ErrorKind::Pipeline, "{}", validation.text());
  LUCERNA_TRY(count, s.device->reloadShaders(s.changedShaders));
  s.changedShaders.clear();
  if (count > 0) log::info("reloaded {} shader program{}", count, count == 1 ? "" : "s");
  if (std::exchange(s.pipelineChanged, false)) s.lastGood = s.pipeline;
  s.pipeline = std::move(pipeline);
  s.rebuild = true;
  return {};
}

// What does not load, validate or compile any more is reported, and what was there goes on.
void reloadChangedFiles(Session& s) {
  if (!s.watch) return;
  const auto shaders = s.device->shaderSources().changedFiles();
  s.changedShaders.insert(s.changedShaders.end(), shaders.begin(), shaders.end());
  const bool pipelineChanged = pipelineFileChanged(s);
  s.pipelineChanged = s.pipelineChanged || pipelineChanged;
  if (!pipelineChanged && shaders.empty()) return;
  if (const Status status = reload(s); !status) log::error("{}", status.error().message);
  for (const Error& fault : s.device->takeErrors()) log::error("{}", fault.message);
}

Status rebuildSchedule(Session& s) {
  if (!s.rebuild) return {};
  const auto validation = graph::validate(s.pipeline, s.registry, s.device->capabilities());
  if (!validation.ok()) return error(ErrorKind::Pipeline, "{}", validation.text());
  LUCERNA_TRY(layers, findLayers(s.pipeline, *validation.plan, s.wantedLayers));
  s.layers = std::move(layers);
  std::vector<std::string> kept;
  for (const LayerSource& layer : s.layers) kept.push_back(layer.port);
  LUCERNA_TRY_VOID(s.executor->setPipeline(s.pipeline, s.settings.renderSize(), kept));
  s.rebuild = false;
  return {};
}

Status runSteps(Session& s, const std::function<void(const gpu::Texture&)>& take) {
  graph::Imports shared, view;
  shared.set("scene", s.gpuScene);
  shared.set("lights", s.lights);
  view.set("view", s.view);
  const render::SceneChanges& changes = s.gpuScene.changes;
  const graph::FrameInput input{.time = s.time(),
                                .timeStep = s.settings.timeStep,
                                .frame = s.frame,
                                .seed = s.settings.seed,
                                .cut = s.frame == 0,
                                .sceneChanged = changes.everything || changes.lights ||
                                                changes.materials || !changes.movedObjects.empty(),
                                .shared = std::move(shared),
                                .views = {&view, 1}};
  return s.executor->execute(input, [&](int, const gpu::Texture& output) { take(output); });
}

// Presents or writes.
Status draw(Session& s, const FrameSink& sink) {
  Status taken;
  const auto attempt = [&]() -> Status {
    LUCERNA_TRY_VOID(rebuildSchedule(s));
    return runSteps(s, [&](const gpu::Texture& output) { taken = sink(s, output); });
  };
  Status drawn = attempt();
  if (!drawn && s.lastGood) {
    log::error("{}", drawn.error().message);
    log::warning("{}: the pipeline before goes on until it or one of its shaders is corrected",
                 s.settings.pipeline);
    s.pipeline = *std::exchange(s.lastGood, std::nullopt);
    s.pipelineChanged = true;
    s.rebuild = true;
    drawn = attempt();
  }
  LUCERNA_TRY_VOID(drawn);
  s.lastGood.reset();
  return taken;
}

void finishFrame(Session& s, ProfileLog* profile) {
  if (profile) profile->add(s.executor->profile());
  for (const std::string& message : s.device->takeDebugMessages()) {
    log::warning("OpenGL says: {}", message);
    ++s.glMessages;
  }
  s.gpuScene.changes = {
      .everything = false, .movedObjects = {}, .lights = false, .materials = false};
  ++s.frame;
}

}  // namespace

Status runFrame(Session& session, ProfileLog* profile, const FrameSink& sink) {
  if (Progress::cancelled())
    return error(ErrorKind::Cancelled, "cancelled before frame {}", session.frame);
  applySceneChanges(session);
  reloadChangedFiles(session);
  session.executor->setProfiling(profile != nullptr);
  LUCERNA_TRY_VOID(draw(session, sink));
  finishFrame(session, profile);
  return {};
}

}  // namespace lucerna::app
