#include "bake/holes.hpp"

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

}  // namespace

Holes::Holes(const trace::MaterialLookup& lookup, const scene::Scene& scene,
             std::vector<trace::Spot> triangles)
    : lookup_(lookup), triangles_(std::move(triangles)) {
  for (const trace::Spot& triangle : triangles_) pictures_.push_back(pictureOf(scene, triangle));
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
  picture.alphas = image.as<std::uint8_t>().data() + image.channels() - 1;
  return picture;
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
  const vec2 corner = glm::floor(place), share = place - corner;
  const int left = repeated(static_cast<int>(corner.x), p.size.x),
            right = left + 1 < p.size.x ? left + 1 : 0,
            top = repeated(static_cast<int>(corner.y), p.size.y),
            bottom = top + 1 < p.size.y ? top + 1 : 0;
  const auto alpha = [&](int x, int y) {
    return static_cast<float>(
        p.alphas[(static_cast<std::ptrdiff_t>(y) * p.size.x + x) * p.channels]);
  };
  return glm::mix(glm::mix(alpha(left, top), alpha(right, top), share.x),
                  glm::mix(alpha(left, bottom), alpha(right, bottom), share.x), share.y) < p.least;
}

}  // namespace lucerna::bake
