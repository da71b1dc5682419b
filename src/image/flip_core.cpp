// Section numbers: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG
// 2020. Colours: CIE XYZ of sRGB primaries relative to the white D65, kept as opponents (Y, X - Y,
// Y - Z), which are YCxCz up to constant factors.
#include "image/flip_core.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "image/flip_filters.hpp"
#include "image/vector_math.hpp"

namespace lucerna::flip {
namespace {

constexpr float kColourExponent = 0.7f;    // q_c, 4.1.3
constexpr float kColourKnee = 0.4f;        // p_c
constexpr float kColourKneeValue = 0.95f;  // p_t
constexpr int kBandRows = 96;  // rows that a thread filters at a time; more rows overlap less

// Rows: X/Xn, Y/Yn, Z/Zn of linear sRGB (IEC 61966-2-1), and its inverse.
constexpr float kXyzFromRgb[3][3] = {{0.433895389f, 0.376242373f, 0.189862239f},
                                     {0.212636822f, 0.715182982f, 0.072180196f},
                                     {0.017752423f, 0.109465629f, 0.872781948f}};
constexpr float kRgbFromXyz[3][3] = {{3.080341988f, -1.537398969f, -0.542943019f},
                                     {-0.921178396f, 1.875929984f, 0.045248412f},
                                     {0.052881293f, -0.204011206f, 1.151129913f}};

// The lightness curve of CIELab.
inline float labCurve(float t) {
  constexpr float kDelta = 6 / 29.f;
  const float root = vectorPow(t, 1 / 3.f);
  const float line = t / (3 * kDelta * kDelta) + 4 / 29.f;
  return t > kDelta * kDelta * kDelta ? root : line;
}

struct Lab {
  float l, a, b;
};

// CIELab of linear RGB with the Hunt adjustment: dark colours are less colourful (4.1.2).
inline Lab huntLab(float r, float g, float b) {
  const auto& m = kXyzFromRgb;
  const float x = labCurve(m[0][0] * r + m[0][1] * g + m[0][2] * b);
  const float y = labCurve(m[1][0] * r + m[1][1] * g + m[1][2] * b);
  const float z = labCurve(m[2][0] * r + m[2][1] * g + m[2][2] * b);
  const float l = 116 * y - 16;
  return {l, 0.01f * l * 500 * (x - y), 0.01f * l * 200 * (y - z)};
}

// HyAB distance: Abasi et al., "Distance metrics for very large color differences", 2020.
inline float hyab(Lab p, Lab q) {
  const float a = p.a - q.a, b = p.b - q.b;
  return std::abs(p.l - q.l) + std::sqrt(a * a + b * b);
}

inline float clamp01(float v) {
  return std::min(std::max(v, 0.f), 1.f);
}

// What one picture's row holds after the filters along it.
enum Along { kLuma, kRedGreenA, kBlueYellowA, kBlueYellowB, kSmooth, kEdge, kPoint, kAlongCount };
// And after the filters across rows.
enum Across { kY, kCx, kCz, kEdgeX, kEdgeY, kPointX, kPointY, kAcrossCount };

struct Filters {
  SpatialFilters colour;
  FeatureFilters feature;
  int radius;

  explicit Filters(float pixelsPerDegree)
      : colour(spatialFilters(pixelsPerDegree)), feature(featureFilters(pixelsPerDegree)) {
    radius = std::max({colour.achromatic.radius, colour.redGreen.radius, colour.blueYellow1.radius,
                       colour.blueYellow2.radius, feature.smooth.radius});
  }
};

LUCERNA_WIDE_VECTORS
void opponentsFromRgb(float* c0, float* c1, float* c2, int width) {
  const auto& m = kXyzFromRgb;
  for (int i = 0; i < width; ++i) {
    const float r = c0[i], g = c1[i], b = c2[i];
    const float x = m[0][0] * r + m[0][1] * g + m[0][2] * b;
    const float y = m[1][0] * r + m[1][1] * g + m[1][2] * b;
    const float z = m[2][0] * r + m[2][1] * g + m[2][2] * b;
    c0[i] = y;
    c1[i] = x - y;
    c2[i] = y - z;
  }
}

// Filtered opponents to Hunt-adjusted Lab, in place.
LUCERNA_WIDE_VECTORS
void labFromOpponents(float* c0, float* c1, float* c2, int width) {
  const auto& m = kRgbFromXyz;
  for (int i = 0; i < width; ++i) {
    const float y = c0[i], x = y + c1[i], z = y - c2[i];
    const float r = clamp01(m[0][0] * x + m[0][1] * y + m[0][2] * z);
    const float g = clamp01(m[1][0] * x + m[1][1] * y + m[1][2] * z);
    const float b = clamp01(m[2][0] * x + m[2][1] * y + m[2][2] * z);
    const Lab lab = huntLab(r, g, b);
    c0[i] = lab.l;
    c1[i] = lab.a;
    c2[i] = lab.b;
  }
}

// Filtered rows of one picture within a band.
class Band {
 public:
  Band(int width, int firstRow, int rows, const Filters& filters)
      : width_(width),
        stride_(paddedWidth(width)),
        firstRow_(firstRow),
        rows_(rows),
        filters_(filters),
        along_(static_cast<std::size_t>(rows) * kAlongCount * stride_),
        across_(static_cast<std::size_t>(kAcrossCount) * stride_) {}

