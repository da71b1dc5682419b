#include "support/mirrors.hpp"

#include <array>
#include <limits>
#include <utility>

#include "core/random.hpp"
#include "render/draw_list.hpp"
#include "render/object_programs.hpp"
#include "scene/load.hpp"

namespace lucerna {
namespace {

// A card behind the camera that faces the mirror.
const mat4 kBehindTheCamera = facing({0, 0, 3}, {0, 0, -1}, vec3(2.f));

TEST_F(Mirrors, ShowWhatStandsBehindTheCamera) {
  addMirror();
  addCard(kBehindTheCamera, {0.5f, 0.25f, 1.f});
  EXPECT_TRUE(near(middle(), vec3(0.5f, 0.25f, 1.f)));
  EXPECT_TRUE(near(middle(plain()), vec3(0.f)));
}

// The trap "mirror winding": the mirror shows the front of a single-sided sheet that turns its back
// to the eye, and nothing of one that shows it its front. Also where the sheet's matrix mirrors.
TEST_F(Mirrors, ShowFrontFacesAndNoBackFaces) {
  for (const float side : {1.f, -1.f}) {
    scene_.objects.clear();
    addMirror();
    addCard(facing({0, 0, 3}, {0, 0, -1}, vec3(side * 2.f, 2.f, 2.f)), {1, 0, 0});
    EXPECT_TRUE(near(middle(), vec3(1, 0, 0))) << side;
    scene_.objects.clear();
    addMirror();
    addCard(facing({0, 0, 3}, {0, 0, 1}, vec3(side * 2.f, 2.f, 2.f)), {1, 0, 0});
    EXPECT_TRUE(near(middle(), vec3(0.f))) << side;
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
    red = red || at(image, x, 32).x > 0.5f;
    green = green || at(image, x, 32).y > 0.5f;
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
  EXPECT_TRUE(near(middleOf(image), vec3(0.f)));
  int green = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      EXPECT_LT(at(image, x, y).x, 0.5f);
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
  scene_.materials.back().emissive = vec3(std::numeric_limits<float>::infinity());
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
    EXPECT_TRUE(near(middle(), expected)) << share;
  }
}

// As the rows do that draw what the mirrors reflect.
TEST_F(Mirrors, TakeFactorsOnAmbientLightAndBackground) {
  addMirror();
  graph::Pipeline pipeline = reflecting();
  scene_.background.color = {0.25f, 0.5f, 0.75f};
  pipeline.passes[3].params["background"] = 3.;
  EXPECT_TRUE(near(middle(pipeline), 3.f * scene_.background.color));
  scene_.ambient = vec3(0.5f);
  addSheet(kBehindTheCamera).albedo = vec4(0.5f, 0.25f, 1.f, 1.f);
  pipeline.passes[3].params["ambient"] = 2.;
  EXPECT_TRUE(near(middle(pipeline), vec3(0.5f, 0.25f, 1.f)));
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
  for (const int depth : {1, 2, 3, 4}) {
    const Image image = radiance(scene_, reflecting(depth), kPicture);
    EXPECT_EQ(greenImagesOf(image), 1 + depth);
    // What the budget leaves out shows the mirror's own material, as beyond the depth.
    graph::Pipeline pipeline = reflecting(8);
    pipeline.passes[3].params["budget"] = depth;
    EXPECT_TRUE(equal(radiance(scene_, pipeline, kPicture), image)) << depth;
  }
}

// From behind a single-sided mirror is not there and a double-sided one reflects that side.
TEST_F(Mirrors, SeenFromBehind) {
  addMirror(facing({0, 0, -4}, {0, 0, -1}, vec3(4.f)));
  addCard(kBehindTheCamera, {1, 0, 0});
  addCard(facing({0, 0, -6}, {0, 0, 1}, vec3(4.f)), {0, 0, 1});
  EXPECT_TRUE(near(middle(), vec3(0, 0, 1))) << "what stands behind it";
  graph::Pipeline pipeline = reflecting();
  pipeline.passes[1].params["backFaces"] = true;
  pipeline.passes[3].params["backFaces"] = true;
  EXPECT_TRUE(near(middle(pipeline), vec3(1, 0, 0)));
  scene_.materials[0].doubleSided = true;
  EXPECT_TRUE(near(middle(), vec3(1, 0, 0)));
}

TEST_F(Mirrors, AreHiddenByWhatStandsBeforeThem) {
  addMirror();
  addCard(facing({0, 0, 3}, {0, 0, -1}, vec3(6.f)), {1, 0, 0});
  addCard(facing({0, 0, -2}, {0, 0, 1}, vec3(0.5f)), {0, 0, 1});
  const Image image = radiance(scene_, reflecting());
  EXPECT_TRUE(near(middleOf(image), vec3(0, 0, 1)));
  EXPECT_TRUE(near(at(image, 32, 18), vec3(1, 0, 0))) << "above it";
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
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        std::fill_n(image.pixel<float>(x, y), 3, 0.25f * static_cast<float>(face + 1));
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

// A box reflects with each of its faces, and each shows its own picture, also where another's would
// be beside it.
TEST_F(Mirrors, MayHaveSeveralFaces) {
  mat4 place = glm::translate(mat4(1.f), vec3(0, 0, -4));
  place = glm::rotate(place, kPi / 4, vec3(0, 0, 1));  // the edge that is nearest is a diagonal
  place = glm::rotate(place, kPi / 4, vec3(0, 1, 0));
  addCube(glm::scale(place, vec3(2.f))).reflectivity = 1.f;
  addCard(facing({-6, 0, -4}, {1, 0, 0}, vec3(20.f)), {1, 0, 0});
  addCard(facing({6, 0, -4}, {-1, 0, 0}, vec3(20.f)), {0, 1, 0});
  const Image image = radiance(scene_, reflecting(1));
  EXPECT_TRUE(near(at(image, 26, 32), vec3(1, 0, 0)));
  EXPECT_TRUE(near(at(image, 38, 32), vec3(0, 1, 0)));
}

}  // namespace
}  // namespace lucerna
