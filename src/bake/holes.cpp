#include "bake/holes.hpp"

#include <algorithm>
#include <cmath>

namespace lucerna::bake {
namespace {

using scene::Combine;
using scene::Wrap;

// The alpha of the picture alone decides, times the material's.
bool isPlain(const scene::Material& material, const scene::Mesh& mesh,
             const scene::Texture& texture) {
  const int channels = texture.image->channels();
  return material.albedoTexture.coordinates == scene::Coordinates::Mesh &&
         material.combine != Combine::Decal && material.combine != Combine::Replace &&
         material.albedo.w > 0.f && mesh.colors.empty() && (channels == 2 || channels == 4) &&
         texture.image->type() == ComponentType::U8 && !texture.nearest &&
         texture.wrapS == Wrap::Repeat && texture.wrapT == Wrap::Repeat;
}

int repeated(int i, int size) {
  if (static_cast<unsigned>(i) < static_cast<unsigned>(size)) return i;
  const int within = i % size;
  return within < 0 ? within + size : within;
}

int nextOf(int i, int size) {
  return i + 1 < size ? i + 1 : 0;
}

// glm::floor(), which has branches without SSE 4.1.
ivec2 below(vec2 p) {
  const ivec2 towardsZero(p);
  return towardsZero - ivec2(glm::lessThan(p, vec2(towardsZero)));
}

}  // namespace

Holes::Holes(const trace::MaterialLookup& lookup, const scene::Scene& scene,
             std::vector<trace::Spot> triangles)
    : lookup_(lookup), triangles_(std::move(triangles)) {
  for (const trace::Spot& triangle : triangles_) {
    Picture& picture = pictures_.emplace_back(pictureOf(scene, triangle));
    if (!picture.alphas) continue;
    std::vector<Cell>& cells = cells_[{picture.alphas, picture.least}];
    if (cells.empty()) cells = cellsOf(picture);
    picture.cells = cells.data();
  }
}

Holes::Picture Holes::pictureOf(const scene::Scene& scene, const trace::Spot& triangle) const {
  const scene::Material& material = lookup_.materialOf(triangle.object);
  const scene::TextureSlot& slot = material.albedoTexture;
  const scene::Mesh& mesh = scene.meshes[scene.objects[triangle.object].mesh];
  if (!slot.used() || !isPlain(material, mesh, scene.textures[slot.texture])) return {};
  const auto& stream = mesh.texCoords[static_cast<std::size_t>(slot.texCoord)];
  if (stream.empty()) return {};
  const Image& image = *scene.textures[slot.texture].image;
  Picture picture{.places = {},
                  .size = {image.width(), image.height()},
                  .channels = image.channels(),
                  .least = 255.f * material.alphaCutoff / material.albedo.w};
  for (std::size_t k = 0; k < 3; ++k) {
    const vec2 uv = trace::transformed(slot, stream[mesh.indices[3 * triangle.triangle + k]]);
    constexpr float kMost = 1e3f;  // pictures from the first: places stay exact enough
    if (!(std::abs(uv.x) < kMost && std::abs(uv.y) < kMost)) return {};
    picture.places[k] = uv * vec2(picture.size) - 0.5f;
  }
  if (!std::isfinite(picture.least)) return {};
  picture.alphas = image.as<std::uint8_t>().data() + image.channels() - 1;
  return picture;
}

std::vector<Holes::Cell> Holes::cellsOf(const Picture& picture) {
  constexpr float kSure = 0.01f;  // more than isHole() rounds
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(picture.size.x) * picture.size.y);
  for (int y = 0; y < picture.size.y; ++y)
    for (int x = 0; x < picture.size.x; ++x) {
      const int right = nextOf(x, picture.size.x), bottom = nextOf(y, picture.size.y);
      const auto [least, most] =
          std::minmax({picture.alpha(x, y), picture.alpha(right, y), picture.alpha(x, bottom),
                       picture.alpha(right, bottom)});
      cells.push_back(static_cast<float>(least) > picture.least + kSure  ? Cell::Solid
                      : static_cast<float>(most) < picture.least - kSure ? Cell::Hole
                                                                         : Cell::Mixed);
    }
  return cells;
}

// share: of the way to the next texels.
bool Holes::isHole(const Picture& picture, ivec2 cell, vec2 share) {
  const int right = nextOf(cell.x, picture.size.x), bottom = nextOf(cell.y, picture.size.y);
  const auto alpha = [&](int x, int y) { return static_cast<float>(picture.alpha(x, y)); };
  return glm::mix(glm::mix(alpha(cell.x, cell.y), alpha(right, cell.y), share.x),
                  glm::mix(alpha(cell.x, bottom), alpha(right, bottom), share.x),
                  share.y) < picture.least;
}

bool Holes::at(std::size_t triangle, vec2 barycentric) const {
  const Picture& p = pictures_[triangle];
  if (!p.alphas) {
    trace::Spot spot = triangles_[triangle];
    spot.barycentric = barycentric;
    return trace::isHole(lookup_, spot);
  }
  const vec2 place = p.places[0] * (1.f - barycentric.x - barycentric.y) +
                     p.places[1] * barycentric.x + p.places[2] * barycentric.y;
  const ivec2 corner = below(place);
  const ivec2 at(repeated(corner.x, p.size.x), repeated(corner.y, p.size.y));
  const Cell cell = p.cells[static_cast<std::ptrdiff_t>(at.y) * p.size.x + at.x];
  return cell == Cell::Mixed ? isHole(p, at, place - vec2(corner)) : cell == Cell::Hole;
}

}  // namespace lucerna::bake
