#include "app/bench/supersampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/parallel.hpp"

namespace lucerna::app::bench {
namespace {

constexpr std::size_t kRowsPerTask = 8;
// In the sizes of a sample: change of distance, beside a plane's, that is an edge.
constexpr float kJump = 0.5f;

// Samples along a pixel's side.
int samplesAcross(const Image& samples, uvec2 size) {
  const int across = samples.width() / static_cast<int>(size.x);
  CHECK(across > 0 && uvec2(samples.width(), samples.height()) == size * static_cast<uint>(across),
        "{}x{} samples do not fill {}x{} pixels", samples.width(), samples.height(), size.x,
        size.y);
  return across;
}

void forEachPixel(uvec2 size, const std::function<void(int x, int y)>& visit) {
  parallelFor(size.y, kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < static_cast<int>(size.x); ++x) visit(x, y);
  });
}

// Reversed depth is linear over a plane, so its second difference is 0 there; it falls with the
// distance as samples grow with it. Samples at the picture's border are as their inner neighbours.
bool isEdge(const Image& depth, ivec2 sample, ivec2 step, float sampleAngle) {
  const ivec2 last(depth.width() - 1, depth.height() - 1);
  const auto at = [&](ivec2 place) { return *depth.pixel<float>(place.x, place.y); };
  const ivec2 inner = glm::clamp(sample, step, last - step);
  const float middle = at(inner);
  return std::abs(at(inner - step) + at(inner + step) - 2.f * middle) >
         kJump * sampleAngle * middle;
}

}  // namespace

Image meanOfSamples(const Image& samples, uvec2 size) {
  const int across = samplesAcross(samples, size);
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = linearFromSrgb(static_cast<float>(i) / 255.f);
  Image mean(static_cast<int>(size.x), static_cast<int>(size.y), 3, ComponentType::F32);
  forEachPixel(size, [&](int x, int y) {
    vec3 sum(0.f);
    for (int i = 0; i < across * across; ++i) {
      const auto* bytes =
          samples.pixel<std::uint8_t>(across * x + i % across, across * y + i / across);
      sum += vec3(linear[bytes[0]], linear[bytes[1]], linear[bytes[2]]);
    }
    for (int c = 0; c < 3; ++c)
      mean.pixel<float>(x, y)[c] = srgbFromLinear(sum[c] / static_cast<float>(across * across));
  });
  return mean;
}

Image edgesOfSamples(const Image& depth, const scene::View& view, uvec2 size) {
  const int across = samplesAcross(depth, size);
  const float sampleAngle = 2.f / (static_cast<float>(depth.height()) * view.clipFromView[1][1]);
  Image edges(static_cast<int>(size.x), static_cast<int>(size.y), 1, ComponentType::U8);
  forEachPixel(size, [&](int x, int y) {
    bool found = false;
    for (int i = 0; i < across * across && !found; ++i) {
      const ivec2 sample(across * x + i % across, across * y + i / across);
      found =
          isEdge(depth, sample, {1, 0}, sampleAngle) || isEdge(depth, sample, {0, 1}, sampleAngle);
    }
    *edges.pixel<std::uint8_t>(x, y) = found ? 255 : 0;
  });
  return edges;
}

}  // namespace lucerna::app::bench
