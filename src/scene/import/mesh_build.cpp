#include "scene/import/mesh_build.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <tuple>

#include "core/parallel.hpp"

namespace lucerna::scene {
namespace {

// Above this many corners at one point (the tip of a fine cone), pairs of faces are not compared.
constexpr std::uint32_t kManyCorners = 64;
constexpr std::size_t kGrain = 1u << 14;

bool finite(vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void dropBadTriangles(Mesh& mesh, std::size_t& dropped) {
  std::vector<std::uint32_t>& indices = mesh.indices;
  const auto good = [&](std::uint32_t index) {
    return index < mesh.positions.size() && finite(mesh.positions[index]);
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    if (!good(indices[i]) || !good(indices[i + 1]) || !good(indices[i + 2])) {
      ++dropped;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) indices[kept++] = indices[i + k];
  }
  indices.resize(kept);
}

std::uint32_t hashPosition(vec3 p) {
  std::uint32_t bits[3];
  std::memcpy(bits, &p, sizeof bits);
  std::uint64_t h = bits[0] * 0x9E3779B97F4A7C15ull;
  h = (h ^ bits[1]) * 0xC2B2AE3D27D4EB4Full;
  h = (h ^ bits[2]) * 0x165667B19E3779F9ull;
  return static_cast<std::uint32_t>(h >> 32);
}

// point[v]: the number of vertex v's place; equal places have equal numbers, counted from 0 in the
// order of first sight. Returns how many there are.
std::uint32_t numberPoints(const std::vector<vec3>& positions, std::vector<std::uint32_t>& point) {
  const std::size_t slots = std::bit_ceil(std::max<std::size_t>(2 * positions.size(), 16));
  std::vector<std::uint32_t> table(slots, kNone);  // open addressing; holds vertex numbers
  point.resize(positions.size());
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (!finite(positions[v])) continue;  // no triangle uses it
    const vec3 p = positions[v] + 0.f;    // -0 becomes 0, so that equal places have equal bits
    std::size_t slot = hashPosition(p) & (slots - 1);
    while (table[slot] != kNone && positions[table[slot]] != p) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kNone) {
      table[slot] = v;
      point[v] = count++;
    } else {
      point[v] = point[table[slot]];
    }
  }
  return count;
}

// The corners (positions in `indices`) at each point, as ranges of one list.
struct Corners {
  std::vector<std::uint32_t> first, list;  // point p: list[first[p]] to list[first[p + 1]]

  Corners(const std::vector<std::uint32_t>& indices, const std::vector<std::uint32_t>& point,
          std::uint32_t points)
      : first(points + 1, 0), list(indices.size()) {
    for (const std::uint32_t v : indices) ++first[point[v] + 1];
    for (std::uint32_t p = 0; p < points; ++p) first[p + 1] += first[p];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t c = 0; c < indices.size(); ++c) list[next[point[indices[c]]]++] = c;
  }
};

vec3 unitOr(vec3 n, vec3 fallback) {
  const float length = glm::length(n);
  return length > 0.f && std::isfinite(length) ? n / length : fallback;
}

struct Faces {
  std::vector<vec3> weighted;  // normal times twice the area
  std::vector<vec3> unit;
};

Faces facesOf(const Mesh& mesh) {
  Faces faces;
  faces.weighted.resize(mesh.triangleCount());
  faces.unit.resize(mesh.triangleCount());
  parallelFor(mesh.triangleCount(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const vec3 p = mesh.positions[mesh.indices[3 * t]];
      const vec3 n = glm::cross(mesh.positions[mesh.indices[3 * t + 1]] - p,
                                mesh.positions[mesh.indices[3 * t + 2]] - p);
      faces.weighted[t] = finite(n) ? n : vec3(0.f);
      faces.unit[t] = unitOr(n, vec3(0.f));
    }
  });
  return faces;
}

// A normal for each corner at one point.
void smoothAt(std::span<const std::uint32_t> corners, const Faces& faces,
              std::vector<vec3>& normals) {
  const float cosCrease = std::cos(kCreaseAngle);
  const vec3 up(0.f, 1.f, 0.f);
  vec3 all(0.f);
  for (const std::uint32_t corner : corners) all += faces.weighted[corner / 3];
  for (const std::uint32_t corner : corners) {
    const vec3 own = faces.unit[corner / 3];
    vec3 sum = all;
    if (corners.size() <= kManyCorners && own != vec3(0.f)) {
      sum = vec3(0.f);
      for (const std::uint32_t other : corners)
        if (glm::dot(own, faces.unit[other / 3]) > cosCrease) sum += faces.weighted[other / 3];
    }
    normals[corner] = unitOr(sum, own == vec3(0.f) ? up : own);
  }
}

// Everything that makes two corners at one point different vertices.
struct Key {
  vec3 normal{0.f};
  std::array<vec2, 2> texCoords{vec2(0.f), vec2(0.f)};
  std::uint32_t color = 0;

