// How wide prefiltered shadow maps are blurred, against the closed form of the kernel: by the two
// passes that make them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "half_plane.hpp"
#include "passes/prefiltered_shadows/prefiltered_shadows.hpp"

namespace lucerna {
namespace {

render::PrefilteredShadows made(const passes::PrefilteredShadows::Params& params) {
  const scene::Scene scene = testing::halfPlane(0.f);
  testing::SceneRenderer renderer(scene);
  auto output = renderer.render(testing::rows({"Cull", "GBuffer", "TiledLighting"}), {64, 64});
  CHECK(static_cast<bool>(output), "{}", output.error().message);
  graph::PassContext context{.device = testing::device()};
  const render::ShadowMaps maps = testing::mapsFor(renderer, {});

  render::PrefilteredShadows shadows;
  passes::PrefilteredShadows::Ports ports;
  ports.shadowMaps.bind(&maps);
  ports.prefilteredShadows.bind(&shadows);
  passes::PrefilteredShadows(testing::device()).execute(context, params, ports);
  return shadows;
}

// The variance of where mean depth changes along the middle row, texels squared. An edge within a
// texel adds up to a quarter.
double edgeVariance(const Image& moments) {
  const int y = moments.height() / 2;
  double sum = 0, first = 0, second = 0;
  for (int x = 0; x + 1 < moments.width(); ++x) {
    const double change = moments.pixel<float>(x + 1, y)[0] - moments.pixel<float>(x, y)[0];
    sum += change, first += change * x, second += change * x * x;
  }
  return second / sum - std::pow(first / sum, 2);
}

// Of a Gaussian's taps, texels of moments squared.
double tapVariance(int kernel, int texels) {
  const int taps = (kernel / 2 + texels - 1) / texels;
  double sum = 0, squares = 0;
  for (int i = -taps; i <= taps; ++i) {
    const double weight = std::exp(-0.5 * std::pow(5. * texels * i / kernel, 2));
    sum += weight, squares += weight * i * i;
  }
  return squares / sum;
}

TEST(PrefilteredKernel, WidensEdgesAsItsClosedFormSays) {
  using enum passes::PrefilteredShadows::Resolution;
  for (const auto resolution : {Full, Half, Quarter})
    for (const int kernel : {1, 5, 11, 23, 47}) {
      const int texels = 1 << static_cast<int>(resolution);
      SCOPED_TRACE(fmt::format("kernel {}, {} texels", kernel, texels));
      const render::PrefilteredShadows shadows =
          made({.penumbra = passes::PrefilteredShadows::Penumbra::Kernel,
                .kernel = kernel,
                .resolution = resolution});
      const double expected = tapVariance(kernel, texels);
      const double found = edgeVariance(testing::device().download(shadows.local));
      EXPECT_GT(found, expected - 0.01);
      EXPECT_LT(found, expected + 0.26);
      // With what the squares of texels and a bilinear tap add.
      EXPECT_NEAR(shadows.deviation, texels * std::sqrt(expected + 1. / 3.), 1e-3);
    }
  testing::expectNoDebugMessages();
}

TEST(PrefilteredKernel, EachLevelAddsWhatItsClosedFormSays) {
  const render::PrefilteredShadows shadows = made({});
  ASSERT_TRUE(shadows.levels);
  const int levels = shadows.local.desc().levels;
  ASSERT_GE(levels, 5);
  const double first = tapVariance(passes::PrefilteredShadows::Params{}.kernel, shadows.texels);
  for (int level = 1; level < levels; ++level) {
    const double texel = std::pow(4., level);  // squared, in those of the first level
    const double expected = first + (texel - 1.) / 4.;
    const double found =
        texel * edgeVariance(testing::device().download(shadows.local, 0, true, level));
    EXPECT_GT(found, expected - 0.02 * texel) << level;
    EXPECT_LT(found, expected + 0.27 * texel) << level;
  }
  testing::expectNoDebugMessages();
}

}  // namespace
}  // namespace lucerna
