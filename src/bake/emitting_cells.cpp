#include "bake/emitting_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bake/clip_polygon.hpp"
#include "bake/triangle.hpp"
#include "trace/material_lookup.hpp"

namespace lucerna::bake {
namespace {

using glm::dvec2;

constexpr int kTile = 8;       // texels along a side that are asked at once whether they shine
constexpr int kMostCuts = 16;  // along a texel

// A triangle of the chart, as a map from texels.
struct Facet {
  std::array<vec2, 3> corners;
  vec3 originW{0.f}, stepX{0.f}, stepY{0.f};  // a place is originW + stepX * x + stepY * y
  vec3 normalW{0.f};
  vec2 uvOrigin{0.f}, uvX{0.f}, uvY{0.f};  // as places; only of a texture
  float area = 0.f;                        // m^2 of a texel

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

  bool hasTexture() const { return texture_ != nullptr; }
  std::optional<Facet> facet(std::size_t triangle) const {
    Facet facet{.corners = chart_.corners[triangle]};
    const dvec2 b = dvec2(facet.corners[1]) - dvec2(facet.corners[0]),
                c = dvec2(facet.corners[2]) - dvec2(facet.corners[0]);
    if (b.x * c.y - b.y * c.x == 0.) return {};
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
  // How finely a texel is to be cut so that no pixel is left out, and of which level.
  struct Steps {
    int cuts = 1, level = 0;
  };
  Steps steps(const Facet& facet) const {
    if (!texture_) return {};
    const vec2 across = (glm::abs(facet.uvX) + glm::abs(facet.uvY)) * pixels_;
    float pixels = std::max(across.x, across.y);
    Steps steps;
    for (; pixels > kMostCuts && steps.level + 1 < texture_->levels(); pixels *= 0.5f)
      ++steps.level;
    steps.cuts = pixels < kMostCuts ? std::max(static_cast<int>(std::ceil(pixels)), 2) : kMostCuts;
    return steps;
  }
  // Whether anything may shine within the polygon.
  bool shines(const Facet& facet, const ClipPolygon& polygon) const {
    if (!texture_) return true;
    vec2 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const dvec2 p : polygon.points()) {
      const vec2 uv = facet.uvAt(p);
      low = glm::min(low, uv);
      high = glm::max(high, uv);
    }
    return texture_->shines(low, high);
  }
  vec3 radiance(const Facet& facet, dvec2 p, int level) const {
    return texture_ ? material_.emissive * texture_->at(facet.uvAt(p), level) : material_.emissive;
  }

 private:
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

// Sums over what shines of a texel.
struct Sum {
  vec3 intensity{0.f};
  double weight = 0.;
  glm::dvec3 positionW{0.}, normalW{0.}, stepX{0.}, stepY{0.};
  dvec2 first{0.}, second{0.};  // moments in the texel

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
    cell.emission.positionW += liftAt(cell.emission.positionW) * cell.emission.normalW;
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

void addTexel(Sum& sum, const Source& source, const Facet& facet, ivec2 texel) {
  const dvec2 corner(texel);
  ClipPolygon whole(facet.corners);
  whole.cutTo(corner, corner + 1.);
  const PolygonMoments all = whole.moments();
  if (all.area <= 0. || !source.shines(facet, whole)) return;
  const auto [cuts, level] = source.steps(facet);
  const double side = 1. / cuts;
  const bool inside = all.area > 1. - 1e-9;
  for (int i = 0; i < cuts * cuts; ++i) {
    const PolygonMoments part =
        cuts == 1 ? all : partOf(facet, corner + side * dvec2(i % cuts, i / cuts), side, inside);
    if (part.area > 0.) sum.add(facet, part, corner, source.radiance(facet, part.centroid, level));
  }
}

// Adds what a triangle has of a tile's texels.
void addFacet(std::array<Sum, kTile * kTile>& sums, const Source& source, const Facet& facet,
              ivec2 tile, ivec2 end) {
  ClipPolygon whole(facet.corners);
  whole.cutTo(dvec2(tile), dvec2(end));
  if (whole.points().size() < 3 || !source.shines(facet, whole)) return;
  dvec2 low = whole.points()[0], high = low;
  for (const dvec2 p : whole.points()) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const ivec2 first = glm::max(ivec2(glm::floor(low)), tile);
  const ivec2 last = glm::min(ivec2(glm::floor(high)), end - 1);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      addTexel(sums[static_cast<std::size_t>((y - tile.y) * kTile + x - tile.x)], source, facet,
               {x, y});
}

}  // namespace

std::vector<Cell> cellsOf(const World& world, const Chart& chart,
                          const std::map<std::uint32_t, EmissionTexture>& textures) {
  const Source source(world, chart, textures);
  const ivec2 tiles = (chart.size + kTile - 1) / kTile;
  std::vector<std::vector<Facet>> touching(static_cast<std::size_t>(tiles.x) * tiles.y);
  for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
    const std::optional<Facet> facet = source.facet(i);
    if (!facet) continue;
    const auto& c = facet->corners;
    const ivec2 low = ivec2(glm::min(glm::min(c[0], c[1]), c[2])) / kTile;
    const ivec2 high = glm::min(ivec2(glm::max(glm::max(c[0], c[1]), c[2])) / kTile, tiles - 1);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        touching[static_cast<std::size_t>(y * tiles.x + x)].push_back(*facet);
  }
  std::vector<Cell> cells;
  for (std::size_t t = 0; t < touching.size(); ++t) {
    std::array<Sum, kTile * kTile> sums{};
    const ivec2 tile = kTile * ivec2(static_cast<int>(t) % tiles.x, static_cast<int>(t) / tiles.x);
    const ivec2 end = glm::min(tile + kTile, chart.size);
    for (const Facet& facet : touching[t]) addFacet(sums, source, facet, tile, end);
    for (int i = 0; i < kTile * kTile; ++i)
      if (const auto cell =
              sums[static_cast<std::size_t>(i)].cell(tile + ivec2(i % kTile, i / kTile)))
        cells.push_back(*cell);
  }
  return cells;
}

std::vector<Cell> backsOf(std::vector<Cell> cells) {
  for (Cell& cell : cells) {
    Emission& emission = cell.emission;
    emission.positionW -= 2.f * liftAt(emission.positionW) * emission.normalW;
    emission.normalW = -emission.normalW;
  }
  return cells;
}

}  // namespace lucerna::bake
