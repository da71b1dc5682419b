#include "app/bench/stage.hpp"

#include <algorithm>
#include <chrono>

#include "app/frame.hpp"
#include "render/shadow_layers.hpp"
#include "render/shadow_maps.hpp"

namespace lucerna::app::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr float kPlainAlbedo = 230.f / 255.f;         // encoded, as the G-buffer stores it
constexpr float kSunlight = 0.75f, kAmbient = 0.25f;  // radiance of a white surface by each

double msSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void lightBySun(scene::Scene& scene, float elevation, float azimuth) {
  const vec3 toSun(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                   -std::cos(elevation) * std::cos(azimuth));
  scene::Light sun;
  sun.name = "sun";
  sun.kind = scene::LightKind::Directional;
  sun.intensity = kSunlight * kPi;
  sun.node = scene::addNode(scene, "sun", worldFromCamera({.position = toSun, .target = vec3(0)}));
  scene.lights = {sun};
  scene.headlight = scene::kNone;
  scene.ambient = vec3(kAmbient);
  scene.exposure = 0.f;
}

void makePlain(scene::Material& material) {
  scene::Material plain;
  plain.name = material.name;
  plain.model = scene::MaterialModel::Phong;
  plain.doubleSided = material.doubleSided;
  plain.albedo = vec4(vec3(linearFromSrgb(kPlainAlbedo)), 1.f);
  if (material.alphaMode == scene::AlphaMode::Mask) {  // its holes stay
    plain.alphaMode = material.alphaMode;
    plain.alphaCutoff = material.alphaCutoff;
    plain.albedo.w = material.albedo.w;
    plain.albedoTexture = material.albedoTexture;
  }
  material = std::move(plain);
}

void makePlain(scene::Scene& scene, bool keepTranslucent) {
  const auto translucent = [](const scene::Material& material) {
    return material.alphaMode == scene::AlphaMode::Blend;
  };
  std::erase_if(scene.objects, [&](const scene::Object& object) {
    return (!keepTranslucent && translucent(scene.materials[object.material])) ||
           scene.meshes[object.mesh].triangleCount() == 0;
  });
  for (scene::Material& material : scene.materials)
    if (!keepTranslucent || !translucent(material)) makePlain(material);
}

const std::string kMaps = "ShadowMaps.shadowMaps", kLayers = "ShadowLayers.shadowLayers";

// Values of shadow passes that samples tell of.
std::vector<std::string> keptOf(const Chain& chain) {
  std::vector<std::string> kept;
  for (const Row& row : chain.rows)
    for (const std::string& port : {kMaps, kLayers})
      if (port.starts_with(row.pass + ".")) kept.push_back(port);
  return kept;
}

std::uint64_t texelsOf(const render::ShadowMaps& maps) {
  std::uint64_t texels = 0;
  for (const render::ShadowMaps::Map& map : maps.maps) {
    const auto side = static_cast<std::uint64_t>(map.place.side);
    texels += side * side;
  }
  return texels;
}

void tellOfShadows(const graph::Executor& executor, Sample& sample) {
  if (const auto* maps = executor.keptData<render::ShadowMaps>(kMaps))
    sample.shadowTexels = texelsOf(*maps);
  if (const auto* layers = executor.keptData<render::ShadowLayers>(kLayers)) {
    sample.shadowLayers = layers->count;
    sample.lightsBeyond = layers->beyond;
  }
}

Result<graph::Pipeline> pipelineOf(const Chain& chain, const graph::Registry& registry) {
  graph::Pipeline pipeline{.name = "bench", .output = chain.output};
  for (const Row& row : chain.rows)
    pipeline.passes.push_back({.name = row.pass, .type = row.pass, .reads = {}, .params = {}});
  for (const Row& row : chain.rows)
    for (const std::string& setting : row.settings)
      LUCERNA_TRY_VOID(graph::applySetting(pipeline, registry, row.pass + "." + setting));
  return pipeline;
}

}  // namespace

Result<std::unique_ptr<Stage>> Stage::open(const StageSettings& settings) {
  RenderSettings render = settings.render;
  render.timeStep = 0;
  LUCERNA_TRY(session, openSession(render));
  scene::Scene& scene = session->scene;
  if (!settings.moving) scene.animations.clear();
  if (settings.lighting == Lighting::Sun)
    lightBySun(scene, glm::radians(settings.elevationDegrees),
               glm::radians(settings.azimuthDegrees));
  if (settings.surfaces != Surfaces::Own) {
    makePlain(scene, settings.surfaces == Surfaces::PlainAndTranslucent);
    session->gpuScene = {};
    render::upload(*session->device, session->gpuScene, scene);
  }
  render::updateLights(*session->device, session->lights, scene);
  session->camera = addCamera(scene, "bench", CameraPose{});
  session->rebuild = false;  // the executors below have their pipelines already
  return std::unique_ptr<Stage>(new Stage(std::move(session)));
}

