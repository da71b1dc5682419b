// Normals and tangents for meshes whose file has none.
#include <algorithm>
#include <cmath>

#include "core/check.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {
namespace {

// Of length 1; the fallback where there is no direction.
vec3 unitOr(vec3 v, vec3 fallback) {
  const float length = glm::length(v);
  return length > 0.f && std::isfinite(length) ? v / length : fallback;
}

// Normals of a file may be zero.
vec3 anyPerpendicular(vec3 n) {
  return unitOr(glm::cross(n, std::abs(n.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0)), vec3(1, 0, 0));
}

template <typename T>
void duplicate(std::vector<T>& stream, std::uint32_t vertex) {
  if (!stream.empty()) stream.push_back(T(stream[vertex]));
}

// A second copy of the vertex with all its streams; returns its index.
std::uint32_t duplicateVertex(Mesh& mesh, std::uint32_t vertex) {
  duplicate(mesh.positions, vertex);
  duplicate(mesh.normals, vertex);
  duplicate(mesh.colors, vertex);
  for (auto& texCoords : mesh.texCoords) duplicate(texCoords, vertex);
  for (MorphTarget& target : mesh.targets) {
    duplicate(target.positions, vertex);
    duplicate(target.normals, vertex);
    duplicate(target.tangents, vertex);
    duplicate(target.colors, vertex);
    for (auto& texCoords : target.texCoords) duplicate(texCoords, vertex);
  }
  Influences& influences = mesh.influences;
  for (std::uint32_t i = 0; i < influences.perVertex; ++i) {
    const std::uint32_t of = vertex * influences.perVertex + i;
    duplicate(influences.joints, of);
    duplicate(influences.weights, of);
  }
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

float signedTexCoordArea(const std::vector<vec2>& uv, const std::uint32_t* triangle) {
  const vec2 a = uv[triangle[1]] - uv[triangle[0]];
  const vec2 b = uv[triangle[2]] - uv[triangle[0]];
  return a.x * b.y - a.y * b.x;
}

// A vertex between mirrored and plain texture coordinates would need both handednesses: the
// triangles of negative area get a copy of it.
void splitMirroredVertices(Mesh& mesh, int texCoord) {
  constexpr std::uint8_t kNegative = 1, kPositive = 2;
  const auto& uv = mesh.texCoords[texCoord];
  std::vector<std::uint8_t> sides(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto side = signedTexCoordArea(uv, &mesh.indices[i]) < 0.f ? kNegative : kPositive;
    for (std::size_t k = i; k < i + 3; ++k) sides[mesh.indices[k]] |= side;
  }
  std::vector<std::uint32_t> copyOf(mesh.positions.size(), kNone);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    if (signedTexCoordArea(uv, &mesh.indices[i]) >= 0.f) continue;
    for (std::size_t k = i; k < i + 3; ++k) {
      std::uint32_t& index = mesh.indices[k];
      if (index >= sides.size() || sides[index] != (kNegative | kPositive)) continue;
      if (copyOf[index] == kNone) copyOf[index] = duplicateVertex(mesh, index);
      index = copyOf[index];
    }
  }
}

}  // namespace

void makeNormals(Mesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), vec3(0.f));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t* v = &mesh.indices[i];
    const vec3 p = mesh.positions[v[0]];
    // Its length is twice the triangle's area: the weight.
    const vec3 n = glm::cross(mesh.positions[v[1]] - p, mesh.positions[v[2]] - p);
    for (int k = 0; k < 3; ++k) mesh.normals[v[k]] += n;
  }
  for (vec3& n : mesh.normals) n = unitOr(n, vec3(0.f, 1.f, 0.f));
}

// As MikkTSpace weighs them (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008): each
// triangle's u direction, laid into the plane of the vertex normal, counts by its angle there.
void makeTangents(Mesh& mesh, int texCoord) {
  CHECK(texCoord == 0 || texCoord == 1);
  CHECK(mesh.texCoords[texCoord].size() == mesh.positions.size());
  CHECK(mesh.normals.size() == mesh.positions.size());
  splitMirroredVertices(mesh, texCoord);
  const auto& uv = mesh.texCoords[texCoord];
  std::vector<vec3> sums(mesh.positions.size(), vec3(0.f));
  std::vector<float> handedness(mesh.positions.size(), 1.f);

  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t* v = &mesh.indices[i];
    const float area = signedTexCoordArea(uv, v);
    if (area == 0.f) continue;
    const vec3 edge1 = mesh.positions[v[1]] - mesh.positions[v[0]];
    const vec3 edge2 = mesh.positions[v[2]] - mesh.positions[v[0]];
    const vec3 tangent = (edge1 * (uv[v[2]].y - uv[v[0]].y) - edge2 * (uv[v[1]].y - uv[v[0]].y)) *
                         (area < 0.f ? -1.f : 1.f);
    for (int k = 0; k < 3; ++k) {
      const vec3 n = mesh.normals[v[k]];
      const vec3 inPlane = tangent - n * glm::dot(n, tangent);
      const vec3 a = mesh.positions[v[(k + 1) % 3]] - mesh.positions[v[k]];
      const vec3 b = mesh.positions[v[(k + 2) % 3]] - mesh.positions[v[k]];
      const float lengths = glm::length(a) * glm::length(b) * glm::length(inPlane);
      if (!(lengths > 0.f) || !std::isfinite(lengths)) continue;
      const float cosine = glm::dot(a, b) / (glm::length(a) * glm::length(b));
      const float angle = std::acos(std::clamp(cosine, -1.f, 1.f));
      sums[v[k]] += glm::normalize(inPlane) * angle;
      // As in glTF, w * cross(n, t) points up in the image, against growing v: +1 on a picture
      // that is not mirrored, whose area is negative because v runs downwards.
      handedness[v[k]] = area < 0.f ? 1.f : -1.f;
    }
  }

  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float length = glm::length(sums[i]);
    const vec3 t = length > 1e-8f ? sums[i] / length : anyPerpendicular(mesh.normals[i]);
    mesh.tangents[i] = vec4(t, handedness[i]);
  }
}

}  // namespace lucerna::scene
