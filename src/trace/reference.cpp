#include "trace/reference.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "trace/tile_tracer.hpp"

namespace lucerna::trace {
namespace {

constexpr int kTileSide = 16;    // px
constexpr int kFirstRound = 16;  // samples before the error is asked for

// What the samples of a pixel add up to.
struct PixelSum {
  double count = 0;
  glm::dvec3 color{0.}, squares{0.}, direct{0.}, reflection{0.};
  double ao = 0;

  void add(const PixelSample& sample) {
    const glm::dvec3 c(sample.color);
    ++count;
    color += c;
    squares += c * c;
    direct += glm::dvec3(sample.direct);
    reflection += glm::dvec3(sample.reflection);
    ao += static_cast<double>(sample.ao);
  }
  vec3 mean() const { return vec3(color / count); }
  vec3 variance() const {
    if (count < 2) return vec3(kInfinity);
    const glm::dvec3 m = color / count;
    return vec3(glm::max(squares / count - m * m, glm::dvec3(0.)) * (count / (count - 1)));
  }
};

std::vector<ivec2> tilesOf(ivec2 size) {
  std::vector<ivec2> corners;
  for (int y = 0; y < size.y; y += kTileSide)
    for (int x = 0; x < size.x; x += kTileSide) corners.emplace_back(x, y);
  return corners;
}

class Film {
 public:
  explicit Film(const TracedScene& traced)
      : traced_(traced),
        size_(traced.settings.size),
        white_(std::exp2(-traced.scene.exposure)),
        pixels_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y)),
        tiles_(tilesOf(size_)),
        progress_("tracing", tiles_.size() * static_cast<std::uint64_t>(traced.settings.samples)) {
    if (traced.settings.visibility) visibility_.resize(pixels_.size() * traced.lights.size());
  }

  // Samples [begin, end) of the pixels that are not exact enough. False if the user ended it.
  bool round(int begin, int end) {
    parallelFor(tiles_.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (!Progress::cancelled()) traceTile(tiles_[i], begin, end);
        progress_.advance(static_cast<std::uint64_t>(end - begin));
      }
    });
    return !Progress::cancelled();
  }

  bool exact() const {
    return traced_.settings.error > 0.f &&
           std::ranges::all_of(pixels_, [&](const PixelSum& p) { return exactEnough(p); });
  }

  ReferencePicture picture() const;

 private:
  std::size_t at(ivec2 pixel) const {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size_.x) +
           static_cast<std::size_t>(pixel.x);
  }

  float error(const PixelSum& pixel) const {
    return pixel.count > 0 ? errorOf(pixel.mean(), pixel.variance(), pixel.count, white_)
                           : kInfinity;
  }
  bool exactEnough(const PixelSum& pixel) const {
    return traced_.settings.error > 0.f && pixel.count >= kFirstRound &&
           error(pixel) <= traced_.settings.error;
  }

  void traceTile(ivec2 corner, int begin, int end);

  const TracedScene& traced_;
  ivec2 size_;
  float white_;
  std::vector<PixelSum> pixels_;
  std::vector<float> visibility_;  // sums; pixel by pixel, light by light
  std::vector<ivec2> tiles_;       // their corners
  Progress progress_;
  std::mutex mutex_;  // of what all threads add to
  RayStatistics rays_;
  double seconds_ = 0;
};

void Film::traceTile(ivec2 corner, int begin, int end) {
  std::vector<ivec2> pixels = packedPixels(corner, glm::min(corner + kTileSide, size_));
  std::erase_if(pixels, [&](ivec2 p) { return exactEnough(pixels_[at(p)]); });
  if (pixels.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  const std::size_t lights = traced_.lights.size();
  TileTracer tracer(traced_);
  std::vector<PixelSample> samples(pixels.size());
  std::vector<float> visibility(visibility_.empty() ? 0 : pixels.size() * lights);
  for (int i = begin; i < end; ++i) {
    std::ranges::fill(samples, PixelSample{});
    tracer.trace(pixels, static_cast<std::uint32_t>(i), samples, visibility);
    for (std::size_t p = 0; p < pixels.size(); ++p) pixels_[at(pixels[p])].add(samples[p]);
  }
  for (std::size_t p = 0; !visibility.empty() && p < pixels.size(); ++p)
    for (std::size_t l = 0; l < lights; ++l)
      visibility_[at(pixels[p]) * lights + l] += visibility[l * pixels.size() + p];
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const std::scoped_lock lock(mutex_);
  rays_.add(tracer.statistics());
  seconds_ += seconds.count();
}

ReferencePicture Film::picture() const {
  ReferencePicture result;
  result.rays = rays_;
  result.seconds = seconds_;
  const auto image = [&](int channels) {
    return Image(size_.x, size_.y, channels, ComponentType::F32);
  };
  result.color = result.direct = result.reflection = image(3);
  result.ao = result.error = image(1);
  result.visibility.assign(visibility_.empty() ? 0 : traced_.lights.size(), image(1));
  for (int y = 0; y < size_.y; ++y)
    for (int x = 0; x < size_.x; ++x) {
      const PixelSum& pixel = pixels_[at({x, y})];
      result.meanSamples += pixel.count;
      if (pixel.count == 0) continue;
      const auto put = [&](Image& to, glm::dvec3 sum) {
        for (int c = 0; c < 3; ++c)
          to.pixel<float>(x, y)[c] = static_cast<float>(sum[c] / pixel.count);
      };
      put(result.color, pixel.color);
      put(result.direct, pixel.direct);
      put(result.reflection, pixel.reflection);
      *result.ao.pixel<float>(x, y) = static_cast<float>(pixel.ao / pixel.count);
      *result.error.pixel<float>(x, y) = error(pixel);
      for (std::size_t l = 0; l < result.visibility.size(); ++l)
        *result.visibility[l].pixel<float>(x, y) =
            visibility_[at({x, y}) * result.visibility.size() + l] /
            static_cast<float>(pixel.count);
    }
  result.meanSamples /= static_cast<double>(pixels_.size());
  return result;
}

}  // namespace

float errorOf(vec3 mean, vec3 variance, double samples, float white) {
  float largest = 0.f;
  for (int c = 0; c < 3; ++c)
    largest = std::max(largest, std::sqrt(variance[c] / static_cast<float>(samples)) /
                                    std::max(mean[c], 0.1f * white));
  return largest;
}

ReferencePicture renderReference(const scene::Scene& scene, const ReferenceSettings& settings) {
  const TracedScene traced(scene, settings);
  Film film(traced);
  // Each round doubles the samples, so that sequences of powers of two are whole in all pixels.
  bool cancelled = false;
  for (int begin = 0, end = std::min(kFirstRound, settings.samples); begin < settings.samples;
       begin = end, end = std::min(2 * end, settings.samples)) {
    cancelled = !film.round(begin, end);
    if (cancelled || film.exact()) break;
  }
  ReferencePicture picture = film.picture();
  picture.cancelled = cancelled;
  return picture;
}

}  // namespace lucerna::trace
