// Everything that is alive while pictures are made: the context, the scene and its GPU copy, the
// pipeline and what runs it. frame.hpp tells what happens each frame.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/camera.hpp"
#include "app/layers.hpp"
#include "app/profile.hpp"
#include "app/settings.hpp"
#include "app/view_plan.hpp"
#include "gpu/context.hpp"
#include "gpu/device.hpp"
#include "graph/executor.hpp"
#include "graph/registry.hpp"
#include "render/gpu_scene.hpp"
#include "render/light_list.hpp"
#include "render/lightmaps.hpp"
#include "render/view_data.hpp"
#include "render/view_group.hpp"

namespace lucerna::app {

// Plain members, in the order in which they must be made (and, backwards, destroyed).
struct Session {
  RenderSettings settings;
  std::vector<LayerKind> wantedLayers;  // to be kept alive for the output
  graph::Registry registry;
  graph::Pipeline pipeline;
  // While a pipeline that was read again has not yet drawn a frame: the one before.
  std::optional<graph::Pipeline> lastGood;
  std::filesystem::file_time_type pipelineTime;  // of its file, when it was last read
  scene::Scene scene;
  std::uint32_t camera = 0;              // index in scene.cameras
  std::optional<CameraPath> cameraPath;  // moves that camera

  std::unique_ptr<gpu::Context> context;
  std::unique_ptr<gpu::Device> device;
  render::GpuScene gpuScene;
  render::LightList lights;
  render::Lightmaps lightmaps;          // without maps unless settings.lightmap
  ViewPlan plan;                        // follows from the pipeline and the size
  std::vector<render::ViewData> views;  // as plan.places
  render::ViewGroup viewGroup;
  std::unique_ptr<graph::Executor> executor;
  std::vector<LayerSource> layers;  // where wantedLayers come from

  std::uint64_t frame = 0;  // index of the next frame
  bool rebuild = true;      // the schedule does not fit the pipeline yet
  bool watch = false;       // reload shaders and pipeline when their files change; for a viewer
  bool pipelineChanged = false;              // its file, and that is not in `pipeline` yet
  std::vector<std::string> changedShaders;   // that wait for a pipeline that fits them
  std::set<std::filesystem::path> rowFiles;  // written by rows of the pipeline so far
  int glMessages = 0;                        // debug messages of severity medium or above

  double time() const { return settings.time + static_cast<double>(frame) * settings.timeStep; }
};

// The passes and resources that pipelines may name: those that ship, and those of the plugins.
Result<graph::Registry> makeRegistry(const std::vector<std::string>& plugins = {});

// The pipeline with all `sets` applied; "script.name=value" go to the script.
Result<graph::Pipeline> readPipeline(const graph::Registry& registry, const std::string& nameOrFile,
                                     const std::vector<std::string>& sets, std::uint64_t seed);

// Reads pipeline and scene, makes the context, uploads. The scene loads on a thread of its own.
Result<std::unique_ptr<Session>> openSession(const RenderSettings& settings,
                                             const std::vector<LayerKind>& layers = {});
// The same with passes of the caller's own choice instead of makeRegistry(settings.plugins).
Result<std::unique_ptr<Session>> openSession(const RenderSettings& settings,
                                             graph::Registry registry,
                                             const std::vector<LayerKind>& layers = {});

}  // namespace lucerna::app
