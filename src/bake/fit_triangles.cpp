#include "bake/fit_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "lightmap/patch_triangle.hpp"

namespace lucerna::bake {
namespace {

using lightmap::PatchNode;
using lightmap::PatchRoot;
using lightmap::PatchTriangle;
using lightmap::TexelTiles;
using lightmap::TriangleLight;
using lightmap::TriangleTexels;

constexpr float kLargest = 65535.f;
constexpr float kFitShare = 0.98f;  // of the tolerance; the rest is for rounding
constexpr std::size_t kFewest = 4;  // lit texels that are worth a split
// Bytes of the file.
constexpr std::size_t kNodeBytes = 1, kValueBytes = 2, kTileShare = 1;  // the last of a texel

struct Edge {
  std::uint16_t map;
  ivec2 a, b;

  bool operator<(const Edge& other) const {
    return std::tie(map, a.x, a.y, b.x, b.y) <
           std::tie(other.map, other.a.x, other.a.y, other.b.x, other.b.y);
  }
  bool operator==(const Edge& other) const {
    return map == other.map && a == other.a && b == other.b;
  }
};

Edge edgeOf(const PatchRoot& root, std::size_t opposite) {
  Edge edge{root.map, root.corners[(opposite + 1) % 3], root.corners[(opposite + 2) % 3]};
  if (std::tie(edge.b.x, edge.b.y) < std::tie(edge.a.x, edge.a.y)) std::swap(edge.a, edge.b);
  return edge;
}

bool hasArea(const PatchRoot& root) {
  const PatchTriangle t = lightmap::triangleOf(root);
  const lightmap::Point64 a = t.corners[1] - t.corners[0], b = t.corners[2] - t.corners[0];
  return a.x * b.y != a.y * b.x;
}

void findBorders(std::vector<PatchRoot>& roots) {
  std::vector<Edge> edges;
  edges.reserve(roots.size() * 3);
  for (const PatchRoot& root : roots)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back(edgeOf(root, i));
  std::sort(edges.begin(), edges.end());
  for (PatchRoot& root : roots)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [begin, end] = std::equal_range(edges.begin(), edges.end(), edgeOf(root, i));
      if (end - begin == 1) root.borders |= static_cast<std::uint8_t>(1u << i);
    }
}

// Fits one triangle of the layout after the other.
class RootFit {
 public:
  RootFit(TexelTiles& light, const FitSettings& settings) : light_(light), settings_(settings) {}

  void fit(const PatchRoot& root, TriangleLight& out) {
    map_ = root.map;
    nodes_.clear();
    corners_.clear();
    build(lightmap::triangleOf(root), 0);
    if (corners_.empty()) return;
    PatchRoot kept = root;
    kept.scale = *std::max_element(corners_.begin(), corners_.end()) / kLargest;
    for (const float value : corners_)
      out.values.push_back(
          static_cast<std::uint16_t>(std::min(value / kept.scale, kLargest) + 0.5f));
    out.nodes.insert(out.nodes.end(), nodes_.begin(), nodes_.end());
    out.roots.push_back(kept);
  }

 private:
  struct Sample {
    vec3 weights;
    vec3 value;  // of each channel
  };
  using Corners = std::array<vec3, 3>;  // of each channel, at the three corners

  std::size_t channels() const { return light_.channels(); }
  std::size_t texelBytes() const { return channels() * kValueBytes + kTileShare; }
  std::size_t leafBytes() const { return kNodeBytes + 3 * channels() * kValueBytes; }

  // Appends the triangle's nodes and returns the bytes that its texels take, those left over
  // included.
  std::size_t build(const PatchTriangle& triangle, int depth) {
    const std::size_t lit = gather(triangle);
    const std::size_t asTexels = kNodeBytes + lit * texelBytes();
    if (lit == 0) return leaveOver(asTexels);
    if (const Corners corners = bestCorners(); isGood(corners)) {
      if (leafBytes() >= asTexels) return leaveOver(asTexels);
      nodes_.push_back(PatchNode::Leaf);
      for (std::size_t c = 0; c < channels(); ++c)
        for (int i = 0; i < 3; ++i) corners_.push_back(corners[c][i]);
      return leafBytes();
    }
    if (lit <= kFewest || depth == lightmap::kMostSplits) return leaveOver(asTexels);
    const std::size_t nodes = nodes_.size(), values = corners_.size();
    nodes_.push_back(PatchNode::Split);
    std::size_t bytes = kNodeBytes;
    for (int part = 0; part < 4; ++part)
      bytes += build(lightmap::partOf(triangle, part), depth + 1);
    if (bytes < asTexels) return bytes;
    nodes_.resize(nodes);
    corners_.resize(values);
    return leaveOver(asTexels);
  }

