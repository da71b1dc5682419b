// Primitives become indexed lists of triangles, lines or points.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/gltf/primitive_source.hpp"

namespace lucerna::scene::gltf {

namespace {

enum Mode { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

struct Element {
  std::size_t corners;
  const char* name;
};

Element elementOf(int mode) {
  if (mode == kPoints) return {1, "point"};
  return mode < kTriangles ? Element{2, "line"} : Element{3, "triangle"};
}

std::vector<std::uint32_t> lineList(const std::vector<std::uint32_t>& in, bool closed) {
  std::vector<std::uint32_t> out;
  if (in.size() < 2) return out;
  out.reserve(in.size() * 2);
  for (std::size_t i = 1; i < in.size(); ++i) out.insert(out.end(), {in[i - 1], in[i]});
  if (closed) out.insert(out.end(), {in.back(), in.front()});
  return out;
}

std::vector<std::uint32_t> triangleList(const std::vector<std::uint32_t>& in, bool fan) {
  std::vector<std::uint32_t> out;
  out.reserve(in.size() * 3);
  for (std::size_t i = 2; i < in.size(); ++i) {
    if (fan)
      out.insert(out.end(), {in[i - 1], in[i], in[0]});
    else if (i % 2 == 0)
      out.insert(out.end(), {in[i - 2], in[i - 1], in[i]});
    else
      out.insert(out.end(), {in[i - 2], in[i], in[i - 1]});  // every second one is turned round
  }
  return out;
}

// Loops, strips and fans become lists.
std::vector<std::uint32_t> elementList(std::vector<std::uint32_t> in, int mode) {
  switch (mode) {
    case kLineLoop:
    case kLineStrip:
      return lineList(in, mode == kLineLoop);
    case kTriangleStrip:
    case kTriangleFan:
      return triangleList(in, mode == kTriangleFan);
    default:
      return in;
  }
}

// `perVertex` elements for each index instead of each vertex.
template <typename T>
void unweld(std::vector<T>& stream, const std::vector<std::uint32_t>& indices,
            std::size_t perVertex = 1) {
  if (stream.empty()) return;
  std::vector<T> corners;
  corners.reserve(indices.size() * perVertex);
  for (const std::uint32_t index : indices) {
    const auto first = stream.begin() + static_cast<std::ptrdiff_t>(index * perVertex);
    corners.insert(corners.end(), first, first + static_cast<std::ptrdiff_t>(perVertex));
  }
  stream = std::move(corners);
}

// Of the streams that makeFlat() lays out anew, about.
std::uint64_t bytesOfVertex(const Mesh& mesh) {
  const std::uint64_t base = sizeof(vec3) * 2 + sizeof(vec2);
  return base + mesh.targets.size() * sizeof(vec3) + mesh.influences.perVertex * std::uint64_t{6};
}

bool finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

class PrimitiveReader {
 public:
  explicit PrimitiveReader(PrimitiveSource& source) : source_(source) {}

  std::optional<Mesh> read();

 private:
  bool readElements();
  void readPositions();
  void dropElements(const std::vector<bool>& badVertices);
  void readNormals();
  void makeFlat();
  void readTangents();
  void readTexCoords();
  void readColors();

