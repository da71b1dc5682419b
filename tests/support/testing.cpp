#include "support/testing.hpp"

#include <cmath>

#include <algorithm>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <set>

#include "gpu/context.hpp"
#include "graph/validate.hpp"
#include "passes/register_passes.hpp"
#include "render/view_group.hpp"

namespace lucerna::testing {

const std::vector<std::string> kDeferredRows = {
    "Cull", "GBuffer", "TiledLighting", "CustomShaders", "Background", "Transparency", "ToneMap"};
const std::vector<std::string> kForwardRows = {"Cull", "Forward", "Background", "Transparency",
                                               "ToneMap"};

namespace {

[[noreturn]] void stop(const Error& error) {
  std::fprintf(stderr, "no device for GL tests: %s\n", error.message.c_str());
  std::exit(4);
}

gpu::Device* makeDevice() {
  // Kept until the process ends: eglTerminate leaks, and tests share the device.
  static auto context = gpu::Context::create();
  if (!context) stop(context.error());
  static auto made = gpu::Device::create(**context, registry().shaders());
  if (!made) stop(made.error());
  return made->get();
}

}  // namespace

gpu::Device& device() {
  static gpu::Device* const kDevice = makeDevice();
  return *kDevice;
}

const graph::Registry& registry() {
  static const graph::Registry* const kRegistry = [] {
    auto* made = new graph::Registry;
    passes::registerPasses(*made);
    return made;
  }();
  return *kRegistry;
}

void expectNoDebugMessages() {
  for (const std::string& message : device().takeDebugMessages())
    ADD_FAILURE() << "GL says: " << message;
}

graph::Pipeline rows(const std::vector<std::string>& types) {
  graph::Pipeline pipeline;
  pipeline.name = "test";
  for (const std::string& type : types) {
    graph::PassRow& row = pipeline.passes.emplace_back();
    row.name = row.type = type;
    row.place = "row " + std::to_string(pipeline.passes.size());
  }
  return pipeline;
}

std::vector<std::string> radianceNames(const graph::Pipeline& pipeline) {
  std::set<std::string> names;
  const graph::Validation validation =
      graph::validate(pipeline, registry(), device().capabilities());
  if (!validation.ok()) return {};
  for (const graph::ResolvedRow& row : validation.plan->rows) {
    if (row.culled || row.description.type != "ToneMap") continue;
    const graph::ResolvedInput* input = row.input("color");
    if (input && input->source.kind == graph::Source::Kind::Output)
      names.insert(pipeline.passes[input->source.row].name + "." + input->source.port);
  }
  return {names.begin(), names.end()};
}

SceneRenderer::SceneRenderer(const scene::Scene& scene)
    : scene_(scene), executor_(device(), registry()) {
  upload(device(), gpuScene, scene);
  updateLights(device(), lights, scene);
}

Result<SceneRenderer::Output> SceneRenderer::render(const graph::Pipeline& pipeline, uvec2 size,
                                                    const std::vector<std::string>& kept) {
  CHECK(!scene_.cameras.empty(), "{} has no camera", scene_.name);
  const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
  return render(pipeline, viewOf(scene_, scene_.cameras[0], aspect), size, kept);
}

Result<SceneRenderer::Output> SceneRenderer::render(const graph::Pipeline& pipeline,
                                                    const scene::View& sceneView, uvec2 size,
                                                    const std::vector<std::string>& kept) {
  updateView(device(), view, sceneView, size);
  LUCERNA_TRY_VOID(executor_.setPipeline(pipeline, size, kept));
  executor_.setProfiling(profiling);
  std::vector<graph::Imports> views(1);
  views[0].set("view", view);
  graph::FrameInput input;
  input.cut = true;
  input.shared.set("scene", gpuScene);
  input.shared.set("lights", lights);
  input.shared.set("lightmaps", lightmaps);
  const render::ViewGroup viewGroup{{sceneView}};
  input.shared.set("views", viewGroup);
  input.views = views;
  Output output;
  LUCERNA_TRY_VOID(executor_.execute(input, [&](int, const gpu::Texture& texture) {
    output.picture = device().download(texture);
    for (const std::string& name : kept)
      if (const gpu::Texture* value = executor_.kept(name))
        output.kept[name] = device().download(*value);
    return Status();
  }));
  output.profile = executor_.profile();
  return output;
}

Image pictureOf(const scene::Scene& scene, const graph::Pipeline& pipeline, uvec2 size) {
  SceneRenderer renderer(scene);
  auto output = renderer.render(pipeline, size);
  CHECK(static_cast<bool>(output), "{}", output.error().message);
  return output->picture;
}

Image valueOf(const scene::Scene& scene, const graph::Pipeline& pipeline, uvec2 size,
              const std::string& kept) {
  SceneRenderer renderer(scene);
  auto output = renderer.render(pipeline, size, {kept});
  CHECK(static_cast<bool>(output), "{}", output.error().message);
  CHECK(output->kept.contains(kept), "{} was not kept", kept);
  return output->kept.at(kept);
}

vec3 colorAt(const Image& image, int x, int y) {
  const Image linear = converted(image, ComponentType::F32, 3);
  const float* pixel = linear.pixel<float>(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

gpu::Texture uploaded(const Image& image, gpu::Format format) {
  gpu::Texture texture = device().createTexture(
      {.format = format, .width = image.width(), .height = image.height()}, "uploaded");
  device().upload(texture, image);
  return texture;
}

void expectSumOfEachLightAlone(scene::Scene& scene, const std::function<Image()>& picture) {
  const Image together = picture();
  std::vector<double> sum(together.as<float>().size());
  for (scene::Light& one : scene.lights) {
    for (scene::Light& light : scene.lights) light.on = &light == &one;
    const Image alone = picture();
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += alone.as<float>()[i];
  }
  for (scene::Light& light : scene.lights) light.on = true;
  double brightest = 0, worst = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    brightest = std::max(brightest, sum[i]);
    worst = std::max(worst, std::abs(sum[i] - together.as<float>()[i]));
  }
  EXPECT_GT(brightest, 0.5);
  EXPECT_LT(worst, 2. / 255. * brightest);
}

double visibleShareOfDisc(double t) {
  t = std::clamp(t, -1., 1.);
  return 0.5 + (t * std::sqrt(1. - t * t) + std::asin(t)) / static_cast<double>(kPi);
}

Image asFloatRgb(const Image& image) {
  return converted(image, ComponentType::F32, 3);
}

}  // namespace lucerna::testing
