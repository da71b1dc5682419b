// Against the lookup that Holes is a table for.
#include "bake/holes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/random.hpp"
#include "trace/trace_scenes.hpp"

namespace lucerna::bake {
namespace {

// A square with a picture that repeats, larger than one and from below nothing; most of its texels
// are like their neighbours.
scene::Scene sceneWithHoles(Random& random) {
  scene::Scene scene = trace::testing::emptyScene();
  auto image = std::make_shared<Image>(24, 15, 4, ComponentType::U8);
  std::ranges::fill(image->as<std::uint8_t>(), std::uint8_t{255});
  for (int y = 0; y < 15; y += 3)
    for (int x = 0; x < 24; x += 3) {
      const std::uint32_t what = random.below(3);
      for (int i = 0; i < 9; ++i)
        image->pixel<std::uint8_t>(x + i % 3, y + i / 3)[3] =
            static_cast<std::uint8_t>(what == 0   ? 0
                                      : what == 1 ? 255
                                                  : random.below(256));
    }
  scene::Texture& texture = scene.textures.emplace_back();
  texture.image = image;
  texture.wrapS = texture.wrapT = scene::Wrap::Repeat;
  scene::Material& material = trace::testing::addMaterial(scene);
  material.alphaMode = scene::AlphaMode::Mask;
  material.alphaCutoff = 0.3f;
  material.albedo.w = 0.8f;
  material.albedoTexture.texture = 0;
  trace::testing::addSquare(scene, vec3(0), {1, 0, 0}, {0, 1, 0});
  for (vec2& uv : scene.meshes[0].texCoords[0]) uv = uv * vec2(3.1f, 2.3f) - vec2(1.7f, 0.4f);
  return scene;
}

TEST(Holes, AreThoseOfTheLookup) {
  Random random(5, 1);
  const scene::Scene scene = sceneWithHoles(random);
  const trace::MaterialLookup lookup(scene, mat4(1.f));
  const Holes holes(lookup, scene, {{.object = 0, .triangle = 0}, {.object = 0, .triangle = 1}});
  constexpr int kTried = 100'000;
  int holesSeen = 0, close = 0;
  for (int i = 0; i < kTried; ++i) {
    vec2 at(random.uniform(0, 1), random.uniform(0, 1));
    if (at.x + at.y > 1.f) at = 1.f - at;
    const trace::Spot spot{
        .object = 0, .triangle = static_cast<std::uint32_t>(i % 2), .barycentric = at};
    if (std::abs(lookup.opacity(spot) - 0.3f) < 1e-4f) {
      ++close;
      continue;
    }
    const bool isHole = trace::isHole(lookup, spot);
    ASSERT_EQ(holes.at(spot.triangle, at), isHole) << at.x << ", " << at.y << " of " << i % 2;
    holesSeen += isHole;
  }
  EXPECT_GT(holesSeen, kTried / 4);
  EXPECT_LT(holesSeen, kTried * 3 / 4);
  EXPECT_LT(close, kTried / 100);
}

}  // namespace
}  // namespace lucerna::bake
