#include "bake/emitting_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "bake/clip_polygon.hpp"
#include "bake/triangle.hpp"
#include "trace/material_lookup.hpp"

namespace lucerna::bake {
namespace {

using glm::dvec2;

constexpr int kMostCuts = 16;  // along a cell, for the picture's pixels

// A triangle of the chart, as a map from texels.
struct Facet {
  std::array<vec2, 3> corners;
  vec3 originW{0.f}, stepX{0.f}, stepY{0.f};  // a place is originW + stepX * x + stepY * y
  vec3 normalW{0.f};
  vec2 uvOrigin{0.f}, uvX{0.f}, uvY{0.f};  // as places; only of a texture
  float area = 0.f;                        // m^2 of a texel
  double side = 0.;                        // texels: of a square as large as the facet

  vec3 at(dvec2 p) const { return originW + stepX * float(p.x) + stepY * float(p.y); }
  vec2 uvAt(dvec2 p) const { return uvOrigin + uvX * float(p.x) + uvY * float(p.y); }
};

// The affine map that takes the corners of the flat triangle to the values.
template <typename V>
void fitMap(const std::array<vec2, 3>& corners, const std::array<V, 3>& values, V& origin, V& x,
            V& y) {
  const dvec2 a(corners[0]), b = dvec2(corners[1]) - a, c = dvec2(corners[2]) - a;
  const double area2 = b.x * c.y - b.y * c.x;
  const V ab = values[1] - values[0], ac = values[2] - values[0];
  x = ab * float(c.y / area2) - ac * float(b.y / area2);
  y = ac * float(b.x / area2) - ab * float(c.x / area2);
  origin = values[0] - x * float(a.x) - y * float(a.y);
}

// What a chart's object sends out.
class Source {
 public:
  Source(const World& world, const Chart& chart,
         const std::map<std::uint32_t, EmissionTexture>& textures)
      : world_(world),
        object_(world.objects[chart.object]),
        chart_(chart),
        mesh_(world.scene->meshes[world.scene->objects[object_.object].mesh]),
        material_(world.scene->materials[world.scene->objects[object_.object].material]) {
    const scene::TextureSlot& slot = material_.emissiveTexture;
    if (slot.used() && slot.coordinates == scene::Coordinates::Mesh) {
      texture_ = &textures.at(slot.texture);
      const Image& image = *world.scene->textures[slot.texture].image;
      pixels_ = vec2(image.width(), image.height());
    }
  }

  bool isDoubleSided() const { return material_.doubleSided; }
  std::optional<Facet> facet(std::size_t triangle) const {
    Facet facet{.corners = chart_.corners[triangle]};
    const dvec2 b = dvec2(facet.corners[1]) - dvec2(facet.corners[0]),
                c = dvec2(facet.corners[2]) - dvec2(facet.corners[0]);
    const double twice = std::abs(b.x * c.y - b.y * c.x);
    if (twice == 0.) return {};
    facet.side = std::sqrt(0.5 * twice);
    const std::uint32_t first = 3 * chart_.triangles[triangle];
    std::array<vec3, 3> positions;
    std::array<vec2, 3> uv{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      positions[k] = world_.positions[world_.indicesOf(object_)[first + k]];
      if (texture_) uv[k] = uvOf(mesh_.indices[first + k]);
    }
    fitMap(facet.corners, positions, facet.originW, facet.stepX, facet.stepY);
    if (texture_) fitMap(facet.corners, uv, facet.uvOrigin, facet.uvX, facet.uvY);
    facet.normalW = (object_.mirrored ? -1.f : 1.f) * shapeOf(positions).normal;
    facet.area = glm::length(glm::cross(facet.stepX, facet.stepY));
    return facet;
  }
  // How finely a square of texels is to be cut so that no pixel is left out, and of which level.
  struct Steps {
    int cuts = 1, level = 0;
  };
  Steps steps(const Facet& facet, int side) const {
    if (!texture_) return {};
    float pixels = pixelsAcross(facet, side);
    Steps steps;
    for (; pixels > kMostCuts && steps.level + 1 < texture_->levels(); pixels *= 0.5f)
      ++steps.level;
    steps.cuts = pixels < kMostCuts ? std::max(static_cast<int>(std::ceil(pixels)), 2) : kMostCuts;
    return steps;
  }
  // Whether anything may shine within the polygon.
  bool shines(const Facet& facet, const ClipPolygon& polygon) const {
    if (!texture_) return true;
    const auto [low, high] = uvOf(facet, polygon);
    return texture_->shines(low, high);
  }
  // Whether the polygon, of a square of texels, is of one colour or of one pixel.
  bool isEven(const Facet& facet, const ClipPolygon& polygon, int side) const {
    if (!texture_ || pixelsAcross(facet, side) <= 1.f) return true;
    const auto [low, high] = uvOf(facet, polygon);
    return texture_->isEven(low, high);
  }
  vec3 radiance(const Facet& facet, dvec2 p, int level) const {
    return texture_ ? material_.emissive * texture_->at(facet.uvAt(p), level) : material_.emissive;
  }

