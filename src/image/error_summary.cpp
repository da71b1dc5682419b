// Mean and quantiles of an error map.
#include <algorithm>
#include <bit>
#include <cmath>

#include "image/metrics.hpp"

namespace lucerna {
namespace {

// Buckets of the upper bits of floats in [0, 1], which order like the values: quantiles need a look
// at one bucket instead of a sort of all pixels.
constexpr int kDroppedBits = 14;
constexpr std::size_t kBuckets = (0x3f800000u >> kDroppedBits) + 1;

std::size_t bucketOf(float value) {
  return std::bit_cast<std::uint32_t>(value) >> kDroppedBits;
}

struct Bucket {
  std::size_t count = 0;
  double sum = 0;
};

// The least value at which the running total of weight(value) over the ordered values reaches
// `wanted`.
template <typename BucketTotal, typename Weight>
float quantile(std::span<const float> values, std::span<const Bucket> buckets, double wanted,
               BucketTotal bucketTotal, Weight weight) {
  double before = 0;
  std::size_t bucket = 0;
  for (; bucket + 1 < buckets.size(); ++bucket) {
    const double after = before + bucketTotal(buckets[bucket]);
    if (after >= wanted) break;
    before = after;
  }
  std::vector<float> inside;
  for (const float value : values)
    if (bucketOf(value) == bucket) inside.push_back(value);
  std::sort(inside.begin(), inside.end());
  for (const float value : inside) {
    before += weight(value);
    if (before >= wanted) return value;
  }
  return inside.empty() ? 0.f : inside.back();
}

std::vector<float> maskedValues(const Image& error, const Image* mask) {
  const auto all = error.as<float>();
  if (!mask) return {all.begin(), all.end()};
  CHECK(mask->width() == error.width() && mask->height() == error.height() &&
        mask->channels() == 1 && mask->type() == ComponentType::U8);
  const auto used = mask->as<std::uint8_t>();
  std::vector<float> values;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (used[i] != 0) values.push_back(all[i]);
  return values;
}

}  // namespace

ErrorMap summarised(Image error, const Image* mask) {
  CHECK(error.channels() == 1 && error.type() == ComponentType::F32);
  std::vector<float> values = maskedValues(error, mask);
  ErrorMap map;
  map.error = std::move(error);
  if (values.empty()) return map;
  std::vector<Bucket> buckets(kBuckets);
  double sum = 0;
  float least = 1, largest = 0;
  for (float& value : values) {
    value = value > 0 ? std::min(value, 1.f) : 0.f;  // also makes -0 and NaN order like 0
    Bucket& bucket = buckets[bucketOf(value)];
    ++bucket.count;
    bucket.sum += value;
    sum += value;
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  const auto count = static_cast<double>(values.size());
  map.mean = sum / count;
  map.min = least;
  map.max = largest;
  map.p95 = quantile(
      values, buckets, std::ceil(0.95 * count),
      [](const Bucket& bucket) { return static_cast<double>(bucket.count); },
      [](float) { return 1.0; });
  if (sum > 0)
    map.weightedMedian = quantile(
        values, buckets, 0.5 * sum, [](const Bucket& bucket) { return bucket.sum; },
        [](float value) { return static_cast<double>(value); });
  return map;
}

}  // namespace lucerna
