#include "app/bench/visibility_error.hpp"

#include <algorithm>
#include <cmath>

#include "image/metrics.hpp"

namespace lucerna::app::bench {
namespace {

constexpr float kDarkest = 0.02f, kClearest = 0.98f;  // of a penumbra's visibility
constexpr float kWrong = 0.1f;                        // difference of a halo's pixel
constexpr float kJump = 0.02f;                        // share of the depth

Image mask(int width, int height) {
  return Image(width, height, 1, ComponentType::U8);
}

// Grey in three channels; 1 where not lit, so that windows of metrics find no difference there.
Image grey(const Image& visibility, const Image& lit, bool encoded) {
  Image picture(visibility.width(), visibility.height(), 3, ComponentType::F32);
  const auto values = visibility.as<float>();
  const auto counts = lit.as<std::uint8_t>();
  const auto out = picture.as<float>();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = counts[i] == 0 ? 1.f : std::clamp(values[i], 0.f, 1.f);
    std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                encoded ? srgbFromLinear(value) : value);
  }
  return picture;
}

Image penumbraMask(const VisibilityPair& pair) {
  Image result = mask(pair.reference.width(), pair.reference.height());
  const auto values = pair.reference.as<float>();
  const auto lit = pair.lit.as<std::uint8_t>();
  const auto out = result.as<std::uint8_t>();
  for (std::size_t i = 0; i < values.size(); ++i)
    out[i] = lit[i] != 0 && values[i] > kDarkest && values[i] < kClearest ? 255 : 0;
  return result;
}

double percent(double part, double whole) {
  return whole > 0 ? 100 * part / whole : 0;
}

// Between b and c, whose neighbours on the same line are a and d.
bool depthJumps(float a, float b, float c, float d) {
  const auto apart = [](float guess, float depth, float scale) {
    return std::abs(guess - depth) > kJump * scale;
  };
  return apart(2 * b - a, c, std::max(b, c)) && apart(2 * c - d, b, std::max(b, c));
}

// Pixels on both sides of each edge.
Image depthEdges(const Image& depth) {
  const int width = depth.width(), height = depth.height();
  Image edges = mask(width, height);
  const auto at = [&](int x, int y) {
    return *depth.pixel<float>(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const ivec2 step : {ivec2(1, 0), ivec2(0, 1)}) {
        const ivec2 next = ivec2(x, y) + step;
        if (next.x >= width || next.y >= height) continue;
        if (!depthJumps(at(x - step.x, y - step.y), at(x, y), at(next.x, next.y),
                        at(next.x + step.x, next.y + step.y)))
          continue;
        *edges.pixel<std::uint8_t>(x, y) = 255;
        *edges.pixel<std::uint8_t>(next.x, next.y) = 255;
      }
  return edges;
}

// Pixel centres lie at whole numbers.
std::optional<float> bilinear(const Image& image, vec2 at) {
  const ivec2 corner(glm::floor(at));
  if (corner.x < 0 || corner.y < 0 || corner.x + 1 >= image.width() ||
      corner.y + 1 >= image.height())
    return std::nullopt;
  const vec2 share = at - vec2(corner);
  const auto value = [&](int x, int y) { return *image.pixel<float>(corner.x + x, corner.y + y); };
  return glm::mix(glm::mix(value(0, 0), value(1, 0), share.x),
                  glm::mix(value(0, 1), value(1, 1), share.x), share.y);
}

std::optional<vec2> pixelOf(const scene::View& view, vec3 positionW, const Image& image) {
  const vec4 clip = view.clipFromWorld() * vec4(positionW, 1.f);
  if (clip.w <= 0) return std::nullopt;
  const vec2 ndc = vec2(clip) / clip.w;
  return vec2(0.5f + 0.5f * ndc.x, 0.5f - 0.5f * ndc.y) * vec2(image.width(), image.height()) -
         0.5f;
}

}  // namespace