  void filterAlong(const RowSource& source) {
    PaddedRow y(width_, filters_.radius), cx(width_, filters_.radius), cz(width_, filters_.radius);
    float* const planes[] = {y.data(), cx.data(), cz.data()};
    for (int row = firstRow_; row < firstRow_ + rows_; ++row) {
      source(row, planes);
      opponentsFromRgb(y.data(), cx.data(), cz.data(), width_);
      for (PaddedRow* plane : {&y, &cx, &cz}) plane->extend();
      convolveAlong(y, filters_.colour.achromatic, width_, along(kLuma, row));
      convolveAlong(cx, filters_.colour.redGreen, width_, along(kRedGreenA, row));
      convolveAlong(cz, filters_.colour.blueYellow1, width_, along(kBlueYellowA, row));
      convolveAlong(cz, filters_.colour.blueYellow2, width_, along(kBlueYellowB, row));
      convolveAlong(y, filters_.feature.smooth, width_, along(kSmooth, row));
      convolveAlong(y, filters_.feature.edge, width_, along(kEdge, row));
      convolveAlong(y, filters_.feature.point, width_, along(kPoint, row));
    }
  }

  // Fills the planes of Across for one row; Lab in place of the opponents.
  void filterAcross(int row) {
    acrossRows(kLuma, filters_.colour.achromatic, row, kY);
    acrossRows(kRedGreenA, filters_.colour.redGreen, row, kCx);
    acrossRows(kBlueYellowA, filters_.colour.blueYellow1, row, kCz);
    acrossRows(kBlueYellowB, filters_.colour.blueYellow2, row, kCz, true);
    acrossRows(kEdge, filters_.feature.smooth, row, kEdgeX);
    acrossRows(kSmooth, filters_.feature.edge, row, kEdgeY);
    acrossRows(kPoint, filters_.feature.smooth, row, kPointX);
    acrossRows(kSmooth, filters_.feature.point, row, kPointY);
    labFromOpponents(across(kY), across(kCx), across(kCz), width_);
  }

  float* across(Across plane) { return across_.data() + static_cast<std::size_t>(plane) * stride_; }
  const float* across(Across plane) const { return const_cast<Band*>(this)->across(plane); }

 private:
  float* along(Along plane, int row) {
    const auto index = static_cast<std::size_t>(row - firstRow_) * kAlongCount + plane;
    return along_.data() + index * stride_;
  }

  void acrossRows(Along from, const Kernel& kernel, int row, Across to, bool accumulate = false) {
    rowPointers_.clear();
    for (int t = -kernel.radius; t <= kernel.radius; ++t)
      rowPointers_.push_back(along(from, std::clamp(row + t, firstRow_, firstRow_ + rows_ - 1)));
    convolveAcross(rowPointers_.data(), kernel, width_, across(to), accumulate);
  }

  int width_, stride_, firstRow_, rows_;
  const Filters& filters_;
  std::vector<float> along_, across_;
  std::vector<const float*> rowPointers_;
};

// 4.1.3: the largest colour difference there is, between green and blue.
float largestColourDifference() {
  return vectorPow(hyab(huntLab(0, 1, 0), huntLab(0, 0, 1)), kColourExponent);
}

struct RowPair {
  const float *r[kAcrossCount], *t[kAcrossCount];
};

// The difference of two rows: colour (4.1.3), features (4.2.2), and both together (4.3).
LUCERNA_WIDE_VECTORS
void combine(const RowPair& rows, float largest, int width, float* error) {
  const RowPair p = rows;
  const float knee = kColourKnee * largest;
  const float below = kColourKneeValue / knee;
  const float above = (1 - kColourKneeValue) / (largest - knee);
  for (int i = 0; i < width; ++i) {
    const float distance =
        hyab({p.r[kY][i], p.r[kCx][i], p.r[kCz][i]}, {p.t[kY][i], p.t[kCx][i], p.t[kCz][i]});
    const float d = vectorPow(distance, kColourExponent);
    const float colour = clamp01(d < knee ? d * below : kColourKneeValue + (d - knee) * above);
    const auto length = [](float x, float y) { return std::sqrt(x * x + y * y); };
    const float edge =
        std::abs(length(p.r[kEdgeX][i], p.r[kEdgeY][i]) - length(p.t[kEdgeX][i], p.t[kEdgeY][i]));
    const float point = std::abs(length(p.r[kPointX][i], p.r[kPointY][i]) -
                                 length(p.t[kPointX][i], p.t[kPointY][i]));
    // q_f = 1/2: a square root.
    const float feature = std::sqrt(0.70710678f * std::max(edge, point));
    error[i] = vectorPow(colour, std::max(1 - feature, 0.f));
  }
}

}  // namespace

Image errorMap(int width, int height, const RowSource& reference, const RowSource& test,
               float pixelsPerDegree) {
  const Filters filters(pixelsPerDegree);
  const float largest = largestColourDifference();
  Image error(width, height, 1, ComponentType::F32);
  parallelFor(static_cast<std::size_t>(height), kBandRows, [&](std::size_t begin, std::size_t end) {
    const int first = std::max(static_cast<int>(begin) - filters.radius, 0);
    const int last = std::min(static_cast<int>(end) + filters.radius, height);
    Band a(width, first, last - first, filters), b(width, first, last - first, filters);
    a.filterAlong(reference);
    b.filterAlong(test);
    RowPair rows;
    for (int plane = 0; plane < kAcrossCount; ++plane) {
      rows.r[plane] = a.across(static_cast<Across>(plane));
      rows.t[plane] = b.across(static_cast<Across>(plane));
    }
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      a.filterAcross(y);
      b.filterAcross(y);
      combine(rows, largest, width, error.pixel<float>(0, y));
    }
  });
  return error;
}

}  // namespace lucerna::flip
