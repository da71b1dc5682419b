// Blocks of BC6H from texels. For one region and for the few partitions into two that promise most:
// a line through the texels along their principal axis, on the scale of half bits, on which the
// format mixes; the most precise mode that can say its ends; the nearest index for each texel; then
// new ends by least squares for those indices, as long as that helps.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/check.hpp"
#include "image/bc6h.hpp"
#include "image/bc6h_format.hpp"

namespace lucerna {
namespace {

using bc6h::Fields;
using bc6h::kTexels;
using bc6h::Mode;

using PerChannel = std::array<float, 3>;
using PerTexel = std::array<float, kTexels>;

// In kModeTable, the most precise first.
constexpr std::array<int, 4> kOneRegion = {13, 12, 11, 10};
constexpr std::array<int, 10> kTwoRegions = {2, 3, 4, 0, 5, 6, 7, 8, 1, 9};

constexpr int kAnyTexel = 0xffff;     // a mask as in kPartitionMasks
constexpr float kLargest = 0x7bff;    // half bits
constexpr float kDarkest = 0x1p-10f;  // of the block's largest: what is darker need not be exact
constexpr float kGoodEnough = kTexels * 0x1p-22f;  // an error below which no other mode is tried
constexpr float kUnknown = 1e30f;                  // more than any error
constexpr int kTriedPartitions = 6, kRefinedPartitions = 2, kRounds = 3, kPowerSteps = 6;

// Exact for all that are finite and positive.
float linearOf(int halfBits) {
  return std::bit_cast<float>(halfBits << 13) * 0x1p112f;
}

// How much more one more of the half bits stands for: 2^-24 below 2^-14, from there on twice as
// much with each exponent.
float stepAt(int halfBits) {
  return std::bit_cast<float>((std::max(halfBits >> 10, 1) + 127 - 25) << 23);
}

struct Source {
  std::array<PerTexel, 3> half, linear;  // by channel
  PerTexel scale;                        // of squared errors of linear values
  std::array<PerTexel, 3> weight;        // of squared errors of half bits, by channel
  // For principal axes: a weight for each texel, and its half bits from their mean on, scaled so
  // that the channels count alike.
  PerTexel importance;
  PerChannel mean, channelScale;
  std::array<PerTexel, 3> scaled;
};

void weigh(Source& source) {
  PerTexel brightest;
  for (int t = 0; t < kTexels; ++t)
    brightest[t] = std::max({source.linear[0][t], source.linear[1][t], source.linear[2][t]});
  const float darkest = kDarkest * *std::ranges::max_element(brightest);
  for (int t = 0; t < kTexels; ++t) {
    const float reference = std::max(brightest[t] + darkest, 0x1p-24f);
    source.scale[t] = 1.f / (reference * reference);
  }
}

void scaleChannels(Source& source) {
  float all = 0;
  PerChannel sums = {};
  source.importance.fill(0.f);
  for (int c = 0; c < 3; ++c)
    for (int t = 0; t < kTexels; ++t) {
      source.importance[t] += source.weight[c][t];
      sums[c] += source.weight[c][t];
      all += source.weight[c][t];
    }
  for (int c = 0; c < 3; ++c) {
    source.channelScale[c] = std::sqrt(std::max(sums[c] / all, 1e-6f));
    source.mean[c] = std::accumulate(source.half[c].begin(), source.half[c].end(), 0.f) / kTexels;
    for (int t = 0; t < kTexels; ++t)
      source.scaled[c][t] = source.channelScale[c] * (source.half[c][t] - source.mean[c]);
  }
}

Source sourceOf(const Bc6hTexels& texels) {
  Source source;
  for (int c = 0; c < 3; ++c)
    for (int t = 0; t < kTexels; ++t) {
      source.half[c][t] = texels[t][c];
      source.linear[c][t] = linearOf(texels[t][c]);
    }
  weigh(source);
  for (int c = 0; c < 3; ++c)
    for (int t = 0; t < kTexels; ++t) {
      const float step = stepAt(texels[t][c]);
      source.weight[c][t] = step * step * source.scale[t];
    }
  scaleChannels(source);
  return source;
}

float dot(const PerChannel& a, const PerChannel& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// A symmetric matrix: rr gg bb rg rb gb.
using Symmetric = std::array<float, 6>;
constexpr std::array<std::array<int, 2>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

PerChannel times(const Symmetric& matrix, const PerChannel& v) {
  return {matrix[0] * v[0] + matrix[3] * v[1] + matrix[4] * v[2],
          matrix[3] * v[0] + matrix[1] * v[1] + matrix[5] * v[2],
          matrix[4] * v[0] + matrix[5] * v[1] + matrix[2] * v[2]};
}
float traceOf(const Symmetric& matrix) {
  return matrix[0] + matrix[1] + matrix[2];
}

PerChannel offsetOf(const Source& source, int texel, const PerChannel& from) {
  return {source.scaled[0][texel] - from[0], source.scaled[1][texel] - from[1],
          source.scaled[2][texel] - from[2]};
}

PerChannel meanOf(const Source& source, int mask) {
  PerChannel mean = {};
  float weight = 0;
  for (int t = 0; t < kTexels; ++t) {
    if (!(mask >> t & 1)) continue;
    weight += source.importance[t];
    for (int c = 0; c < 3; ++c) mean[c] += source.importance[t] * source.scaled[c][t];
  }
  for (float& value : mean) value /= weight;
  return mean;
}

// Of the texels' offsets from their mean, so that no rounding makes a diagonal negative.
Symmetric covarianceOf(const Source& source, const PerChannel& mean, int mask) {
  Symmetric covariance = {};
  for (int t = 0; t < kTexels; ++t) {
    if (!(mask >> t & 1)) continue;
    const PerChannel offset = offsetOf(source, t, mean);
    for (int p = 0; p < 6; ++p)
      covariance[p] += source.importance[t] * offset[kPairs[p][0]] * offset[kPairs[p][1]];
  }
  return covariance;
}

// The direction in which points vary most, of length 1; of points that are all alike 0. By power
// iteration from the channel that varies most; the matrix gets a trace of 1, so that the vector
// shrinks by 3^-kPowerSteps at most.
PerChannel principalAxis(Symmetric covariance) {
  PerChannel axis = {};
  const float trace = traceOf(covariance);
  if (!(trace > 0.f)) return axis;
  for (float& value : covariance) value /= trace;
  const auto widest =
      std::max_element(covariance.begin(), covariance.begin() + 3) - covariance.begin();
  axis[widest] = 1.f;
  for (int step = 0; step < kPowerSteps; ++step) axis = times(covariance, axis);
  const float length = std::sqrt(dot(axis, axis));
  for (float& value : axis) value /= length;
  return axis;
}

// Two ends, in half bits.
struct Line {
  std::array<PerChannel, 2> ends;
};

// Along the principal axis of a region's texels, as far as they reach.
Line lineThrough(const Source& source, int mask) {
  const PerChannel mean = meanOf(source, mask);
  const PerChannel axis = principalAxis(covarianceOf(source, mean, mask));
  float low = 0, high = 0;
  for (int t = 0; t < kTexels; ++t)
    if (mask >> t & 1) {
      const float position = dot(offsetOf(source, t, mean), axis);
      low = std::min(low, position);
      high = std::max(high, position);
    }
  Line line;
  for (int c = 0; c < 3; ++c) {
    const float scale = source.channelScale[c];
    line.ends[0][c] = source.mean[c] + (mean[c] + low * axis[c]) / scale;
    line.ends[1][c] = source.mean[c] + (mean[c] + high * axis[c]) / scale;
  }
  return line;
}

int maskOf(const Fields& fields, int region) {
  if (bc6h::kModeTable[fields.mode].regions == 1) return kAnyTexel;
  const int second = bc6h::kPartitionMasks[fields.partition];
  return region == 0 ? kAnyTexel & ~second : second;
}
int anchorOf(const Fields& fields, int region) {
  return region == 0 ? 0 : bc6h::kAnchors[fields.partition];
}

// Ends for the indices that texels have, each channel by itself: the smallest sum of weight *
// (first * (1 - f) + second * f - half)^2. Where that has no single answer `line` stays.
void solveEnds(const Source& source, const Fields& fields, int mask, Line& line) {
  const auto weights = bc6h::weightsOf(bc6h::kModeTable[fields.mode].regions);
  for (int c = 0; c < 3; ++c) {
    float aa = 0, ab = 0, bb = 0, ax = 0, bx = 0;
    for (int t = 0; t < kTexels; ++t) {
      if (!(mask >> t & 1)) continue;
      const float f = static_cast<float>(weights[fields.indices[t]]) / 64.f,
                  weight = source.weight[c][t];
      aa += weight * (1 - f) * (1 - f);
      ab += weight * (1 - f) * f;
      bb += weight * f * f;
      ax += weight * (1 - f) * source.half[c][t];
      bx += weight * f * source.half[c][t];
    }
    const float determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-4f * aa * bb)) continue;
    line.ends[0][c] = (ax * bb - bx * ab) / determinant;
    line.ends[1][c] = (bx * aa - ax * ab) / determinant;
  }
}

// The nearest to what decoding gives: the middles of `step`s, but for the first and the last value,
// which are 0 and 0xffff. As it cuts the fraction of a half bit off, that one's middle is wanted.
int quantized(float halfBits, int bits) {
  const float wanted = (std::clamp(halfBits, 0.f, kLargest) + 0.5f) * (64.f / 31.f);
  const int largest = (1 << bits) - 1;
  if (bits == 16) return std::min(static_cast<int>(wanted + 0.5f), largest);
  const auto step = static_cast<float>(1 << (16 - bits));
  if (wanted < step) return wanted > 0.75f * step ? 1 : 0;
  if (wanted > 65536.f - step) return wanted < 65536.f - 0.75f * step ? largest - 1 : largest;
  return static_cast<int>(wanted / step);
}

// Linear values that indices stand for, by channel.
struct Palette {
  std::array<std::array<float, 16>, 3> values;
  int count = 0;
};

Palette paletteOf(const Fields& fields, int region) {
  const Mode& mode = bc6h::kModeTable[fields.mode];
  const auto weights = bc6h::weightsOf(mode.regions);
  Palette palette;
  palette.count = static_cast<int>(weights.size());
  for (int c = 0; c < 3; ++c) {
    const int first = bc6h::unquantized(fields.endpoints[2 * region][c], mode.endpointBits),
              second = bc6h::unquantized(fields.endpoints[2 * region + 1][c], mode.endpointBits);
    for (int i = 0; i < palette.count; ++i)
      palette.values[c][i] = linearOf(bc6h::halfOf(first, second, weights[i]));
  }
  return palette;
}

struct Nearest {
  PerTexel error;
  std::array<int, kTexels> index;
};

// Of the first `count` of a palette, for all texels; the inner loop becomes vector code.
Nearest nearestOf(const Source& source, const Palette& palette, int count) {
  Nearest nearest;
  nearest.error.fill(kUnknown);
  nearest.index.fill(0);
  for (int i = 0; i < count; ++i) {
    const float r = palette.values[0][i], g = palette.values[1][i], b = palette.values[2][i];
    for (int t = 0; t < kTexels; ++t) {
      const float dr = source.linear[0][t] - r, dg = source.linear[1][t] - g,
                  db = source.linear[2][t] - b;
      const float error = dr * dr + dg * dg + db * db;
      const bool nearer = error < nearest.error[t];
      nearest.error[t] = nearer ? error : nearest.error[t];
      nearest.index[t] = nearer ? i : nearest.index[t];
    }
  }
  for (int t = 0; t < kTexels; ++t) nearest.error[t] *= source.scale[t];
  return nearest;
}

// Gives each texel its index and returns the block's error.
float chooseIndices(const Source& source, Fields& fields) {
  float sum = 0;
  for (int region = 0; region < bc6h::kModeTable[fields.mode].regions; ++region) {
    const Palette palette = paletteOf(fields, region);
    Nearest nearest = nearestOf(source, palette, palette.count);
    const int anchor = anchorOf(fields, region), mask = maskOf(fields, region);
    if (nearest.index[anchor] >= palette.count / 2) {
      const Nearest lower = nearestOf(source, palette, palette.count / 2);
      nearest.index[anchor] = lower.index[anchor];
      nearest.error[anchor] = lower.error[anchor];
    }
    for (int t = 0; t < kTexels; ++t)
      if (mask >> t & 1) {
        fields.indices[t] = static_cast<std::uint8_t>(nearest.index[t]);
        sum += nearest.error[t];
      }
  }
  return sum;
}

struct Candidate {
  Fields fields;
  std::array<Line, 2> lines;
  float error = kUnknown;
};

// The region's anchor needs a low index, so the line begins at the end near it.
void turn(const Source& source, int anchor, Line& line) {
  float difference = 0;
  for (int c = 0; c < 3; ++c) {
    const float half = source.half[c][anchor], first = half - line.ends[0][c],
                second = half - line.ends[1][c];
    difference += source.weight[c][anchor] * (first * first - second * second);
  }
  if (difference > 0) std::swap(line.ends[0], line.ends[1]);
}

// The most precise mode among `modes` that can say the candidate's lines.
void chooseMode(std::span<const int> modes, Candidate& candidate) {
  int bits = 0;
  for (const int index : modes) {
    const Mode& mode = bc6h::kModeTable[index];
    candidate.fields.mode = index;
    if (mode.endpointBits != bits)
      for (int e = 0; e < 2 * mode.regions; ++e)
        for (int c = 0; c < 3; ++c)
          candidate.fields.endpoints[e][c] =
              quantized(candidate.lines[e / 2].ends[e % 2][c], mode.endpointBits);
    bits = mode.endpointBits;
    if (fits(mode, candidate.fields.endpoints)) return;
  }
}

// From the candidate's lines and partition all else.
void settle(const Source& source, std::span<const int> modes, Candidate& candidate) {
  candidate.fields.mode = modes.front();  // tells how many regions there are
  for (int region = 0; region < bc6h::kModeTable[modes.front()].regions; ++region)
    turn(source, anchorOf(candidate.fields, region), candidate.lines[region]);
  chooseMode(modes, candidate);
  candidate.error = chooseIndices(source, candidate.fields);
}

void refine(const Source& source, std::span<const int> modes, Candidate& candidate) {
  for (int round = 0; round < kRounds && candidate.error > kGoodEnough; ++round) {
    Candidate next = candidate;
    for (int region = 0; region < bc6h::kModeTable[candidate.fields.mode].regions; ++region)
      solveEnds(source, candidate.fields, maskOf(candidate.fields, region), next.lines[region]);
    settle(source, modes, next);
    if (next.error >= candidate.error) return;
    candidate = next;
  }
}

Candidate oneRegion(const Source& source) {
  Candidate candidate;
  candidate.lines[0] = lineThrough(source, kAnyTexel);
  settle(source, kOneRegion, candidate);
  refine(source, kOneRegion, candidate);
  return candidate;
}

// Sums over the texels of a region, of importance times the products of Source::scaled.
struct Moments {
  float weight = 0;
  PerChannel first = {};
  Symmetric second = {};
};

Moments momentsOf(const Source& source, int texel) {
  Moments moments;
  moments.weight = source.importance[texel];
  for (int c = 0; c < 3; ++c) moments.first[c] = moments.weight * source.scaled[c][texel];
  for (int p = 0; p < 6; ++p)
    moments.second[p] = moments.first[kPairs[p][0]] * source.scaled[kPairs[p][1]][texel];
  return moments;
}

void add(Moments& to, const Moments& from, float factor) {
  to.weight += factor * from.weight;
  for (int c = 0; c < 3; ++c) to.first[c] += factor * from.first[c];
  for (int p = 0; p < 6; ++p) to.second[p] += factor * from.second[p];
}

// The error to expect of a region: what lies off its line, and a share of what lies along it for
// the coarse steps there; evenly spread texels would be off by 1/49 of that with eight indices. The
// Frobenius norm stands for the largest eigenvalue, which it hardly exceeds where the others are
// small.
float promiseOf(const Moments& moments) {
  if (!(moments.weight > 0.f)) return 0.f;
  Symmetric m;
  for (int p = 0; p < 6; ++p)
    m[p] = moments.second[p] -
           moments.first[kPairs[p][0]] * moments.first[kPairs[p][1]] / moments.weight;
  const float along = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2] +
                                2 * (m[3] * m[3] + m[4] * m[4] + m[5] * m[5]));
  return traceOf(m) - along + along / 49.f;
}