Result<std::size_t> Stage::add(const Variant& variant) {
  std::shared_ptr<Renderer> renderer = rendererOf(variant);
  if (!renderer) {
    gpu::Device& device = *session_->device;
    LUCERNA_TRY(pipeline, pipelineOf(variant.chain, session_->registry));
    renderer = std::make_shared<Renderer>();
    renderer->executor = std::make_unique<graph::Executor>(device, session_->registry);
    const std::uint64_t others = device.objectCounts().textureBytes;
    LUCERNA_TRY_VOID(
        renderer->executor->setPipeline(pipeline, variant.size, keptOf(variant.chain)));
    renderer->textureBytes = device.objectCounts().textureBytes - others;
  }
  lanes_.push_back({variant, std::move(renderer)});
  return lanes_.size() - 1;
}

std::shared_ptr<Stage::Renderer> Stage::rendererOf(const Variant& variant) const {
  for (const Lane& lane : lanes_)
    if (lane.variant.chain == variant.chain && lane.variant.size == variant.size)
      return lane.renderer;
  return nullptr;
}

void Stage::relight(const std::function<void(scene::Scene& scene)>& change) {
  change(session_->scene);
  render::updateLights(*session_->device, session_->lights, session_->scene);
  session_->gpuScene.changes.lights = true;
}

Status Stage::look(const CameraPose& pose, float sight) {
  moveCamera(session_->scene, session_->camera, pose);
  sight_ = sight;
  for (const Lane& lane : lanes_)
    for (const Row& row : lane.variant.chain.rows)
      for (const Length& wanted : row.lengths)
        LUCERNA_TRY_VOID(
            lane.renderer->executor->setParam(row.pass, wanted.param, length(row.pass, wanted)));
  return {};
}

double Stage::length(const std::string& pass, const Length& length) const {
  const graph::PassType* type = session_->registry.find(pass);
  CHECK(type, "no pass {}", pass);
  const graph::PassDescription description = type->describe({});
  const graph::ParamDescription* param = description.param(length.param);
  CHECK(param && param->min && param->max, "{}.{} has no range", pass, length.param);
  return std::clamp(static_cast<double>(length.share) * static_cast<double>(sight_), *param->min,
                    *param->max);
}

scene::View Stage::view(uvec2 size) const {
  return scene::viewOf(session_->scene, session_->scene.cameras[session_->camera],
                       static_cast<float>(size.x) / static_cast<float>(size.y));
}

Result<Sample> Stage::draw(std::size_t number, Image* picture) {
  Session& s = *session_;
  Lane& lane = lanes_[number];
  s.settings.size = lane.variant.size;
  s.plan = planViews(lane.variant.size, 1, 0, 0);
  Renderer& renderer = *lane.renderer;
  for (const Setting& setting : lane.variant.settings)
    LUCERNA_TRY_VOID(renderer.executor->setParam(setting.pass, setting.param, setting.value));
  std::swap(s.executor, renderer.executor);
  Sample sample;
  ProfileLog log;
  s.device->finish();
  const std::uint64_t others = s.device->objectCounts().textureBytes - renderer.textureBytes;
  s.device->resetCounters();
  const auto start = Clock::now();
  const Status drawn = runFrame(s, lane.variant.profiled ? &log : nullptr,
                                [&](Session&, int, const gpu::Texture& output) -> Status {
                                  sample.cpuMs = msSince(start);
                                  s.device->finish();
                                  sample.realMs = msSince(start);
                                  sample.counters = s.device->counters();
                                  tellOfShadows(*s.executor, sample);
                                  if (picture) *picture = s.device->download(output);
                                  return {};
                                });
  if (drawn && lane.variant.profiled) sample.profile = s.executor->profile();
  std::swap(s.executor, renderer.executor);
  renderer.textureBytes = s.device->objectCounts().textureBytes - others;
  sample.textureBytes = renderer.textureBytes;
  LUCERNA_TRY_VOID(drawn);
  return sample;
}

}  // namespace lucerna::app::bench
