#include "passes/mirrors/mirror_faces.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/transform.hpp"

namespace lucerna::passes {
namespace {

constexpr float kFlatness = 1e-4f;  // of the mesh's size

// A face while it is gathered, in the object's space, seen from the middle of its mesh. Its plane
// is the mean of its triangles'.
struct Face {
  vec3 edge;             // of the triangle that began it
  vec3 areaNormal{0.f};  // sum of the triangles' normals, twice as long as their areas
  vec3 areaCenter{0.f};  // sum of the triangles' centres, weighted alike
  std::vector<std::size_t> triangles{};

  vec3 normal() const { return glm::normalize(areaNormal); }
  vec3 center() const { return areaCenter / glm::length(areaNormal); }
};

struct Triangle {
  std::array<vec3, 3> corners;

  vec3 areaNormal() const { return glm::cross(corners[1] - corners[0], corners[2] - corners[0]); }
  // Shortest first.
  std::array<vec3, 3> edges() const {
    std::array edges{corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
    std::ranges::sort(edges, {}, [](vec3 edge) { return glm::dot(edge, edge); });
    return edges;
  }
};

class Gathering {
 public:
  explicit Gathering(const scene::Mesh& mesh)
      : mesh_(mesh), middle_(mesh.bounds.center()), size_(mesh.bounds.diagonal()) {}

  // False: there are too many.
  bool gather() {
    for (std::size_t i = 0; i < mesh_.triangleCount(); ++i)
      if (!take(i)) return false;
    return true;
  }

  std::vector<MirrorFace> placed(const mat4& worldFromObject) const {
    std::vector<MirrorFace> result;
    for (const Face& face : faces_) result.push_back(placed(face, worldFromObject));
    return result;
  }

 private:
  Triangle triangle(std::size_t index) const {
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i)
      t.corners[i] = mesh_.positions[mesh_.indices[3 * index + i]] - middle_;
    return t;
  }

  bool take(std::size_t index) {
    const Triangle t = triangle(index);
    const vec3 areaNormal = t.areaNormal();
    const float area = glm::length(areaNormal);  // twice the triangle's
    const std::array edges = t.edges();
    // As thin as a face may be uneven: it has no normal of its own, and begins no face.
    const bool needle = !(area > kFlatness * size_ * glm::length(edges[2]));
    const auto contains = [&](const Face& face) {
      const vec3 normal = face.normal(), center = face.center();
      return (needle || glm::dot(normal, areaNormal) > 0.9f * area) &&
             std::ranges::all_of(t.corners, [&](vec3 corner) {
               return std::abs(glm::dot(normal, corner - center)) <= kFlatness * size_;
             });
    };
    auto face = std::ranges::find_if(faces_, contains);
    if (face == faces_.end()) {
      if (needle) return true;
      if (faces_.size() == kMostFaces) return false;
      // The shortest edge: of a rectangle's half a side, and not the diagonal.
      faces_.push_back({.edge = edges[0]});
      face = std::prev(faces_.end());
    }
    face->areaNormal += areaNormal;
    face->areaCenter += area * (t.corners[0] + t.corners[1] + t.corners[2]) / 3.f;
    face->triangles.push_back(index);
    return true;
  }

  MirrorFace placed(const Face& face, const mat4& worldFromObject) const {
    const vec3 normal = face.normal(), center = face.center();
    const vec3 right = glm::normalize(face.edge - normal * glm::dot(normal, face.edge));
    const vec3 up = glm::cross(normal, right);
    vec2 low(0.f), high(0.f);
    float unevenness = 0.f;
    for (const std::size_t index : face.triangles)
      for (const vec3 corner : triangle(index).corners) {
        const vec3 d = corner - center;
        const vec2 at(glm::dot(right, d), glm::dot(up, d));
        low = glm::min(low, at);
        high = glm::max(high, at);
        unevenness = std::max(unevenness, std::abs(glm::dot(normal, d)));
      }
    const auto world = [&](vec2 at) {
      return vec3(worldFromObject * vec4(middle_ + center + at.x * right + at.y * up, 1.f));
    };
    const vec3 normalW = glm::normalize(normalMatrix(mat3(worldFromObject)) * normal);
    const float scale = std::abs(glm::dot(normalW, mat3(worldFromObject) * normal));
    return {.planeW = vec4(normalW, -glm::dot(normalW, world(vec2(0.f)))),
            .cornersW = {world(low), world({high.x, low.y}), world(high), world({low.x, high.y})},
            .unevenness = scale * unevenness};
  }

  const scene::Mesh& mesh_;
  vec3 middle_;
  float size_;
  std::vector<Face> faces_;
};

}  // namespace

std::optional<std::vector<MirrorFace>> facesOf(const scene::Mesh& mesh,
                                               const mat4& worldFromObject) {
  Gathering gathering(mesh);
  if (!gathering.gather()) return std::nullopt;
  return gathering.placed(worldFromObject);
}

}  // namespace lucerna::passes