  PrimitiveSource& source_;
  int mode_ = kTriangles;
  std::vector<std::uint32_t> elements_;  // corners of all triangles, lines or points
  Mesh mesh_;
};

bool PrimitiveReader::readElements() {
  std::vector<std::uint32_t> indices;
  const std::uint32_t vertexCount = source_.vertexCount();
  const Accessor* accessor = source_.indices();
  if (!accessor) {
    source_.document().spend(std::uint64_t{vertexCount} * 4, source_.place());
    indices.resize(vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
  } else {
    indices = readIndices(source_.document(), *accessor);
    const auto highest = std::max_element(indices.begin(), indices.end());
    if (*highest >= vertexCount) {
      source_.place().at("indices").refuse(
          fmt::format("index {} at element {} of {}", *highest, highest - indices.begin(),
                      accessor->place.pointer()),
          fmt::format("indices below {}, the count of POSITION", vertexCount));
    }
  }
  if (mode_ != kTriangles) source_.document().spend(indices.size() * 12, source_.place());
  elements_ = elementList(std::move(indices), mode_);
  const std::size_t corners = elementOf(mode_).corners;
  if (const auto rest = elements_.size() % corners; rest != 0) {
    source_.warn(fmt::format("has {} indices, not a multiple of {}: the last {} are ignored",
                             elements_.size(), corners, rest));
    elements_.resize(elements_.size() - rest);
  }
  return !elements_.empty();
}

void PrimitiveReader::readPositions() {
  const Accessor* accessor = source_.attribute("POSITION", {3});
  mesh_.positions = packed<vec3>(source_.floats(*accessor, 3));
  std::vector<bool> bad;
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
    if (finite(mesh_.positions[i])) continue;
    bad.resize(mesh_.positions.size());
    bad[i] = true;
    mesh_.positions[i] = vec3(0.f);
  }
  if (!bad.empty()) dropElements(bad);
  for (const std::uint32_t index : elements_) mesh_.bounds.grow(mesh_.positions[index]);
}

void PrimitiveReader::dropElements(const std::vector<bool>& badVertices) {
  const auto [corners, name] = elementOf(mode_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements_.size(); i += corners) {
    const auto begin = elements_.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = begin + static_cast<std::ptrdiff_t>(corners);
    if (std::any_of(begin, end, [&](std::uint32_t vertex) { return badVertices[vertex]; }))
      continue;
    std::copy(begin, end, elements_.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += corners;
  }
  source_.warn(fmt::format("has positions that are infinite or not a number: {} of {} {}s dropped",
                           (elements_.size() - kept) / corners, elements_.size() / corners, name));
  elements_.resize(kept);
}

void PrimitiveReader::readNormals() {
  const Accessor* accessor = source_.attribute("NORMAL", {3});
  if (!accessor) return;
  mesh_.normals = packed<vec3>(source_.floats(*accessor, 3));
  std::vector<bool> bad;
  for (std::size_t i = 0; i < mesh_.normals.size(); ++i) {
    vec3& normal = mesh_.normals[i];
    const float square = glm::dot(normal, normal);
    if (std::isfinite(square) && square > 1e-20f) {
      if (std::abs(square - 1.f) > 1e-4f) normal /= std::sqrt(square);
      continue;
    }
    bad.resize(mesh_.normals.size());
    bad[i] = true;
    normal = vec3(0.f);
  }
  if (bad.empty()) return;
  // Vertices without a direction take that of their triangles, weighted by area.
  for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) {
    const std::uint32_t* corner = &mesh_.indices[i];
    const vec3 a = mesh_.positions[corner[0]];
    const vec3 area = glm::cross(mesh_.positions[corner[1]] - a, mesh_.positions[corner[2]] - a);
    for (int c = 0; c < 3; ++c) {
      if (bad[corner[c]]) mesh_.normals[corner[c]] += area;
    }
  }
  for (std::size_t i = 0; i < bad.size(); ++i) {
    if (!bad[i]) continue;
    vec3& normal = mesh_.normals[i];
    const float length = glm::length(normal);
    normal = std::isfinite(length) && length > 0.f ? normal / length : vec3(0.f, 0.f, 1.f);
  }
}

// glTF 2.0, 3.7.2.1: without normals each triangle has its own, so each corner is a vertex.
void PrimitiveReader::makeFlat() {
  auto& indices = mesh_.indices;
  source_.document().spend(indices.size() * bytesOfVertex(mesh_), source_.place());
  unweld(mesh_.positions, indices);
  for (auto& texCoords : mesh_.texCoords) unweld(texCoords, indices);
  unweld(mesh_.colors, indices);
  for (MorphTarget& target : mesh_.targets) {
    unweld(target.positions, indices);
    for (auto& texCoords : target.texCoords) unweld(texCoords, indices);
    unweld(target.colors, indices);
  }
  unweld(mesh_.influences.joints, indices, mesh_.influences.perVertex);
  unweld(mesh_.influences.weights, indices, mesh_.influences.perVertex);
  mesh_.flat = true;
  std::iota(indices.begin(), indices.end(), 0u);
  makeNormals(mesh_);
}

void PrimitiveReader::readTangents() {
  const Accessor* accessor = source_.attribute("TANGENT", {4});
  if (!accessor) return;
  auto tangents = packed<vec4>(source_.floats(*accessor, 4));
  for (vec4& tangent : tangents) {
    const vec3 direction(tangent);
    const float square = glm::dot(direction, direction);
    if (!(std::isfinite(square) && square > 1e-20f)) {
      source_.warn("has tangents without a direction: they are made from the texture coordinates");
      return;
    }
    const vec3 unit = std::abs(square - 1.f) > 1e-4f ? direction / std::sqrt(square) : direction;
    tangent = vec4(unit, tangent.w < 0.f ? -1.f : 1.f);
  }
  mesh_.tangents = std::move(tangents);
}

void PrimitiveReader::readTexCoords() {
  for (std::size_t set = 0; set < 2; ++set) {
    const char* name = set == 0 ? "TEXCOORD_0" : "TEXCOORD_1";
    const Accessor* accessor = source_.attribute(name, {2});
    if (!accessor) continue;
    auto values = source_.floats(*accessor, 2);
    bool repaired = false;
    for (float& value : values) {
      if (std::isfinite(value)) continue;
      value = 0.f;
      repaired = true;
    }
    if (repaired)
      source_.warn(fmt::format("has values in {} that are not finite: 0 instead", name));
    mesh_.texCoords[set] = packed<vec2>(values);
  }
}

void PrimitiveReader::readColors() {
  const Accessor* accessor = source_.attribute("COLOR_0", {3, 4});
  if (!accessor) return;
  const auto values = source_.floats(*accessor, 4);
  mesh_.colors.resize(values.size() / 4);
  bool clamped = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = std::isfinite(values[i]) ? std::clamp(values[i], 0.f, 1.f) : 0.f;
    clamped |= !(value == values[i]);
    mesh_.colors[i / 4][static_cast<int>(i % 4)] = static_cast<std::uint8_t>(value * 255.f + 0.5f);
  }
  if (clamped) source_.warn("has values in COLOR_0 outside 0 to 1: clamped");
}

std::optional<Mesh> PrimitiveReader::read() {
  mode_ = source_.mode();
  if (!source_.attribute("POSITION", {3})) {
    source_.warn("has no POSITION: skipped");
    return std::nullopt;
  }
  if (!readElements()) {
    source_.warn(fmt::format("has no {}: skipped", elementOf(mode_).name));
    return std::nullopt;
  }
  mesh_.name = source_.name();
  source_.keepUsedVertices(elements_);
  readPositions();
  if (elements_.empty()) return std::nullopt;
  const bool triangles = mode_ >= kTriangles;
  (triangles          ? mesh_.indices
   : mode_ == kPoints ? mesh_.points
                      : mesh_.lines) = std::move(elements_);
  readNormals();
  if (!mesh_.normals.empty()) readTangents();  // else they are to be ignored
  readTexCoords();
  readColors();
  readTargets(source_, mesh_);
  readInfluences(source_, mesh_);
  if (triangles && mesh_.normals.empty()) makeFlat();
  return std::move(mesh_);
}

}  // namespace

std::optional<Mesh> readPrimitive(PrimitiveSource& source) {
  return PrimitiveReader(source).read();
}

}  // namespace lucerna::scene::gltf