 private:
  // Of the picture, along a square of texels.
  float pixelsAcross(const Facet& facet, int side) const {
    const vec2 across = (glm::abs(facet.uvX) + glm::abs(facet.uvY)) * pixels_;
    return std::max(across.x, across.y) * static_cast<float>(side);
  }
  std::pair<vec2, vec2> uvOf(const Facet& facet, const ClipPolygon& polygon) const {
    vec2 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const dvec2 p : polygon.points()) {
      const vec2 uv = facet.uvAt(p);
      low = glm::min(low, uv);
      high = glm::max(high, uv);
    }
    return {low, high};
  }
  vec2 uvOf(std::uint32_t vertex) const {
    const scene::TextureSlot& slot = material_.emissiveTexture;
    const auto& coords = mesh_.texCoords[static_cast<std::size_t>(slot.texCoord)];
    return trace::transformed(slot, coords.empty() ? vec2(0.f) : coords[vertex]);
  }

  const World& world_;
  const WorldObject& object_;
  const Chart& chart_;
  const scene::Mesh& mesh_;
  const scene::Material& material_;
  const EmissionTexture* texture_ = nullptr;
  vec2 pixels_{0.f};
};

// Sums over what shines of a square of texels.
struct Sum {
  vec3 intensity{0.f};
  double weight = 0.;
  glm::dvec3 positionW{0.}, normalW{0.}, stepX{0.}, stepY{0.};
  dvec2 first{0.}, second{0.};  // moments in the square

  void add(const Facet& facet, const PolygonMoments& part, dvec2 corner, vec3 radiance) {
    const vec3 light = radiance * (facet.area * static_cast<float>(part.area));
    const double w = light.x + light.y + light.z;
    if (w == 0.) return;
    intensity += light;
    weight += w;
    positionW += w * glm::dvec3(facet.at(part.centroid));
    normalW += w * glm::dvec3(facet.normalW);
    stepX += w * glm::dvec3(facet.stepX);
    stepY += w * glm::dvec3(facet.stepY);
    const dvec2 p = part.centroid - corner;
    first += w * p;
    second += w * (p * p + part.variance);
  }
  std::optional<Cell> cell(ivec2 texel) const {
    if (!(weight > 0.) || !std::isfinite(weight) || !(glm::length(normalW) > 0.)) return {};
    const dvec2 mean = first / weight;
    const dvec2 sides = glm::sqrt(12. * glm::max(second / weight - mean * mean, dvec2(0.)));
    Cell cell{.emission = {.intensity = intensity,
                           .positionW = vec3(positionW / weight),
                           .normalW = vec3(glm::normalize(normalW))},
              .texel = texel,
              .alongU = vec3(stepX / weight * sides.x),
              .alongV = vec3(stepY / weight * sides.y)};
    return cell;
  }
};

// What a triangle has of a square.
PolygonMoments partOf(const Facet& facet, dvec2 from, double side, bool inside) {
  if (inside)
    return {
        .area = side * side, .centroid = from + 0.5 * side, .variance = dvec2(side * side / 12.)};
  ClipPolygon part(facet.corners);
  part.cutTo(from, from + side);
  return part.moments();
}

// What a facet has of a square of texels.
struct Part {
  std::uint32_t facet = 0;
  ClipPolygon polygon;
  PolygonMoments moments;
};

class Cutter {
 public:
  std::vector<Cell> cells;

