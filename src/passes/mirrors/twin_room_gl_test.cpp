// Reflections against the same things built as a mirror image.
#include "core/random.hpp"
#include "scene/load.hpp"
#include "support/mirrors.hpp"

namespace lucerna {
namespace {

// Where depth changes otherwise than over a plane, by more than a share of itself.
bool isEdge(const Image& depth, float share, int x, int y) {
  const auto depthAt = [&](int dx, int dy) {
    return *depth.pixel<float>(std::clamp(x + dx, 0, depth.width() - 1),
                               std::clamp(y + dy, 0, depth.height() - 1));
  };
  for (const ivec2 d : {ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1)})
    if (std::abs(depthAt(d.x, d.y) + depthAt(-d.x, -d.y) - 2 * depthAt(0, 0)) >
        share * depthAt(0, 0))
      return true;
  return false;
}

struct Difference {
  int compared = 0, greatest = 0;  // pixels; of 255, in any channel
};

// Of pixels that are no edges and where `mask` is not black, if there is one.
Difference offEdges(const Image& a, const Image& b, const Image& depth, float share = 0.01f,
                    const Image* mask = nullptr) {
  Difference result;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      if (isEdge(depth, share, x, y) || (mask && *mask->pixel<float>(x, y) == 0.f)) continue;
      ++result.compared;
      for (int c = 0; c < 3; ++c)
        result.greatest = std::max(result.greatest, std::abs(a.pixel<std::uint8_t>(x, y)[c] -
                                                             b.pixel<std::uint8_t>(x, y)[c]));
    }
  return result;
}

// The trap "twin room": the reflection is what a room built as a mirror image shows.
TEST(TwinRoom, AgreesWithTheReflectionOffEdges) {
  constexpr uvec2 kPicture{256, 144};
  const auto single = scene::loadScene("builtin:mirrors?single=1");
  const auto twin = scene::loadScene("builtin:mirrors?twin=1");
  ASSERT_TRUE(single && twin);
  testing::SceneRenderer one(*single), two(*twin);
  for (std::size_t camera = 0; camera < 3; ++camera) {
    SCOPED_TRACE(single->cameras[camera].name);
    const scene::View view = viewOf(*single, single->cameras[camera], 16.f / 9.f);
    const auto found = one.render(reflecting(1), view, kPicture);
    const auto without = one.render(plain(), view, kPicture);
    const auto expected = two.render(plain(), viewOf(*twin, twin->cameras[camera], 16.f / 9.f),
                                     kPicture, {"Forward.depth"});
    ASSERT_TRUE(found && without && expected);
    const Image& depth = expected->kept.at("Forward.depth");
    const Difference difference = offEdges(found->picture, expected->picture, depth);
    EXPECT_GT(difference.compared, 30000);
    EXPECT_LE(difference.greatest, 1);
    EXPECT_GT(offEdges(without->picture, expected->picture, depth).greatest, 50);
  }
  testing::expectNoDebugMessages();
}

// The scene with its mirror image beyond a plane, in place of the mirror, its last object.
scene::Scene withTwin(scene::Scene scene, const vec4& planeW) {
  scene.objects.pop_back();
  const vec3 n(planeW);
  mat4 reflection(1.f);
  for (int column = 0; column < 4; ++column)
    reflection[column] -= vec4(2.f * planeW[column] * n, 0.f);
  const std::size_t count = scene.objects.size();
  for (std::size_t i = 0; i < count; ++i) {
    const scene::Object object = scene.objects[i];
    testing::addObject(scene, object.mesh, object.material,
                       reflection * scene.nodes[object.node].worldFromNode);
  }
  updateTransforms(scene);
  return scene;
}

