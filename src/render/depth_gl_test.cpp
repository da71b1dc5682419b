// Depth drawn alone, as shadow maps will, against the depth of the G-buffer.
#include <gtest/gtest.h>

#include "render/draw_list.hpp"
#include "render/object_programs.hpp"
#include "support/testing.hpp"

namespace lucerna::render {
namespace {

using testing::device;

// The same surfaces and holes, to the last bit: alpha test, generated coordinates and all.
TEST(DepthAlone, IsThatOfTheGBuffer) {
  scene::Scene scene = testing::sampleScene();
  scene::Material& fence = scene.materials[3];
  ASSERT_EQ(fence.alphaMode, scene::AlphaMode::Mask);
  for (const auto coordinates : {scene::Coordinates::Mesh, scene::Coordinates::ObjectLinear}) {
    fence.albedoTexture.coordinates = coordinates;
    constexpr uvec2 kSize{160, 90};
    testing::SceneRenderer renderer(scene);
    auto output = renderer.render(testing::rows({"Cull", "GBuffer", "ShowGBuffer"}), kSize,
                                  {"GBuffer.depth"});
    ASSERT_TRUE(output) << output.error().message;

    DrawList all;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
      if (scene.materials[scene.objects[i].material].alphaMode != scene::AlphaMode::Blend)
        all.objects.push_back(i);
    finishList(device(), renderer.gpuScene, all);
    const gpu::Texture depth = device().createTexture(
        {.format = gpu::Format::Depth32F, .width = kSize.x, .height = kSize.y}, "depth alone");
    ObjectPrograms programs(device(), "render/depth.frag");
    {
      gpu::Rendering rendering =
          device().render({.depth = {.texture = &depth, .load = gpu::Load::Clear}});
      rendering.buffer("ViewBlock", renderer.view.block);
      drawList(rendering, renderer.gpuScene, all, {.depthTest = true, .depthWrite = true},
               [&](const scene::Material& material) { return &programs.of(material); });
    }
    EXPECT_TRUE(device().takeErrors().empty());
    const Image found = device().download(depth);
    EXPECT_TRUE(std::ranges::equal(found.bytes(), output->kept.at("GBuffer.depth").bytes()));
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna::render