std::optional<PenumbraError> penumbraError(const VisibilityPair& pair, int fewest) {
  const Image inside = penumbraMask(pair);
  if (std::ranges::count(inside.as<std::uint8_t>(), 255) < fewest) return std::nullopt;
  const PixelMetrics metrics = pixelMetrics(grey(pair.reference, pair.lit, false),
                                            grey(pair.test, pair.lit, false), &inside);
  const ErrorMap flip =
      flipLdr(grey(pair.reference, pair.lit, true), grey(pair.test, pair.lit, true), {}, &inside);
  return PenumbraError{.flip = flip.mean, .psnr = metrics.psnr, .ssim = metrics.ssim};
}

void ShadowFaults::add(const ShadowFaults& other) {
  lit += other.lit;
  dark += other.dark;
  leak += other.leak;
  clear += other.clear;
  loss += other.loss;
  halo += other.halo;
}

double ShadowFaults::leakPercent() const {
  return percent(leak, dark);
}
double ShadowFaults::falseShadowPercent() const {
  return percent(loss, clear);
}
double ShadowFaults::haloPercent() const {
  return percent(halo, lit);
}

ShadowFaults shadowFaults(const VisibilityPair& pair, const Image& nearEdge) {
  ShadowFaults faults;
  const auto reference = pair.reference.as<float>(), test = pair.test.as<float>();
  const auto lit = pair.lit.as<std::uint8_t>(), near = nearEdge.as<std::uint8_t>();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (lit[i] == 0) continue;
    ++faults.lit;
    if (reference[i] <= 0.f) {
      ++faults.dark;
      faults.leak += static_cast<double>(test[i]);
    }
    if (reference[i] >= 1.f) {
      ++faults.clear;
      faults.loss += static_cast<double>(1.f - test[i]);
    }
    if (near[i] != 0 && std::abs(test[i] - reference[i]) > kWrong) ++faults.halo;
  }
  return faults;
}

Image nearDepthEdges(const Image& reversedDepth, int within) {
  const Image edges = depthEdges(reversedDepth);
  Image near = mask(edges.width(), edges.height());
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x) {
      if (*edges.pixel<std::uint8_t>(x, y) == 0) continue;
      for (int v = std::max(y - within, 0); v <= std::min(y + within, edges.height() - 1); ++v)
        for (int u = std::max(x - within, 0); u <= std::min(x + within, edges.width() - 1); ++u)
          *near.pixel<std::uint8_t>(u, v) = 255;
    }
  return near;
}

double flickerOf(const Image& before, const Image& now, const Image& after) {
  const auto a = before.as<float>(), b = now.as<float>(), c = after.as<float>();
  double sum = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    sum += std::abs(static_cast<double>(a[i]) - 2 * static_cast<double>(b[i]) +
                    static_cast<double>(c[i]));
  return b.empty() ? 0 : sum / static_cast<double>(b.size());
}

double largestDifference(const Image& a, const Image& b, const Image& lit) {
  const auto first = a.as<float>(), second = b.as<float>();
  const auto counts = lit.as<std::uint8_t>();
  float largest = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (counts[i] != 0) largest = std::max(largest, std::abs(first[i] - second[i]));
  return static_cast<double>(largest);
}

// Behind an edge at t, from -1 to 1 across a disc, the share 1/2 + (t sqrt(1 - t^2) + asin t) / pi
// of it is seen: 1/4 and 3/4 at t = -+0.404.
std::optional<double> penumbraWidth(const Image& visibility, const scene::View& view, vec3 litW,
                                    vec3 darkW) {
  constexpr float kHalfOfDisc = 0.40397f;
  constexpr int kSteps = 600;
  std::optional<float> upper, lower;  // where it passes 3/4 and 1/4, as shares of the whole
  float before = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const float share = -1.f + 3.f * static_cast<float>(i) / kSteps;
    const auto pixel = pixelOf(view, glm::mix(litW, darkW, share), visibility);
    const auto value = pixel ? bilinear(visibility, *pixel) : std::nullopt;
    if (!value) return std::nullopt;
    if (i > 0 && before >= 0.75f && *value < 0.75f && !upper) upper = share;
    if (i > 0 && before >= 0.25f && *value < 0.25f && upper) lower = share;
    before = *value;
  }
  if (!upper || !lower) return std::nullopt;
  return static_cast<double>((*lower - *upper) / kHalfOfDisc * glm::distance(litW, darkW));
}

}  // namespace lucerna::app::bench
