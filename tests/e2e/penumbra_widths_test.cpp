// Widths of penumbrae against their closed form: by the three passes that make them.
#include <gtest/gtest.h>

#include <cmath>

#include "half_plane.hpp"
#include "passes/nearest_blockers/nearest_blockers.hpp"
#include "passes/penumbra/penumbra.hpp"
#include "passes/shadow_layers/shadow_layers.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{256, 64};
constexpr float kWall = testing::kHalfPlaneWall;
using testing::halfPlane;
using testing::kLampX;

// Stronger lamps behind the half-plane: their maps, which see no more than the wall, are placed
// before the first lamp's own in the same layer.
void addNeighbours(scene::Scene& scene) {
  scene::Light light = scene.lights[0];
  light.intensity = 200.f;
  for (const float y : {-0.5f, 0.f, 0.2f})
    testing::addLight(scene, light, {kLampX, y, -0.7f * kWall}, {kLampX, y, -kWall});
  updateTransforms(scene);
}

gpu::Texture uploaded(const Image& image, gpu::Format format) {
  gpu::Texture texture = testing::device().createTexture(
      {.format = format, .width = image.width(), .height = image.height()}, "copy");
  testing::device().upload(texture, image);
  return texture;
}

using Params = passes::Penumbra::Params;

constexpr int kPlenty = 512;  // MiB for maps

// Of the first light in the middle row, m.
std::vector<float> widthsOf(const scene::Scene& scene, const Params& params,
                            int localMemory = kPlenty) {
  testing::SceneRenderer renderer(scene);
  auto output = renderer.render(testing::rows({"Cull", "GBuffer", "TiledLighting"}), kSize,
                                {"GBuffer.depth", "GBuffer.normal"});
  CHECK(static_cast<bool>(output), "{}", output.error().message);
  const gpu::Texture depth = uploaded(output->kept.at("GBuffer.depth"), gpu::Format::Depth32F);
  const gpu::Texture normal = uploaded(output->kept.at("GBuffer.normal"), gpu::Format::Rg16Unorm);
  graph::PassContext context{.device = testing::device()};

  const render::ShadowMaps maps =
      testing::mapsFor(renderer, {.localSize = 2048, .localMemory = localMemory});
  const auto& place = maps.maps[maps.ofLight[0].first].place;
  EXPECT_EQ(place.corner == ivec2(0), scene.lights.size() == 1) << "where its map lies";
  EXPECT_EQ(place.side, localMemory == kPlenty ? 2048 : 512);

  render::ShadowLayers layers;
  passes::ShadowLayers::Ports layerPorts;
  layerPorts.scene.bind(&renderer.gpuScene);
  layerPorts.lights.bind(&renderer.lights);
  layerPorts.shadowMaps.bind(&maps);
  layerPorts.shadowLayers.bind(&layers);
  passes::ShadowLayers(testing::device()).execute(context, {}, layerPorts);

  render::NearestBlockers nearest;
  passes::NearestBlockers::Ports nearestPorts;
  nearestPorts.shadowMaps.bind(&maps);
  nearestPorts.nearestBlockers.bind(&nearest);
  passes::NearestBlockers(testing::device()).execute(context, {}, nearestPorts);

  render::Penumbrae penumbrae;
  passes::Penumbra::Ports ports;
  ports.view.bind(&renderer.view);
  ports.lights.bind(&renderer.lights);
  ports.shadowMaps.bind(&maps);
  ports.shadowLayers.bind(&layers);
  ports.depth.bind(&depth);
  ports.normal.bind(&normal);
  if (params.method == passes::Penumbra::Method::Minimum) ports.nearestBlockers.bind(&nearest);
  ports.penumbrae.bind(&penumbrae);
  passes::Penumbra(testing::device()).execute(context, params, ports);
  EXPECT_EQ(penumbrae.layers, static_cast<int>(scene.lights.size()));
  const int layer = layers.ofLight[0];
  const Image image =
      converted(testing::device().download(penumbrae.widths, layer / 4), ComponentType::F32, 4);
  std::vector<float> widths;
  for (int x = 0; x < image.width(); ++x)
    widths.push_back(image.pixel<float>(x, image.height() / 2)[layer % 4]);
  return widths;
}

void expectThoseOfADisc(const Params& params) {
  std::vector<double> found;
  const std::vector<float> radii{0.1f, 0.2f, 0.4f, 0.8f};
  for (const float radius : radii) {
    SCOPED_TRACE(radius);
    const scene::Scene scene = halfPlane(radius);
    const std::vector<float> widths = widthsOf(scene, params);
    const float aspect = static_cast<float>(kSize.x) / static_cast<float>(kSize.y);
    const float metres = 2.f * kWall * std::tan(0.5f * scene.cameras[0].fovY) * aspect;
    // The middle of the penumbra is as far behind the edge as the lamp is before it.
    const auto middle =
        static_cast<std::size_t>((0.5f - kLampX / metres) * static_cast<float>(widths.size()));
    found.push_back(widths[middle]);
    EXPECT_NEAR(widths[middle], 2.f * radius, 0.1f * 2.f * radius);
    EXPECT_EQ(widths.back(), 0.f) << "nothing is in the way there";
  }
  const double exponent = std::log(found.back() / found.front()) /
                          std::log(static_cast<double>(radii.back() / radii.front()));
  EXPECT_NEAR(exponent, 1., 0.03);
  testing::expectNoDebugMessages();
}

TEST(PenumbraWidths, OfASearchAreThoseOfADiscAndLinearInItsSize) {
  Params params;
  params.search = 11;
  for (const auto resolution : {render::LayerResolution::Half, render::LayerResolution::Full}) {
    params.resolution = resolution;
    expectThoseOfADisc(params);
  }
}

TEST(PenumbraWidths, OfNearestBlockersAreThoseOfADiscAndLinearInItsSize) {
  Params params;
  params.method = passes::Penumbra::Method::Minimum;
  expectThoseOfADisc(params);
}

// Small maps lie side by side: windows end at their edges, and levels of blocks at their size.
TEST(PenumbraWidths, AreThoseOfALampByItselfWhereItsMapHasNeighbours) {
  Params params;
  for (const auto method : {passes::Penumbra::Method::Search, passes::Penumbra::Method::Minimum}) {
    params.method = method;
    const scene::Scene alone = halfPlane(0.4f);
    scene::Scene together = alone;
    addNeighbours(together);
    // Enough for one map of 512 x 512 texels, and for four of them.
    const std::vector<float> wanted = widthsOf(alone, params, 1);
    const std::vector<float> found = widthsOf(together, params, 4);
    EXPECT_EQ(found, wanted);
    EXPECT_GT(std::ranges::max(found), 0.5f);
    EXPECT_EQ(std::ranges::min(found), 0.f);
  }
}

}  // namespace
}  // namespace lucerna