struct Promise {
  int partition = 0;
  float error = kUnknown;
};

// The best first.
std::array<Promise, kTriedPartitions> bestPartitions(const Source& source) {
  std::array<Moments, kTexels> moments;
  Moments all;
  for (int t = 0; t < kTexels; ++t) {
    moments[t] = momentsOf(source, t);
    add(all, moments[t], 1.f);
  }
  std::array<Promise, kTriedPartitions> best;
  for (int partition = 0; partition < bc6h::kPartitions; ++partition) {
    Moments first = all, second;
    for (int t = 0; t < kTexels; ++t)
      if (bc6h::kPartitionMasks[partition] >> t & 1) add(second, moments[t], 1.f);
    add(first, second, -1.f);
    Promise promise{partition, promiseOf(first) + promiseOf(second)};
    for (Promise& place : best)
      if (promise.error < place.error) std::swap(promise, place);
  }
  return best;
}

Candidate twoRegions(const Source& source) {
  const auto promises = bestPartitions(source);
  std::array<Candidate, kTriedPartitions> tried;
  for (int i = 0; i < kTriedPartitions; ++i) {
    Fields& fields = tried[i].fields;
    fields.mode = kTwoRegions.front();
    fields.partition = promises[i].partition;
    for (int region = 0; region < 2; ++region)
      tried[i].lines[region] = lineThrough(source, maskOf(fields, region));
    settle(source, kTwoRegions, tried[i]);
  }
  std::ranges::stable_sort(tried, {}, &Candidate::error);
  for (int i = 0; i < kRefinedPartitions; ++i) refine(source, kTwoRegions, tried[i]);
  return *std::ranges::min_element(tried, {}, &Candidate::error);
}

// Mode 15 says any half exactly.
Bc6hBlock constantBlock(const std::array<std::uint16_t, 3>& color) {
  Fields fields;
  fields.mode = kOneRegion.front();
  for (int c = 0; c < 3; ++c)
    fields.endpoints[0][c] = fields.endpoints[1][c] =
        quantized(color[c], bc6h::kModeTable[fields.mode].endpointBits);
  return bc6h::pack(fields);
}

}  // namespace

Bc6hBlock encodeBc6hBlock(const Bc6hTexels& texels) {
  for (const auto& color : texels) CHECK(std::ranges::max(color) <= 0x7bff, "not a finite half");
  if (std::ranges::all_of(texels, [&](const auto& color) { return color == texels[0]; }))
    return constantBlock(texels[0]);
  const Source source = sourceOf(texels);
  Candidate best = oneRegion(source);
  if (best.error > kGoodEnough)
    if (const Candidate two = twoRegions(source); two.error < best.error) best = two;
  return bc6h::pack(best.fields);
}

}  // namespace lucerna
