#include "lightmap/place.hpp"

#include <map>
#include <tuple>

#include "core/check.hpp"

namespace lucerna::lightmap {
namespace {

// One vertex of the old mesh for each of the new one.
struct Split {
  std::vector<std::uint32_t> sources;
  std::vector<vec3> coords;
  std::vector<std::uint32_t> indices;
};

Split split(const scene::Mesh& mesh, std::span<const TrianglePlace> places, int side) {
  using Key = std::tuple<std::uint32_t, std::int32_t, float, float>;
  std::map<Key, std::uint32_t> known;
  Split result;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t source = mesh.indices[3 * i + k];
      const TrianglePlace& place = places[i];
      const vec2 corner = place.corners[k];
      const auto [at, isNew] = known.try_emplace(Key(source, place.map, corner.x, corner.y),
                                                 static_cast<std::uint32_t>(result.sources.size()));
      if (isNew) {
        result.sources.push_back(source);
        result.coords.emplace_back(corner / static_cast<float>(side), place.map);
      }
      result.indices.push_back(at->second);
    }
  return result;
}

template <typename T>
std::vector<T> picked(const std::vector<T>& stream, std::span<const std::uint32_t> sources) {
  std::vector<T> result;
  if (stream.empty()) return result;
  result.reserve(sources.size());
  for (const std::uint32_t source : sources) result.push_back(stream[source]);
  return result;
}

scene::Mesh meshWith(const scene::Mesh& mesh, std::span<const TrianglePlace> places, int side) {
  Split parts = split(mesh, places, side);
  scene::Mesh made;
  made.name = mesh.name;
  made.positions = picked(mesh.positions, parts.sources);
  made.normals = picked(mesh.normals, parts.sources);
  made.tangents = picked(mesh.tangents, parts.sources);
  for (std::size_t set = 0; set < made.texCoords.size(); ++set)
    made.texCoords[set] = picked(mesh.texCoords[set], parts.sources);
  made.colors = picked(mesh.colors, parts.sources);
  made.indices = std::move(parts.indices);
  made.lightmap = std::move(parts.coords);
  made.bounds = mesh.bounds;
  made.flat = mesh.flat;
  return made;
}

bool bends(const scene::Scene& scene, const scene::Object& object) {
  return object.skin != scene::kNone || !scene.meshes[object.mesh].targets.empty();
}

}  // namespace

void placeInMaps(scene::Scene& scene, const Layout& layout) {
  CHECK(checkFits(layout, scene));
  std::vector<std::uint32_t> users(scene.meshes.size(), 0);
  for (const scene::Object& object : scene.objects) ++users[object.mesh];
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    scene::Object& object = scene.objects[i];
    if (layout.objects[i].empty() || bends(scene, object)) continue;
    scene::Mesh made = meshWith(scene.meshes[object.mesh], layout.objects[i], layout.side);
    if (users[object.mesh]-- == 1) {
      scene.meshes[object.mesh] = std::move(made);  // its last user
      continue;
    }
    object.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(made));
  }
}

}  // namespace lucerna::lightmap
