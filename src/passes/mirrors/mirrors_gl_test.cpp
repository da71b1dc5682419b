#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/random.hpp"
#include "render/draw_list.hpp"
#include "render/object_programs.hpp"
#include "scene/load.hpp"
#include "support/testing.hpp"

namespace lucerna {
namespace {

constexpr uvec2 kSize{64, 64};

// Rows that reflect, and the same without.
graph::Pipeline reflecting(std::int64_t depth = 4) {
  graph::Pipeline pipeline =
      testing::rows({"Cull", "Forward", "Background", "Mirrors", "Transparency", "ToneMap"});
  pipeline.passes[3].params = {{"depth", depth}};
  return pipeline;
}
graph::Pipeline plain() {
  return testing::rows({"Cull", "Forward", "Background", "Transparency", "ToneMap"});
}

// Linear radiance, F32.
Image radiance(const scene::Scene& scene, const graph::Pipeline& pipeline, uvec2 size = kSize) {
  return testing::asFloatRgb(testing::valueOf(scene, pipeline, size, "Transparency.color"));
}

vec3 at(const Image& radiance, int x, int y) {
  const float* pixel = radiance.pixel<float>(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}
vec3 middleOf(const Image& radiance) {
  return at(radiance, radiance.width() / 2, radiance.height() / 2);
}

bool equal(const Image& a, const Image& b) {
  return std::ranges::equal(a.bytes(), b.bytes());
}

// A square of side 1 in the plane z = 0 that faces +z.
scene::Mesh sheetMesh() {
  scene::Mesh mesh;
  mesh.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
  mesh.normals.assign(4, vec3(0, 0, 1));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  for (const vec3& position : mesh.positions) mesh.bounds.grow(position);
  return mesh;
}

// Places what looks along +z at `at`, looking towards `direction`.
mat4 facing(vec3 at, vec3 direction, vec3 size = vec3(1.f)) {
  const vec3 up = std::abs(direction.y) > 0.9f ? vec3(0, 0, 1) : vec3(0, 1, 0);
  return glm::scale(glm::inverse(glm::lookAt(at, at - direction, up)), size);
}

class Mirrors : public ::testing::Test {
 protected:
  Mirrors() : scene_(testing::emptyScene()) { scene_.meshes.push_back(sheetMesh()); }
  void TearDown() override { testing::expectNoDebugMessages(); }

  // A sheet with a material of its own.
  scene::Material& addSheet(const mat4& place) { return add(1, place); }
  scene::Material& addCube(const mat4& place) { return add(0, place); }
  // A sheet that shows one colour in any light.
  void addCard(const mat4& place, vec3 color) {
    scene::Material& card = addSheet(place);
    card.model = scene::MaterialModel::Unlit;
    card.albedo = vec4(color, 1.f);
  }
  // The mirror that the camera looks at: 4 m ahead, 4 m wide, black without a reflection.
  scene::Material& addMirror(const mat4& place = facing({0, 0, -4}, {0, 0, 1}, vec3(4.f))) {
    scene::Material& mirror = addSheet(place);
    mirror.reflectivity = 1.f;
    mirror.albedo = vec4(0, 0, 0, 1);
    mirror.metallic = 0.f;
    return mirror;
  }
  vec3 middle(const graph::Pipeline& pipeline = reflecting()) const {
    return middleOf(radiance(scene_, pipeline));
  }

  scene::Scene scene_;

 private:
  scene::Material& add(std::uint32_t mesh, const mat4& place) {
    scene_.materials.emplace_back();
    testing::addObject(scene_, mesh, static_cast<std::uint32_t>(scene_.materials.size() - 1),
                       place);
    updateTransforms(scene_);
    return scene_.materials.back();
  }
};

// A card behind the camera that faces the mirror.
const mat4 kBehindTheCamera = facing({0, 0, 3}, {0, 0, -1}, vec3(2.f));

TEST_F(Mirrors, ShowWhatStandsBehindTheCamera) {
  addMirror();
  addCard(kBehindTheCamera, {0.5f, 0.25f, 1.f});
  EXPECT_EQ(middle(), vec3(0.5f, 0.25f, 1.f));
  EXPECT_EQ(middle(plain()), vec3(0.f));
}

// Where depth changes otherwise than over a plane, by more than a share of itself.
bool isEdge(const Image& depth, float share, int x, int y) {
  const auto near = [&](int dx, int dy) {
    return *depth.pixel<float>(std::clamp(x + dx, 0, depth.width() - 1),
                               std::clamp(y + dy, 0, depth.height() - 1));
  };
  for (const ivec2 d : {ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1)})
    if (std::abs(near(d.x, d.y) + near(-d.x, -d.y) - 2 * near(0, 0)) > share * near(0, 0))
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

// The trap "mirror winding": the mirror shows the front of a single-sided sheet that turns its back
// to the eye, and nothing of one that shows it its front. Also where the sheet's matrix mirrors.
TEST_F(Mirrors, ShowFrontFacesAndNoBackFaces) {
  for (const float side : {1.f, -1.f}) {
    scene_.objects.clear();
    addMirror();
    addCard(facing({0, 0, 3}, {0, 0, -1}, vec3(side * 2.f, 2.f, 2.f)), {1, 0, 0});
    EXPECT_EQ(middle(), vec3(1, 0, 0)) << side;
    scene_.objects.clear();
    addMirror();
    addCard(facing({0, 0, 3}, {0, 0, 1}, vec3(side * 2.f, 2.f, 2.f)), {1, 0, 0});
    EXPECT_EQ(middle(), vec3(0.f)) << side;
  }
}

// A mirror in a mirror turns them once more.
TEST_F(Mirrors, ShowFrontFacesInMirrorsInMirrors) {
  addMirror();
  addMirror(facing({0, 0, 2}, {0, 0, -1}, vec3(4.f)));
  addCard(facing({0.f, 0, -1}, {0, 0, 1}, vec3(0.2f)), {1, 0, 0});  // seen in both, in turn
  addCard(facing({0.f, 0, -1.1f}, {0, 0, -1}, vec3(0.2f)), {0, 1, 0});
  const Image image = radiance(scene_, reflecting(2));
  bool red = false, green = false;
  for (int x = 0; x < image.width(); ++x) {
    red = red || at(image, x, 32) == vec3(1, 0, 0);
    green = green || at(image, x, 32) == vec3(0, 1, 0);
  }
  EXPECT_TRUE(red);
  EXPECT_FALSE(green) << "hidden by the red card";
}

// The trap "objects behind the mirror": what is behind its plane is not reflected, nor is what
// reaches through it behind it.
TEST_F(Mirrors, ShowNothingThatIsBehindThem) {
  addMirror();
  addCard(facing({0, 0, -5}, {0, 0, 1}, vec3(2.f)), {1, 0, 0});
  addCard(facing({0, 0, -5}, {0, 0, -1}, vec3(2.f)), {1, 0, 0});
  // Reaches through the mirror, from 2 m behind it to 1 m before it.
  addCube(glm::scale(glm::translate(mat4(1.f), vec3(1.2f, 0, -4.5f)), vec3(0.4f, 0.4f, 3.f)))
      .emissive = vec3(0, 1, 0);
  const Image image = radiance(scene_, reflecting());
  EXPECT_EQ(middleOf(image), vec3(0.f));
  int green = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      EXPECT_NE(at(image, x, y), vec3(1, 0, 0));
      green += at(image, x, y).y > 0.5f;
    }
  scene_.objects.pop_back();
  addCube(glm::scale(glm::translate(mat4(1.f), vec3(1.2f, 0, -3.5f)), vec3(0.4f, 0.4f, 1.f)))
      .emissive = vec3(0, 1, 0);
  const Image cut = radiance(scene_, reflecting());
  int expected = 0;
  for (int y = 0; y < cut.height(); ++y)
    for (int x = 0; x < cut.width(); ++x) expected += at(cut, x, y).y > 0.5f;
  EXPECT_GT(green, 20);
  EXPECT_EQ(green, expected);
}

// The trap "clip plane missing in depth-only drawing".
TEST_F(Mirrors, ClipInDepthAlone) {
  addCard(facing({0, 0, -5}, {0, 0, 1}, vec3(9.f)), {1, 0, 0});  // behind the plane
  addCube(glm::translate(mat4(1.f), vec3(0, 0, -2))).doubleSided = true;
  scene_.materials[0].doubleSided = true;
  testing::SceneRenderer renderer(scene_);
  gpu::Device& device = testing::device();
  render::ViewData view;
  const scene::View reflected =
      reflectedView(viewOf(scene_, scene_.cameras[0], 1.f), {0, 0, 1, 4}, 1e-5f, scene_.boundsW());
  updateView(device, view, reflected, kSize);
  render::DrawLists lists;
  const std::array<std::uint32_t, 2> all{0, 1};
  makeLists(device, renderer.gpuScene, reflected, all, true, lists);
  const gpu::Texture depth = device.createTexture(
      {.format = gpu::Format::Depth32F, .width = kSize.x, .height = kSize.y}, "depth alone");
  render::ObjectPrograms programs(device, "render/depth.frag");
  {
    gpu::Rendering rendering =
        device.render({.colors = {}, .depth = {.texture = &depth, .load = gpu::Load::Clear}});
    rendering.buffer("ViewBlock", view.block);
    drawList(rendering, renderer.gpuScene, lists.opaque, {.depthTest = true, .depthWrite = true},
             [&](const scene::Material& material) { return &programs.of(material); });
  }
  const Image found = device.download(depth);
  // The cube's far side in the mirror, 2.5 m behind it, and nothing around it.
  EXPECT_NEAR(*found.pixel<float>(32, 32), reflected.near / 5.5f, 1e-4f);
  EXPECT_EQ(*found.pixel<float>(2, 2), 0.f);
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

TEST_F(Mirrors, WithoutReflectivityChangeNothing) {
  scene_ = testing::sampleScene();
  const Image expected = radiance(scene_, plain());
  EXPECT_TRUE(equal(radiance(scene_, reflecting()), expected));
  scene_.materials[1].reflectivity = 0.5f;
  EXPECT_FALSE(equal(radiance(scene_, reflecting()), expected));
}

// Not even of one that shines without bounds.
TEST_F(Mirrors, ThatReflectAllLeaveNoTraceOfTheirMaterial) {
  scene_ = testing::sampleScene();
  scene_.meshes.push_back(sheetMesh());
  addMirror(facing({0, 1, -3}, {0, 0, 1}, vec3(6.f)));
  const Image expected = radiance(scene_, reflecting());
  scene_.materials.back().emissive = vec3(1e30f);
  scene_.materials.back().albedo = vec4(1.f);
  EXPECT_TRUE(equal(radiance(scene_, reflecting()), expected));
  EXPECT_FALSE(equal(radiance(scene_, plain()), expected));
}

TEST_F(Mirrors, ThatReflectInPartMixBothByTheirShares) {
  scene::Material& mirror = addMirror();
  mirror.emissive = {2, 0, 1};
  addCard(kBehindTheCamera, {0.5f, 1.f, 0.25f});
  for (const float share : {0.25f, 0.5f, 0.75f}) {
    scene_.materials[0].reflectivity = share;
    const vec3 expected = (1 - share) * vec3(2, 0, 1) + share * vec3(0.5f, 1.f, 0.25f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(middle()[c], expected[c], 2e-3f) << share;
  }
}

// Groups of green pixels that touch.
int greenImagesOf(const Image& image) {
  std::vector<bool> open;  // green and in no group yet
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) open.push_back(at(image, x, y).y > 0.5f);
  int count = 0;
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (!open[first]) continue;
    ++count;
    std::vector<std::size_t> group{first};
    const auto width = static_cast<std::size_t>(image.width());
    while (!group.empty()) {
      const std::size_t pixel = group.back();
      group.pop_back();
      if (pixel >= open.size() || !open[pixel]) continue;
      open[pixel] = false;
      for (const std::size_t next : {pixel - 1, pixel + 1, pixel - width, pixel + width})
        group.push_back(next);
    }
  }
  return count;
}

// Two mirrors face each other, the eye and a two-sided card between them: one more image for each
// reflection.
TEST_F(Mirrors, InMirrorsShowOneImageMoreForEachReflection) {
  constexpr uvec2 kPicture{384, 192};
  addMirror(facing({0, 0, -4}, {0, 0, 1}, vec3(10.f)));
  addMirror(facing({0, 0, 0.8f}, {0, 0, -1}, vec3(10.f)));
  addCard(facing({1.7f, 0.3f, -2}, {0, 0, 1}, vec3(0.3f)), {0, 1, 0});
  scene_.materials.back().doubleSided = true;
  EXPECT_EQ(greenImagesOf(radiance(scene_, plain(), kPicture)), 1);
  for (const int depth : {1, 2, 3, 4})
    EXPECT_EQ(greenImagesOf(radiance(scene_, reflecting(depth), kPicture)), 1 + depth);
}

// From behind a single-sided mirror is not there and a double-sided one reflects that side.
TEST_F(Mirrors, SeenFromBehind) {
  addMirror(facing({0, 0, -4}, {0, 0, -1}, vec3(4.f)));
  addCard(kBehindTheCamera, {1, 0, 0});
  addCard(facing({0, 0, -6}, {0, 0, 1}, vec3(4.f)), {0, 0, 1});
  EXPECT_EQ(middle(), vec3(0, 0, 1)) << "what stands behind it";
  graph::Pipeline pipeline = reflecting();
  pipeline.passes[1].params["backFaces"] = true;
  pipeline.passes[3].params["backFaces"] = true;
  EXPECT_EQ(middle(pipeline), vec3(1, 0, 0));
  scene_.materials[0].doubleSided = true;
  EXPECT_EQ(middle(), vec3(1, 0, 0));
}

TEST_F(Mirrors, AreHiddenByWhatStandsBeforeThem) {
  addMirror();
  addCard(facing({0, 0, 3}, {0, 0, -1}, vec3(6.f)), {1, 0, 0});
  addCard(facing({0, 0, -2}, {0, 0, 1}, vec3(0.5f)), {0, 0, 1});
  const Image image = radiance(scene_, reflecting());
  EXPECT_EQ(middleOf(image), vec3(0, 0, 1));
  EXPECT_EQ(at(image, 32, 18), vec3(1, 0, 0)) << "above it";
}

// The camera leans so that no two things are at one place.
TEST_F(Mirrors, DoNotDependOnTheOrderOfObjects) {
  const auto loaded = scene::loadScene("builtin:mirrors");
  ASSERT_TRUE(loaded);
  scene_ = *loaded;
  const Image expected = radiance(scene_, reflecting(3), {128, 72});
  Random random(1);
  for (auto i = static_cast<std::uint32_t>(scene_.objects.size()) - 1; i > 0; --i)
    std::swap(scene_.objects[i], scene_.objects[random.below(i + 1)]);
  EXPECT_TRUE(equal(radiance(scene_, reflecting(3), {128, 72}), expected));
}

TEST_F(Mirrors, MayStandTwiceAndBeSwitchedOff) {
  scene_ = testing::sampleScene();
  scene_.meshes.push_back(sheetMesh());
  addMirror(facing({0, 1, -3}, {0, 0, 1}, vec3(6.f)));
  const Image once = radiance(scene_, reflecting());
  graph::Pipeline twice = reflecting();
  twice.passes.insert(twice.passes.begin() + 4, twice.passes[3]);
  twice.passes[4].name = "Again";
  EXPECT_TRUE(equal(radiance(scene_, twice), once));
  graph::Pipeline off = reflecting();
  off.passes[3].enabled = false;
  EXPECT_TRUE(equal(radiance(scene_, off), radiance(scene_, plain())));
}

// What the eye sees in the mirror straight ahead is the face of the cube map behind it.
TEST_F(Mirrors, ShowTheBackgroundOfTheirDirection) {
  scene_.background.kind = scene::BackgroundKind::CubeMap;
  scene::Texture& cube = scene_.textures.emplace_back();
  for (int face = 0; face < 6; ++face) {
    Image image(4, 4, 4, ComponentType::F32);
    for (int i = 0; i < 16; ++i)
      std::ranges::fill(image.as<float>().subspan(static_cast<std::size_t>(4 * i), 3),
                        0.25f * static_cast<float>(face + 1));
    cube.faces.push_back(std::make_shared<const Image>(std::move(image)));
  }
  cube.image = cube.faces[0];
  scene_.background.texture = 0;
  addMirror(facing({0, 0, -4}, {0, 0, 1}, vec3(1.f)));
  EXPECT_EQ(middle().x, 0.25f * 5) << "+z";
  scene_.objects.clear();
  addMirror(facing({0, 0, -4}, glm::normalize(vec3(1, 0, 1)), vec3(1.f)));
  EXPECT_EQ(middle().x, 0.25f * 1) << "+x";
}

// A pane that is a box reflects with each of its faces.
TEST_F(Mirrors, MayHaveSeveralFaces) {
  scene::Material& cube =
      addCube(glm::rotate(glm::translate(mat4(1.f), vec3(0, 0, -4)), kPi / 4, vec3(0, 1, 0)) *
              glm::scale(mat4(1.f), vec3(2.f)));
  cube.reflectivity = 1.f;
  addCard(facing({-6, 0, -4}, {1, 0, 0}, vec3(6.f)), {1, 0, 0});
  addCard(facing({6, 0, -4}, {-1, 0, 0}, vec3(6.f)), {0, 1, 0});
  const Image image = radiance(scene_, reflecting(1));
  EXPECT_EQ(at(image, 26, 32), vec3(1, 0, 0));
  EXPECT_EQ(at(image, 38, 32), vec3(0, 1, 0));
}

}  // namespace
}  // namespace lucerna