  Cutter(const Source& source, std::vector<Facet> facets, const CutCells& cut,
         std::atomic<std::uint64_t>& made)
      : source_(source), facets_(std::move(facets)), cut_(cut), made_(made) {}

  // among: facets that may have a part of the square.
  void cut(ivec2 corner, int side, std::span<const std::uint32_t> among) {
    if (made_.load(std::memory_order_relaxed) > cut_.most) return;
    const std::vector<Part> parts = partsOf(corner, side, among);
    if (parts.empty()) return;
    const bool isFlat = cut_.merged && flatWith(parts, 0, corner, side).size() == parts.size();
    const bool isLeast = side == 1 && (!cut_.merged || isFlat || !isCoarse(parts, side));
    if (isLeast || (cut_.merged && isFlat && isOne(parts, side))) {
      add(parts, corner, side);
    } else if (cut_.merged && !isFlat && isCoarse(parts, side)) {
      cutByPlanes(parts, corner, side);
    } else {
      std::vector<std::uint32_t> left;
      for (const Part& part : parts) left.push_back(part.facet);
      const int half = side / 2;
      for (const ivec2 at : {ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)})
        cut(corner + half * at, half, left);
    }
  }

 private:
  std::vector<Part> partsOf(ivec2 corner, int side, std::span<const std::uint32_t> among) const {
    std::vector<Part> parts;
    for (const std::uint32_t i : among) {
      Part part{.facet = i, .polygon = ClipPolygon(facets_[i].corners), .moments = {}};
      part.polygon.cutTo(dvec2(corner), dvec2(corner + side));
      part.moments = part.polygon.moments();
      if (part.moments.area > 0. && source_.shines(facets_[i], part.polygon)) parts.push_back(part);
    }
    return parts;
  }

  // Facets of parts that lie in one plane with one of them, which is the first; from that one on.
  std::vector<std::uint32_t> flatWith(const std::vector<Part>& parts, std::size_t first,
                                      ivec2 corner, int side) const {
    constexpr float kCosFlat = 0.99999f;
    constexpr float kOff = 0.002f;  // of the square's side
    const Facet& own = facets_[parts[first].facet];
    const dvec2 middle = dvec2(corner) + 0.5 * side;
    const float most = kOff * static_cast<float>(side) * std::sqrt(own.area);
    std::vector<std::uint32_t> flat;
    for (std::size_t i = first; i < parts.size(); ++i) {
      const Facet& other = facets_[parts[i].facet];
      if (i == first ||
          (glm::dot(own.normalW, other.normalW) >= kCosFlat &&
           std::abs(glm::dot(own.normalW, other.at(middle) - own.at(middle))) <= most))
        flat.push_back(parts[i].facet);
    }
    return flat;
  }

  // Texels along facets, by what they have of the square.
  static double facetSide(const std::vector<Part>& parts, const std::vector<Facet>& facets) {
    double sum = 0., area = 0.;
    for (const Part& part : parts) {
      sum += part.moments.area * facets[part.facet].side;
      area += part.moments.area;
    }
    return sum / area;
  }
  // Whether it is cheaper to take the facets one by one than to cut the square on.
  bool isCoarse(const std::vector<Part>& parts, int side) const {
    return facetSide(parts, facets_) >= 0.5 * side;
  }

