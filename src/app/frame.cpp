#include "app/frame.hpp"

#include <algorithm>
#include <utility>

#include "core/log.hpp"
#include "core/progress.hpp"
#include "graph/reach.hpp"
#include "scene/view.hpp"

namespace lucerna::app {
namespace {

// px of a tile where the picture is too large for the driver: a G-buffer of some 400 MiB.
constexpr int kTileSide = 4096;

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
}

// Where the views of the plan look from and what each shows.
void updateViews(Session& s) {
  const float aspect =
      static_cast<float>(s.settings.size.x) / static_cast<float>(s.settings.size.y);
  const scene::View middle = scene::viewOf(s.scene, s.scene.cameras[s.camera], aspect);
  const StereoSettings& stereo = s.settings.stereo;
  s.views.resize(s.plan.places.size());
  s.viewGroup.views.resize(static_cast<std::size_t>(s.plan.eyes()));
  for (std::size_t i = 0; i < s.views.size(); ++i) {
    const auto& [eye, tile] = s.plan.places[i];
    const float side = s.plan.eyes() == 1 ? 0.f : eye == 0 ? -0.5f : 0.5f;
    const scene::View view = scene::eyeView(middle, side * stereo.separation, stereo.convergence);
    s.viewGroup.views[static_cast<std::size_t>(eye)] = view;
    // Windows count from the lower left corner.
    const ivec2 origin(tile.window.x, s.plan.picture.y - tile.window.y - s.plan.window.y);
    render::updateView(*s.device, s.views[i], view, s.plan.picture,
                       {.origin = origin, .size = s.plan.window});
  }
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

// Rows without outputs do something else with each tile: they write it.
Status checkTiles(const graph::Plan& plan, const graph::Reach& reach) {
  if (!reach.whole.empty())
    return error(
        ErrorKind::Usage,
        "'{}' may need the whole picture, which a tile does not show: {}; change that, or draw "
        "without tiles",
        reach.whole, reach.why);
  for (const graph::ResolvedRow& row : plan.rows)
    if (!row.culled &&
        std::ranges::all_of(row.description.ports, [](const graph::PortDescription& port) {
          return port.direction == graph::Direction::In;
        }))
      return error(ErrorKind::Usage,
                   "'{}' would write every tile by itself; leave the row out by --set "
                   "{}.enabled=false, or draw without tiles",
                   row.name, row.name);
  return {};
}

// Tiles where they are asked for or the driver's textures are too small for the picture.
Status choosePlan(Session& s, const graph::Plan& plan) {
  const uvec2 picture = s.settings.renderSize();
  const int eyes = s.settings.stereo.eyes();
  const auto limit = static_cast<unsigned>(s.device->capabilities().maxTextureSide);
  const bool tooLarge = std::max(picture.x, picture.y) > limit;
  const int side = s.settings.tile > 0 ? s.settings.tile : tooLarge ? kTileSide : 0;
  const graph::Reach reach = graph::reachOf(plan);
  s.plan = planViews(picture, eyes, side, reach.pixels);
  const std::size_t tiles = s.plan.places.size() / static_cast<std::size_t>(eyes);
  if (tiles == 1) return {};
  LUCERNA_TRY_VOID(checkTiles(plan, reach));
  log::info("{} tiles of {} px, with a guard band of {} px", tiles, side, reach.pixels);
  return {};
}

Status rebuildSchedule(Session& s) {
  if (!s.rebuild) return {};
  const auto validation = graph::validate(s.pipeline, s.registry, s.device->capabilities());
  if (!validation.ok()) return error(ErrorKind::Pipeline, "{}", validation.text());
  LUCERNA_TRY(layers, findLayers(s.pipeline, *validation.plan, s.wantedLayers));
  s.layers = std::move(layers);
  std::vector<std::string> kept;
  for (const LayerSource& layer : s.layers) kept.push_back(layer.port);
  const auto keeping = graph::validate(s.pipeline, s.registry, s.device->capabilities(), kept);
  LUCERNA_TRY_VOID(choosePlan(s, *keeping.plan));
  LUCERNA_TRY_VOID(s.executor->setPipeline(s.pipeline, s.plan.window, kept));
  s.rebuild = false;
  return {};
}

Status runSteps(Session& s, const graph::Executor::OnView& take) {
  graph::Imports shared;
  shared.set("scene", s.gpuScene);
  shared.set("lights", s.lights);
  shared.set("lightmaps", s.lightmaps);
  shared.set("views", s.viewGroup);
  std::vector<graph::Imports> views(s.views.size());
  for (std::size_t i = 0; i < views.size(); ++i) views[i].set("view", s.views[i]);
  const render::SceneChanges& changes = s.gpuScene.changes;
  const graph::FrameInput input{.time = s.time(),
                                .timeStep = s.settings.timeStep,
                                .frame = s.frame,
                                .seed = s.settings.seed,
                                .cut = s.frame == 0,
                                .sceneChanged = changes.everything || changes.lights ||
                                                changes.materials || !changes.movedObjects.empty(),
                                .shared = std::move(shared),
                                .views = views};
  const Status drawn = s.executor->execute(input, take);
  s.rowFiles.insert(s.executor->written().begin(), s.executor->written().end());
  return drawn;
}

// Presents or writes.
Status draw(Session& s, const FrameSink& sink) {
  Status taken;
  const auto attempt = [&]() -> Status {
    LUCERNA_TRY_VOID(rebuildSchedule(s));
    updateViews(s);
    return runSteps(s, [&](int view, const gpu::Texture& output) {
      taken = sink(s, view, output);
      const bool last = view + 1 == static_cast<int>(s.views.size());
      if (taken && !last && Progress::cancelled())
        taken = error(ErrorKind::Cancelled, "cancelled in frame {}", s.frame);
      return taken;
    });
  };
  Status drawn = attempt();
  LUCERNA_TRY_VOID(taken);
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
  return {};
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