  auto tie() const {
    return std::tie(normal.x, normal.y, normal.z, texCoords[0].x, texCoords[0].y, texCoords[1].x,
                    texCoords[1].y, color);
  }
  bool operator==(const Key& other) const { return tie() == other.tie(); }
  bool operator<(const Key& other) const { return tie() < other.tie(); }
};

class Welder {
 public:
  Welder(const Mesh& loose, const std::vector<vec3>& cornerNormals, Mesh& result)
      : loose_(loose), cornerNormals_(cornerNormals), result_(result) {}

  void weld(std::span<const std::uint32_t> corners) {
    keys_.clear();
    vertices_.clear();
    if (corners.size() > kManyCorners) return weldMany(corners);
    for (const std::uint32_t corner : corners) {
      const Key key = keyOf(corner);
      const auto found = std::find(keys_.begin(), keys_.end(), key);
      if (found == keys_.end()) {
        keys_.push_back(key);
        vertices_.push_back(addVertex(corner, key));
        result_.indices[corner] = vertices_.back();
      } else {
        result_.indices[corner] = vertices_[static_cast<std::size_t>(found - keys_.begin())];
      }
    }
  }

 private:
  void weldMany(std::span<const std::uint32_t> corners) {
    std::vector<std::pair<Key, std::uint32_t>> sorted;
    for (const std::uint32_t corner : corners) sorted.emplace_back(keyOf(corner), corner);
    std::sort(sorted.begin(), sorted.end());
    std::uint32_t vertex = kNone;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      if (i == 0 || !(sorted[i].first == sorted[i - 1].first))
        vertex = addVertex(sorted[i].second, sorted[i].first);
      result_.indices[sorted[i].second] = vertex;
    }
  }

  Key keyOf(std::uint32_t corner) const {
    Key key;
    const std::uint32_t v = loose_.indices[corner];
    key.normal = cornerNormals_[corner];
    for (std::size_t set = 0; set < 2; ++set)
      if (!loose_.texCoords[set].empty()) key.texCoords[set] = loose_.texCoords[set][v];
    if (!loose_.colors.empty()) key.color = std::bit_cast<std::uint32_t>(loose_.colors[v]);
    return key;
  }

  std::uint32_t addVertex(std::uint32_t corner, const Key& key) {
    const std::uint32_t v = loose_.indices[corner];
    result_.positions.push_back(loose_.positions[v] + 0.f);
    result_.normals.push_back(key.normal);
    for (std::size_t set = 0; set < 2; ++set)
      if (!loose_.texCoords[set].empty()) result_.texCoords[set].push_back(key.texCoords[set]);
    if (!loose_.colors.empty()) result_.colors.push_back(loose_.colors[v]);
    return static_cast<std::uint32_t>(result_.positions.size() - 1);
  }

  const Mesh& loose_;
  const std::vector<vec3>& cornerNormals_;
  Mesh& result_;
  std::vector<Key> keys_;
  std::vector<std::uint32_t> vertices_;
};

// Non-finite numbers in the streams that are not positions.
void repairStreams(Mesh& mesh) {
  for (auto& texCoords : mesh.texCoords)
    for (vec2& uv : texCoords)
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = vec2(0.f);
}

std::vector<vec3> cornerNormals(const Mesh& mesh, const Corners& corners, std::uint32_t points) {
  std::vector<vec3> normals(mesh.indices.size());
  if (mesh.normals.empty()) {
    const Faces faces = facesOf(mesh);
    parallelFor(points, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
        smoothAt({corners.list.data() + corners.first[p], corners.first[p + 1] - corners.first[p]},
                 faces, normals);
    });
    return normals;
  }
  parallelFor(mesh.triangleCount(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const std::uint32_t* v = &mesh.indices[3 * t];
      const vec3 face = glm::cross(mesh.positions[v[1]] - mesh.positions[v[0]],
                                   mesh.positions[v[2]] - mesh.positions[v[0]]);
      for (std::size_t k = 0; k < 3; ++k)
        normals[3 * t + k] = unitOr(mesh.normals[v[k]], unitOr(face, vec3(0.f, 1.f, 0.f)));
    }
  });
  return normals;
}

}  // namespace

Mesh buildMesh(Mesh loose, std::size_t& dropped) {
  dropBadTriangles(loose, dropped);
  repairStreams(loose);
  std::vector<std::uint32_t> point;
  const std::uint32_t points = numberPoints(loose.positions, point);
  const Corners corners(loose.indices, point, points);
  const std::vector<vec3> normals = cornerNormals(loose, corners, points);

  Mesh mesh;
  mesh.name = std::move(loose.name);
  mesh.indices.resize(loose.indices.size());
  mesh.positions.reserve(points);
  mesh.normals.reserve(points);
  Welder welder(loose, normals, mesh);
  for (std::uint32_t p = 0; p < points; ++p)
    welder.weld({corners.list.data() + corners.first[p], corners.first[p + 1] - corners.first[p]});
  for (const vec3 position : mesh.positions) mesh.bounds.grow(position);
  return mesh;
}

}  // namespace lucerna::scene