  // Whether flat parts are one light: of one colour, and a rectangle or small beside their facets.
  bool isOne(const std::vector<Part>& parts, int side) const {
    constexpr double kFine = 0.25, kFull = 0.999;
    double area = 0.;
    dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Part& part : parts) {
      if (!source_.isEven(facets_[part.facet], part.polygon, side)) return false;
      area += part.moments.area;
      for (const dvec2 p : part.polygon.points()) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
    const dvec2 extent = high - low;
    return side <= kFine * facetSide(parts, facets_) || area >= kFull * extent.x * extent.y;
  }

  void cutByPlanes(std::vector<Part> parts, ivec2 corner, int side) {
    while (!parts.empty()) {
      const std::vector<std::uint32_t> flat = flatWith(parts, 0, corner, side);
      cut(corner, side, flat);
      std::erase_if(parts, [&](const Part& part) {
        return std::ranges::find(flat, part.facet) != flat.end();
      });
    }
  }

  void add(const std::vector<Part>& parts, ivec2 corner, int side) {
    Sum sum;
    for (const Part& part : parts) addPart(sum, part, dvec2(corner), side);
    std::optional<Cell> cell = sum.cell(corner);
    if (!cell) return;
    Emission& e = cell->emission;
    float low = 0.f, high = 0.f;
    for (const Part& part : parts)
      for (const dvec2 p : part.polygon.points()) {
        const float above = glm::dot(facets_[part.facet].at(p) - e.positionW, e.normalW);
        low = std::min(low, above);
        high = std::max(high, above);
      }
    e.positionW += (high + liftAt(e.positionW)) * e.normalW;
    cell->thickness = high - low;
    cells.push_back(*cell);
    made_.fetch_add(source_.isDoubleSided() ? 2u : 1u, std::memory_order_relaxed);
  }

  void addPart(Sum& sum, const Part& part, dvec2 corner, int side) const {
    const Facet& facet = facets_[part.facet];
    const auto [cuts, level] = source_.steps(facet, side);
    const double step = static_cast<double>(side) / cuts, all = static_cast<double>(side) * side;
    const bool inside = part.moments.area > all * (1. - 1e-9);
    for (int i = 0; i < cuts * cuts; ++i) {
      const PolygonMoments piece =
          cuts == 1 ? part.moments
                    : partOf(facet, corner + step * dvec2(i % cuts, i / cuts), step, inside);
      if (piece.area > 0.)
        sum.add(facet, piece, corner, source_.radiance(facet, piece.centroid, level));
    }
  }

  const Source& source_;
  std::vector<Facet> facets_;
  const CutCells& cut_;
  std::atomic<std::uint64_t>& made_;
};

}  // namespace

std::vector<Cell> cellsOf(const World& world, const Chart& chart,
                          const std::map<std::uint32_t, EmissionTexture>& textures,
                          const CutCells& cut, std::atomic<std::uint64_t>& made) {
  const Source source(world, chart, textures);
  std::vector<Facet> facets;
  for (std::size_t i = 0; i < chart.triangles.size(); ++i)
    if (const std::optional<Facet> facet = source.facet(i)) facets.push_back(*facet);
  std::vector<std::uint32_t> all(facets.size());
  std::iota(all.begin(), all.end(), 0u);
  Cutter cutter(source, std::move(facets), cut, made);
  const auto side = static_cast<std::uint32_t>(std::max(chart.size.x, chart.size.y));
  cutter.cut(ivec2(0), static_cast<int>(std::bit_ceil(side)), all);
  return std::move(cutter.cells);
}

std::vector<Cell> backsOf(std::vector<Cell> cells) {
  for (Cell& cell : cells) {
    Emission& emission = cell.emission;
    emission.positionW -= (cell.thickness + 2.f * liftAt(emission.positionW)) * emission.normalW;
    emission.normalW = -emission.normalW;
  }
  return cells;
}

}  // namespace lucerna::bake
