// What four moments of depths tell, against the depths themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "support/testing.hpp"

namespace lucerna::gpu {
std::span<const EmbeddedShader> embeddedShaders_render_gl_test();
}

namespace lucerna::render {
namespace {

using gpu::Format;
using testing::device;

constexpr int kSide = 64;  // cases, squared

struct Atom {
  double z, weight;
};
struct Case {
  std::vector<Atom> atoms;
  double z;  // what is looked up

  double share() const {
    double sum = 0;
    for (const Atom& atom : atoms) sum += atom.z < z ? atom.weight : 0;
    return sum;
  }
  double mean() const {
    double sum = 0;
    for (const Atom& atom : atoms) sum += atom.z < z ? atom.weight * atom.z : 0;
    return sum / share();
  }
};

struct Before {
  double share, mean;
};

class Moments : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    device().shaderSources().add(gpu::embeddedShaders_render_gl_test());
  }
  void TearDown() override {
    for (const Error& fault : device().takeErrors()) ADD_FAILURE() << fault.message;
    testing::expectNoDebugMessages();
  }

  static gpu::Texture uploaded(const Image& image, Format format) {
    gpu::Texture texture =
        device().createTexture({.format = format, .width = kSide, .height = kSide}, "test input");
    device().upload(texture, image);
    return texture;
  }

  static std::vector<Before> told(const std::vector<Case>& cases) {
    Image moments(kSide, kSide, 4, ComponentType::F32), depths(kSide, kSide, 1, ComponentType::F32);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      for (const Atom& atom : cases[i].atoms)
        for (int power = 1; power <= 4; ++power)
          moments.as<float>()[4 * i + static_cast<std::size_t>(power) - 1] +=
              static_cast<float>(atom.weight * std::pow(atom.z, power));
      depths.as<float>()[i] = static_cast<float>(cases[i].z);
    }
    const gpu::Texture momentTexture = uploaded(moments, Format::Rgba32Float);
    const gpu::Texture depthTexture = uploaded(depths, Format::R32Float);
    const gpu::Texture out = device().createTexture(
        {.format = Format::Rgba32Float, .width = kSide, .height = kSide}, "test");
    const gpu::ProgramPtr program = device().program(
        {.vertex = "gpu/fullscreen.vert", .fragment = "render/test_shaders/moments.frag"});
    {
      gpu::Rendering rendering = device().render({.colors = {{&out}}});
      rendering.use(*program, {.cull = gpu::Cull::None});
      rendering.texture("moments", momentTexture, gpu::kNearest);
      rendering.texture("depths", depthTexture, gpu::kNearest);
      rendering.fullscreen();
    }
    const Image found = device().download(out, 0, false);
    std::vector<Before> result;
    for (std::size_t i = 0; i < cases.size(); ++i)
      result.push_back({found.as<float>()[4 * i], found.as<float>()[4 * i + 1]});
    return result;
  }

  // Depths at random; their weights add up to 1.
  std::vector<Atom> atoms(int count) {
    std::vector<Atom> made;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      made.push_back({random.uniform(-1.f, 1.f), random.uniform(0.01f, 1.f)});
      sum += made.back().weight;
    }
    for (Atom& atom : made) atom.weight /= sum;
    return made;
  }

  Random random{5};
};

// However many depths there are, no more shadow is told than there is.
TEST_F(Moments, NeverTellMoreThanThereIsBefore) {
  std::vector<Case> cases;
  for (int i = 0; i < kSide * kSide; ++i)
    cases.push_back({atoms(1 + i % 20), random.uniform(-1.f, 1.f)});
  const std::vector<Before> found = told(cases);
  double most = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ASSERT_LE(found[i].share, cases[i].share() + 1e-4) << i;
    ASSERT_GE(found[i].share, 0.);
    most = std::max(most, found[i].share);
  }
  EXPECT_GT(most, 0.9);
}

// Of two depths, of which the second may be the surface itself.
std::vector<Case> pairs(Random& random, double behind) {
  std::vector<Case> cases;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double first = random.uniform(-1.f, 0.4f);
    const double second = first + random.uniform(0.1f, 0.3f);
    const double p = random.uniform(0.05f, 0.95f);
    cases.push_back({{{first, p}, {second, 1 - p}}, second + behind});
  }
  return cases;
}

TEST_F(Moments, OfABlockerAndTheSurfaceTellTheBlocker) {
  const std::vector<Case> cases = pairs(random, 0.);
  const std::vector<Before> found = told(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ASSERT_NEAR(found[i].share, cases[i].atoms[0].weight, 2e-3) << i;
    ASSERT_NEAR(found[i].mean, cases[i].atoms[0].z, 2e-3) << i;
  }
}

// What leaks behind two blockers at a and b is due to the small share of depths that is taken to be
// spread evenly, for numbers' sake: at most its mean of P^2 with P = (x - a) (x - b) / ((z - a) (z
// - b)), as P is 1 at z and 0 at the blockers.
TEST_F(Moments, BehindTwoBlockersHardlyAnythingLeaks) {
  constexpr double kSpread = 2e-6, kRounding = 1e-3;
  const std::vector<Case> cases = pairs(random, 0.1);
  const std::vector<Before> found = told(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    double spread = 0;
    constexpr int kSteps = 1000;
    for (int step = 0; step < kSteps; ++step) {
      const double x = -1 + 2 * (step + 0.5) / kSteps;
      const double p =
          (x - c.atoms[0].z) * (x - c.atoms[1].z) / ((c.z - c.atoms[0].z) * (c.z - c.atoms[1].z));
      spread += p * p / kSteps;
    }
    ASSERT_LE(1 - found[i].share, kSpread * spread + kRounding) << i;
    ASSERT_NEAR(found[i].mean, c.mean(), 2e-3) << i;
  }
}

// It is dark a hundredth of the range behind a blocker.
TEST_F(Moments, OfOneDepthResolveAHundredthOfTheRange) {
  std::vector<Case> cases;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double z = random.uniform(-0.95f, 0.9f);
    cases.push_back({{{z, 1}}, z + 0.02});
  }
  double least = 1;
  for (const Before& before : told(cases)) least = std::min(least, before.share);
  EXPECT_GT(least, 0.99);
}

// A plane that lies askew: of depths around a place, taken nearer by their deviation, none is
// before.
TEST_F(Moments, ADeviationBeforeASpreadOfDepthsNoneIsBefore) {
  std::vector<Case> cases;
  for (int i = 0; i < kSide * kSide; ++i) {
    Case c;
    const double middle = random.uniform(-0.7f, 0.7f);
    const double step = std::pow(10., random.uniform(-4.f, -1.4f));
    double sum = 0, squares = 0;
    for (int tap = -5; tap <= 5; ++tap) {
      c.atoms.push_back({middle + step * tap, std::exp(-0.5 * tap * tap / 4.)});
      sum += c.atoms.back().weight;
    }
    for (Atom& atom : c.atoms) {
      atom.weight /= sum;
      squares += atom.weight * std::pow(atom.z - middle, 2);
    }
    c.z = middle - 1.01 * std::sqrt(squares);
    cases.push_back(c);
  }
  for (const Before& before : told(cases)) ASSERT_LT(before.share, 1e-3);
}

}  // namespace
}  // namespace lucerna::render