// The picture of a scene whose last object is the mirror, against that of its twin, where the
// mirror is seen.
Difference differenceToTwin(const scene::Scene& scene, const vec4& planeW, const scene::View& view,
                            uvec2 size) {
  scene::Scene marked = scene;  // black but for the mirror
  for (scene::Material& material : marked.materials) {
    material.model = scene::MaterialModel::Unlit;
    material.albedo = vec4(vec3(0.f), material.albedo.w);
    material.shader = {};
  }
  marked.materials[marked.objects.back().material].albedo = vec4(1.f);
  marked.background.color = vec3(0.f);
  const scene::Scene twin = withTwin(scene, planeW);
  testing::SceneRenderer one(scene), two(twin), mask(marked);
  const auto found = one.render(reflecting(1), view, size);
  const auto seen = mask.render(plain(), view, size, {"Transparency.color"});
  const auto expected = two.render(plain(), view, size, {"Forward.depth"});
  EXPECT_TRUE(found && seen && expected);
  const Image shown = testing::asFloatRgb(seen->kept.at("Transparency.color"));
  // Depth of parallel views is linear, from 0 to 100 m.
  return offEdges(found->picture, expected->picture, expected->kept.at("Forward.depth"),
                  view.orthographic ? 2e-4f : 0.01f, &shown);
}

// Every kind of surface: alpha-tested, translucent, mirrored by its matrix, with a shader of its
// own.
TEST_F(Mirrors, ShowEveryKindOfSurface) {
  constexpr uvec2 kPicture{192, 128};
  scene_ = testing::sampleScene();
  scene_.meshes.push_back(sheetMesh());
  scene_.lights.clear();  // those of the twin would be missing
  scene_.ambient = vec3(0.7f, 0.8f, 0.9f);
  const vec3 normal = glm::normalize(vec3(0.2f, 0.1f, 1.f));
  const vec3 at(-0.3f, 1.f, -4.f);
  addMirror(facing(at, normal, vec3(6.f)));
  const vec4 planeW(normal, -glm::dot(normal, at));
  scene::View view = viewOf(scene_, scene_.cameras[0], 1.5f);
  const Difference difference = differenceToTwin(scene_, planeW, view, kPicture);
  EXPECT_GT(difference.compared, 3000);
  EXPECT_LE(difference.greatest, 1);
  // Off-axis, as an eye or a wall's screen has it.
  EXPECT_LE(differenceToTwin(scene_, planeW, eyeView(view, 0.4f, 2.f), kPicture).greatest, 1);
  view.orthographic = true;
  view.clipFromView = orthographicReversed(-3.f, 3.f, -2.f, 2.f, view.near, view.far);
  const Difference parallel = differenceToTwin(scene_, planeW, view, kPicture);
  EXPECT_GT(parallel.compared, 3000);
  EXPECT_LE(parallel.greatest, 1);
}

// The trap "reflected frustum": what the mirror cannot show is not drawn, and nothing is missing.
TEST_F(Mirrors, DrawWhatTheyCanShowAndNothingIsMissing) {
  Random random(3);
  constexpr int kCubes = 300;
  scene_.ambient = vec3(1.f);
  for (int i = 0; i < kCubes; ++i) {
    const vec3 at(random.uniform(-20, 20), random.uniform(-8, 8), random.uniform(-3.5f, 20));
    addCube(glm::scale(glm::translate(mat4(1.f), at), vec3(random.uniform(0.2f, 0.8f)))).albedo =
        vec4(random.uniform(), random.uniform(), random.uniform(), 1);
  }
  const vec3 normal = glm::normalize(vec3(0.3f, 0, 1));
  addMirror(facing({0, 0, -4.5f}, normal, vec3(1.5f)));
  const vec4 planeW(normal, -glm::dot(normal, vec3(0, 0, -4.5f)));
  const scene::View view = viewOf(scene_, scene_.cameras[0], 1.f);
  const Difference difference = differenceToTwin(scene_, planeW, view, {128, 128});
  EXPECT_GT(difference.compared, 500);
  EXPECT_LE(difference.greatest, 1);
  testing::SceneRenderer renderer(scene_);
  renderer.profiling = true;
  const auto output = renderer.render(reflecting(1), {128, 128});
  ASSERT_TRUE(output) << output.error().message;
  for (const graph::StepProfile& step : output->profile.steps)
    if (step.row == "Mirrors") {
      EXPECT_GT(step.counters.draws, 5u);
      EXPECT_LT(step.counters.draws, kCubes / 5u);
    }
}

}  // namespace
}  // namespace lucerna
