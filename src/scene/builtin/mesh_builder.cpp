#include "scene/builtin/mesh_builder.hpp"

#include <cmath>

#include "core/check.hpp"

namespace lucerna::scene::builtin {
namespace {

vec3 flatNormal(vec3 a, vec3 b, vec3 c) {
  const vec3 n = glm::cross(b - a, c - a);
  const float length = glm::length(n);
  CHECK(length > 0, "a triangle without area");
  return n / length;
}

// The outward normals (radial, up) at both ends of each profile segment.
struct SegmentNormals {
  vec2 start, end;
};

std::vector<SegmentNormals> profileNormals(std::span<const vec2> profile, float creaseCosine) {
  std::vector<SegmentNormals> normals;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const vec2 along = glm::normalize(profile[i + 1] - profile[i]);
    normals.push_back({vec2(along.y, -along.x), vec2(along.y, -along.x)});
  }
  for (std::size_t i = 0; i + 1 < normals.size(); ++i) {
    const vec2 before = normals[i].end, after = normals[i + 1].start;
    if (glm::dot(before, after) >= creaseCosine)
      normals[i].end = normals[i + 1].start = glm::normalize(before + after);
  }
  return normals;
}

}  // namespace

std::uint32_t MeshBuilder::vertex(vec3 position, vec3 normal, vec2 texCoord) {
  mesh_.positions.push_back(vec3(meshFromLocal_ * vec4(position, 1)));
  mesh_.normals.push_back(glm::normalize(mat3(meshFromLocal_) * normal));
  mesh_.texCoords[0].push_back(texCoord);
  return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void MeshBuilder::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
}

void MeshBuilder::quad(const std::array<vec3, 4>& corners, const std::array<vec2, 4>& texCoords) {
  const vec3 normal = flatNormal(corners[0], corners[1], corners[2]);
  const std::uint32_t first = vertex(corners[0], normal, texCoords[0]);
  for (int i = 1; i < 4; ++i) vertex(corners[i], normal, texCoords[i]);
  addTriangle(first, first + 1, first + 2);
  addTriangle(first, first + 2, first + 3);
}

void MeshBuilder::triangle(const std::array<vec3, 3>& corners,
                           const std::array<vec2, 3>& texCoords) {
  const vec3 normal = flatNormal(corners[0], corners[1], corners[2]);
  const std::uint32_t first = vertex(corners[0], normal, texCoords[0]);
  for (int i = 1; i < 3; ++i) vertex(corners[i], normal, texCoords[i]);
  addTriangle(first, first + 1, first + 2);
}

void MeshBuilder::quad(const std::array<vec3, 4>& corners, float metresPerTile) {
  const vec3 right = glm::normalize(corners[1] - corners[0]);
  const vec3 normal = flatNormal(corners[0], corners[1], corners[2]);
  const vec3 up = glm::cross(normal, right);
  std::array<vec2, 4> texCoords;
  for (int i = 0; i < 4; ++i) {
    const vec3 d = corners[i] - corners[0];
    texCoords[i] = vec2(glm::dot(d, right), -glm::dot(d, up)) / metresPerTile;
  }
  quad(corners, texCoords);
}