  std::size_t leaveOver(std::size_t bytes) {
    nodes_.push_back(PatchNode::Nothing);
    return bytes;
  }

  // The samples of a triangle: how many are lit.
  std::size_t gather(const PatchTriangle& triangle) {
    samples_.clear();
    std::size_t lit = 0;
    const std::vector<bool>& used = settings_.used[map_];
    TriangleTexels(triangle, false, settings_.side).forEach([&](int x, int y, vec3 weights) {
      if (!used[static_cast<std::size_t>(y) * settings_.side + x]) return;
      Sample sample{weights, vec3(0.f)};
      if (const float* value = light_.find(map_, x, y)) {
        ++lit;
        for (std::size_t c = 0; c < channels(); ++c)
          sample.value[static_cast<int>(c)] = value[c * lightmap::kTileTexels];
      }
      samples_.push_back(sample);
    });
    return lit;
  }

  // Least squares, pulled a little to the mean: that decides where samples do not.
  Corners bestCorners() const {
    const double count = static_cast<double>(samples_.size()), pull = 1e-5 * count;
    glm::dmat3 weights(pull);
    std::array<glm::dvec3, 3> sums{};
    glm::dvec3 mean(0.);
    for (const Sample& sample : samples_) {
      const glm::dvec3 w(sample.weights);
      weights += glm::outerProduct(w, w);
      for (int c = 0; c < 3; ++c) sums[static_cast<std::size_t>(c)] += w * double{sample.value[c]};
      mean += glm::dvec3(sample.value) / count;
    }
    const glm::dmat3 inverse = glm::inverse(weights);
    Corners corners{};
    for (std::size_t c = 0; c < channels(); ++c)
      corners[c] = glm::max(
          vec3(inverse * (sums[c] + pull * glm::dvec3(mean[static_cast<int>(c)]))), vec3(0.f));
    return corners;
  }

  bool isGood(const Corners& corners) const {
    for (const Sample& sample : samples_)
      for (std::size_t c = 0; c < channels(); ++c) {
        const int channel = static_cast<int>(c);
        const float off = glm::dot(sample.weights, corners[c]) - sample.value[channel];
        if (!(std::abs(off) <= settings_.tolerance[channel] * kFitShare)) return false;
      }
    return true;
  }

  TexelTiles& light_;
  const FitSettings& settings_;
  std::uint16_t map_ = 0;
  std::vector<PatchNode> nodes_;
  std::vector<float> corners_;  // as TriangleLight::values
  std::vector<Sample> samples_;
};

// Whether any tile around the triangle is lit.
bool mayBeLit(const PatchRoot& root, const TexelTiles& light) {
  constexpr int kTile = lightmap::kPatchUnit * lightmap::kTileSide;
  const auto& p = root.corners;
  const ivec2 low = glm::min(glm::min(p[0], p[1]), p[2]) / kTile,
              high = glm::max(glm::max(p[0], p[1]), p[2]) / kTile;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      if (light.has({root.map, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)}))
        return true;
  return false;
}

}  // namespace

std::vector<PatchRoot> rootsOf(const lightmap::Layout& layout) {
  std::vector<PatchRoot> roots;
  for (const auto& triangles : layout.objects)
    for (const lightmap::TrianglePlace& place : triangles) {
      if (place.map == lightmap::TrianglePlace::kNowhere) continue;
      PatchRoot root{.map = static_cast<std::uint16_t>(place.map)};
      for (std::size_t i = 0; i < 3; ++i)
        root.corners[i] = ivec2(glm::round(place.corners[i] * float{lightmap::kPatchUnit}));
      if (hasArea(root)) roots.push_back(root);
    }
  findBorders(roots);
  return roots;
}

TriangleLight fitTriangles(std::span<const PatchRoot> roots, TexelTiles& light,
                           const FitSettings& settings) {
  TriangleLight out;
  RootFit fit(light, settings);
  for (const PatchRoot& root : roots)
    if (mayBeLit(root, light)) fit.fit(root, out);
  return out;
}

}  // namespace lucerna::bake
