// The reference against Blender's Cycles, which shares nothing with it: pictures of tests/cycles,
// made by tools/cycles_pictures.py. Reflectance, light units and sizes, cameras.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "core/file.hpp"
#include "core/json_value.hpp"
#include "image/image_file.hpp"
#include "image/metrics.hpp"
#include "scene/load.hpp"
#include "trace/reference.hpp"

namespace lucerna::trace {
namespace {

const std::filesystem::path kFolder = LUCERNA_SOURCE_DIR "/tests/cycles";

// Of pictures.json.
struct Fixture {
  scene::Scene scene;
  ReferenceSettings settings;
  Image truth;  // F32 RGB
};

Fixture fixtureOf(const std::string& wanted) {
  Fixture fixture;
  const auto path = kFolder / "pictures.json";
  auto document = JsonDocument::parse(readText(path).value(), path.string(), ErrorKind::Input);
  for (const JsonValue& entry : document->root().elements()) {
    std::string name, scene, camera;
    vec2 size(0.f);
    entry.read("name", name);
    if (name != wanted) continue;
    entry.read("scene", scene);
    entry.read("camera", camera);
    entry.read("size", size);
    entry.read("lensRadius", fixture.settings.lensRadius);
    entry.read("focusDistance", fixture.settings.focusDistance);
    fixture.settings.size = size;
    fixture.truth = readImage(kFolder / (name + ".exr")).value();
    fixture.scene = scene::loadScene((kFolder / (scene + ".obj")).string()).value();
    std::erase_if(fixture.scene.cameras, [&](const auto& c) { return c.name != camera; });
  }
  CHECK(fixture.scene.cameras.size() == 1, "{}: no picture '{}'", path.string(), wanted);
  return fixture;
}

// moved: pixels to the right of where the camera's picture is.
Image render(const Fixture& fixture, float moved = 0.f) {
  ReferenceSettings settings = fixture.settings;
  const vec2 size(settings.size);
  settings.view = viewOf(fixture.scene, fixture.scene.cameras[0], size.x / size.y);
  settings.view.clipFromView =
      glm::translate(mat4(1.f), vec3(2.f * moved / size.x, 0, 0)) * settings.view.clipFromView;
  return renderReference(fixture.scene, settings).color;
}

// Mean absolute difference as a share of the mean.
double difference(const Image& truth, const Image& test) {
  const auto a = truth.as<float>(), b = test.as<float>();
  CHECK(a.size() == b.size());
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += static_cast<double>(std::abs(a[i] - b[i]));
    all += static_cast<double>(a[i]);
  }
  return sum / all;
}

struct Fault {
  const char* name;
  std::function<void(Fixture&)> make;
};

// A picture agrees within `limit`, and with each fault no more, nor half a pixel beside its place.
// What is left is noise (docs/user/reference.md): a limit is some 1.5 times of it.
void check(const std::string& name, int samples, double limit, const std::vector<Fault>& faults) {
  Fixture fixture = fixtureOf(name);
  fixture.settings.samples = samples;
  const Image picture = render(fixture);
  const double found = difference(fixture.truth, picture);
  const double psnr = pixelMetrics(fixture.truth, picture).psnr;
  const double flip = flipHdr(fixture.truth, picture).map.mean;
  fmt::print("{}: {:.5f}, PSNR {:.1f} dB, FLIP {:.5f}\n", name, found, psnr, flip);
  EXPECT_LT(found, limit);
  EXPECT_GT(psnr, 55.);
  EXPECT_LT(flip, 0.008);
  const auto disagrees = [&](const char* fault, const Image& faulty) {
    const double error = difference(fixture.truth, faulty);
    fmt::print("  {}: {:.5f}\n", fault, error);
    EXPECT_GT(error, limit) << fault;
  };
  disagrees("half a pixel beside", render(fixture, 0.5f));
  for (const Fault& fault : faults) {
    Fixture faulty = fixture;
    fault.make(faulty);
    disagrees(fault.name, render(faulty));
  }
}

scene::Light& lightOf(Fixture& fixture, const std::string& name) {
  return *std::ranges::find(fixture.scene.lights, name, &scene::Light::name);
}

void forMaterials(Fixture& fixture, const std::function<void(scene::Material&)>& change) {
  std::ranges::for_each(fixture.scene.materials, change);
}

const Fault kBrighter{"5 % more light", [](Fixture& f) {
                        for (scene::Light& light : f.scene.lights) light.intensity *= 1.05f;
                      }};

TEST(Cycles, AgreesAboutReflectance) {
  check("brdf", 256, 0.0006,
        {kBrighter,
         {"rougher by 0.01",
          [](Fixture& f) { forMaterials(f, [](auto& m) { m.roughness += 0.01f; }); }},
         {"2 % darker", [](Fixture& f) { forMaterials(f, [](auto& m) { m.albedo *= 0.98f; }); }},
         {"more metallic by 0.02", [](Fixture& f) {
            forMaterials(f, [](auto& m) { m.metallic = std::min(m.metallic + 0.02f, 1.f); });
          }}});
}

TEST(Cycles, AgreesAboutLights) {
  check("lights", 512, 0.0018,
        {kBrighter,
         {"a sphere 20 % larger", [](Fixture& f) { lightOf(f, "sphere").radius *= 1.2f; }},
         {"a disc 20 % larger", [](Fixture& f) { lightOf(f, "disc").radius *= 1.2f; }},
         {"a sun 50 % larger", [](Fixture& f) { lightOf(f, "sun").angle *= 1.5f; }},
         {"a cone wider by a degree", [](Fixture& f) {
            lightOf(f, "disc").innerCone += glm::radians(1.f);
            lightOf(f, "disc").outerCone += glm::radians(1.f);
          }}});
}

TEST(Cycles, AgreesAboutCameras) {
  const Fault narrower{"1 % narrower", [](Fixture& f) {
                         f.scene.cameras[0].fovY *= 0.99f;
                         f.scene.cameras[0].height *= 0.99f;
                       }};
  const Fault duller{"mirrors of 0.02 less", [](Fixture& f) {
                       forMaterials(f, [](auto& m) {
                         if (m.reflectivity > 0.f) m.reflectivity -= 0.02f;
                       });
                     }};
  check("perspective", 256, 0.001, {kBrighter, narrower, duller});
  check("orthographic", 256, 0.0006, {kBrighter, narrower});
  check("lens", 512, 0.0027,
        {kBrighter,
         narrower,
         {"a lens 10 % larger", [](Fixture& f) { f.settings.lensRadius *= 1.1f; }},
         {"in focus 5 % farther", [](Fixture& f) { f.settings.focusDistance *= 1.05f; }}});
}

}  // namespace
}  // namespace lucerna::trace