void MeshBuilder::box(vec3 a, vec3 b, float metresPerTile, unsigned faces) {
  const auto face = [&](unsigned bit, vec3 p0, vec3 p1, vec3 p2, vec3 p3) {
    if (faces & bit) quad({p0, p1, p2, p3}, metresPerTile);
  };
  face(kFaceLeft, {a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z});
  face(kFaceRight, {b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z});
  face(kFaceBottom, {a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
  face(kFaceTop, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z});
  face(kFaceBack, {b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z});
  face(kFaceFront, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
}

void MeshBuilder::roundedBox(vec3 low, vec3 high, float radius, int segments) {
  const vec3 center = 0.5f * (low + high), half = 0.5f * (high - low), flat = half - radius;
  CHECK(segments >= 1 && radius > 0 && glm::all(glm::greaterThan(flat, vec3(0))));
  // Places across a side: the roundings in equal angles, the flat part in one piece.
  const int count = 2 * segments + 2;
  const auto across = [&](int i, float flatHalf) {
    const int step = i <= segments ? segments - i : i - segments - 1;
    const float angle = 0.25f * kPi * static_cast<float>(step) / static_cast<float>(segments);
    const float place = flatHalf + radius * std::tan(angle);
    return i <= segments ? -place : place;
  };
  for (int side = 0; side < 6; ++side) {
    // v is up on the upright sides; u runs to the right of it seen from outside.
    const int axis = side / 2, u = axis == 0 ? 2 : 0, v = axis == 1 ? 2 : 1;
    const float sign = side % 2 == 0 ? 1.f : -1.f;
    const float right = axis == 2 ? sign : -sign;
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (int row = 0; row < count; ++row)
      for (int column = 0; column < count; ++column) {
        vec3 place(0.f);
        place[axis] = sign * half[axis];
        place[u] = right * across(column, flat[u]);
        place[v] = across(row, flat[v]);
        const vec3 core = glm::clamp(place, -flat, flat);
        const vec3 normal = glm::normalize(place - core);
        const vec2 share(place[u] * right / half[u], place[v] / half[v]);
        vertex(center + core + radius * normal, normal,
               vec2(0.5f, 0.5f) + vec2(0.5f, -0.5f) * share);
      }
    for (int row = 0; row + 1 < count; ++row)
      for (int column = 0; column + 1 < count; ++column) {
        const auto a = first + static_cast<std::uint32_t>(row * count + column);
        const auto above = a + static_cast<std::uint32_t>(count);
        addTriangle(a, a + 1, above + 1);
        addTriangle(a, above + 1, above);
      }
  }
}

void MeshBuilder::lathe(std::span<const vec2> profile, const Lathe& lathe) {
  CHECK(profile.size() >= 2 && lathe.segments >= 3);
  const std::vector<SegmentNormals> normals = profileNormals(profile, lathe.creaseCosine);
  float height = 0;  // along the profile, m
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const vec2 low = profile[i], high = profile[i + 1];
    const float nextHeight = height + glm::length(high - low);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    const float around = 2 * kPi * std::max(low.x, high.x) / lathe.metresPerTile.x;
    for (int s = 0; s <= lathe.segments; ++s) {
      // The seam closes exactly: the last column repeats the first one's angle.
      const float share = static_cast<float>(s) / static_cast<float>(lathe.segments);
      const float angle = s == lathe.segments ? 0.f : 2 * kPi * share;
      const float c = std::cos(angle), sn = std::sin(angle);
      const float wave = static_cast<float>(lathe.flutes) * angle;
      const float scale = 1 - lathe.fluteDepth * (0.5f - 0.5f * std::cos(wave));
      const float slope =
          -lathe.fluteDepth * 0.5f * static_cast<float>(lathe.flutes) * std::sin(wave);
      // Radial direction turned by the flutes' slope d(radius)/d(angle) / radius.
      const vec2 outward = glm::normalize(scale * vec2(c, sn) - slope * vec2(-sn, c));
      const float u = share * around;
      const auto add = [&](vec2 point, vec2 normal, float v) {
        const vec3 position(point.x * scale * c, point.y, point.x * scale * sn);
        vertex(position, vec3(outward.x * normal.x, normal.y, outward.y * normal.x),
               vec2(u, -v / lathe.metresPerTile.y));
      };
      add(low, normals[i].start, height);
      add(high, normals[i].end, nextHeight);
    }
    for (int s = 0; s < lathe.segments; ++s) {
      const std::uint32_t a = first + 2 * static_cast<std::uint32_t>(s);
      if (low.x > 0) addTriangle(a, a + 1, a + 2);
      if (high.x > 0) addTriangle(a + 1, a + 3, a + 2);
    }
    height = nextHeight;
  }
}

void MeshBuilder::grid(int columns, int rows, const std::function<vec3(float s, float t)>& position,
                       vec2 tiles) {
  constexpr float kStep = 1e-3f;
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const float s = static_cast<float>(column) / static_cast<float>(columns);
      const float t = static_cast<float>(row) / static_cast<float>(rows);
      const vec3 du = position(s + kStep, t) - position(s - kStep, t);
      const vec3 dv = position(s, t + kStep) - position(s, t - kStep);
      vertex(position(s, t), glm::normalize(glm::cross(du, dv)), vec2(s, 1 - t) * tiles);
    }
  }
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t column = 0; column + 1 < stride; ++column) {
      const std::uint32_t a = first + row * stride + column;
      addTriangle(a, a + 1, a + stride + 1);
      addTriangle(a, a + stride + 1, a + stride);
    }
  }
}

void MeshBuilder::archRing(vec3 center, float inner, float outer, float back, float front,
                           int segments, float metresPerTile) {
  const auto at = [&](float radius, float angle, float z) {
    return center + vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int i = 0; i < segments; ++i) {
    const float a0 = kPi * static_cast<float>(i) / static_cast<float>(segments);
    const float a1 = kPi * static_cast<float>(i + 1) / static_cast<float>(segments);
    quad({at(outer, a0, front), at(outer, a1, front), at(inner, a1, front), at(inner, a0, front)},
         metresPerTile);
    quad({at(inner, a0, back), at(inner, a1, back), at(outer, a1, back), at(outer, a0, back)},
         metresPerTile);
    quad({at(inner, a0, front), at(inner, a1, front), at(inner, a1, back), at(inner, a0, back)},
         metresPerTile);
    quad({at(outer, a0, back), at(outer, a1, back), at(outer, a1, front), at(outer, a0, front)},
         metresPerTile);
  }
}

Mesh MeshBuilder::take(std::string name) {
  Mesh mesh = std::move(mesh_);
  mesh_ = {};
  mesh.name = std::move(name);
  for (const vec3& position : mesh.positions) mesh.bounds.grow(position);
  return mesh;
}

}  // namespace lucerna::scene::builtin
