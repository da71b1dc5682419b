#include "bake/world.hpp"

#include <cmath>
#include <limits>

namespace lucerna::bake {
namespace {

// A normal that cannot be made unit is left 0, and the triangle's own counts.
vec3 unitOrZero(vec3 v) {
  const float length = glm::length(v);
  return length > 0.f ? v / length : vec3(0.f);
}

// NaN is not.
bool isFar(vec3 p) {
  return std::abs(p.x) > kFarthestCorner || std::abs(p.y) > kFarthestCorner ||
         std::abs(p.z) > kFarthestCorner;
}

// Makes what lies too far off no number; gives the count of triangles that have such corners.
std::size_t dropHuge(std::span<vec3> positions, const scene::Mesh& mesh) {
  std::size_t huge = 0;
  for (std::size_t i = 0; i < 3 * mesh.triangleCount(); i += 3)
    if (isFar(positions[mesh.indices[i]]) || isFar(positions[mesh.indices[i + 1]]) ||
        isFar(positions[mesh.indices[i + 2]]))
      ++huge;
  for (vec3& p : positions)
    if (isFar(p)) p = vec3(std::numeric_limits<float>::quiet_NaN());
  return huge;
}

void addObject(World& world, std::uint32_t index) {
  const scene::Object& object = world.scene->objects[index];
  const scene::Mesh& mesh = world.scene->meshes[object.mesh];
  const mat4& worldFromObject = world.scene->nodes[object.node].worldFromNode;
  const mat3 linear(worldFromObject);
  const bool mirrored = glm::determinant(linear) < 0.f;
  // The inverse transposed, but for a factor, which also works for flat matrices.
  const mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                       glm::cross(linear[0], linear[1]));
  const float side = mirrored ? -1.f : 1.f;

  const auto firstVertex = static_cast<std::uint32_t>(world.positions.size());
  for (const vec3 p : mesh.positions) world.positions.emplace_back(worldFromObject * vec4(p, 1.f));
  world.huge += dropHuge(std::span(world.positions).subspan(firstVertex), mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    world.normals.push_back(
        mesh.normals.empty() ? vec3(0.f) : unitOrZero(side * (cofactors * mesh.normals[i])));
  const std::size_t triangles = mesh.triangleCount();
  world.objects.push_back(
      {.object = index,
       .firstTriangle = static_cast<std::uint32_t>(world.triangleCount()),
       .triangleCount = static_cast<std::uint32_t>(triangles),
       .receives = world.scene->materials[object.material].model != scene::MaterialModel::Unlit,
       .mirrored = mirrored});
  for (std::size_t i = 0; i < 3 * triangles; ++i)
    world.indices.push_back(firstVertex + mesh.indices[i]);
  world.owners.insert(world.owners.end(), triangles,
                      static_cast<std::uint32_t>(world.objects.size() - 1));
}

}  // namespace

World makeWorld(const scene::Scene& scene) {
  World world;
  world.scene = &scene;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.meshes[scene.objects[i].mesh].triangleCount() > 0) addObject(world, i);
  return world;
}

}  // namespace lucerna::bake
