// Primitives become indexed lists of triangles, lines or points.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

#include "scene/gltf/convert.hpp"

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

template <typename Vector>
std::vector<Vector> packed(const std::vector<float>& floats) {
  std::vector<Vector> vectors(floats.size() * sizeof(float) / sizeof(Vector));
  if (!vectors.empty()) std::memcpy(&vectors[0].x, floats.data(), vectors.size() * sizeof(Vector));
  return vectors;
}

// One element for each index; nothing if the mesh has no such stream.
template <typename T>
std::vector<T> unwelded(const std::vector<T>& stream, const std::vector<std::uint32_t>& indices) {
  std::vector<T> corners;
  if (stream.empty()) return corners;
  corners.reserve(indices.size());
  for (const std::uint32_t index : indices) corners.push_back(stream[index]);
  return corners;
}

bool finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// One primitive on its way to a Mesh.
class PrimitiveReader {
 public:
  PrimitiveReader(Context& context, const Place& primitive, std::string name)
      : context_(context), primitive_(primitive), name_(std::move(name)) {}

  // Nothing, with a warning, if it has nothing to draw.
  std::optional<Mesh> read();

 private:
  const Accessor* attribute(const char* name);
  std::vector<float> floats(const Accessor& accessor, int components) {
    return readFloats(context_.document, accessor, components, vertices_);
  }
  bool readElements();
  void keepUsedVertices();
  void readPositions();
  void dropElements(const std::vector<bool>& badVertices);
  void readNormals();
  void makeFlat();
  void readTangents();
  void readTexCoords();
  void readColors();
  void warn(const std::string& what) {
    context_.document.warn(primitive_.pointer() + " (" + name_ + ") " + what);
  }

  Context& context_;
  Place primitive_;
  std::string name_;
  std::uint32_t vertexCount_ = 0;
  int mode_ = kTriangles;
  std::vector<std::uint32_t> elements_;  // corners of all triangles, lines or points
  std::vector<std::uint32_t> vertices_;  // those that are used, if few are; else empty: all
  Mesh mesh_;
};

const Accessor* PrimitiveReader::attribute(const char* name) {
  const Place attributes = primitive_.at("attributes");
  const auto index = attributes.index(name, context_.accessors.size(), "accessors");
  if (index == kNone) return nullptr;
  const Accessor& accessor = context_.accessors[index];
  if (vertexCount_ == 0) vertexCount_ = accessor.count;
  if (accessor.count != vertexCount_) {
    attributes.at(name).refuse(fmt::format("an accessor with count {}", accessor.count),
                               fmt::format("{}, the count of POSITION", vertexCount_));
  }
  return &accessor;
}

void requireShape(const Accessor* accessor, int components, const char* attribute) {
  if (accessor && accessor->components != components) {
    accessor->place.refuse(typeName(*accessor), fmt::format("VEC{} for {}", components, attribute));
  }
}

bool PrimitiveReader::readElements() {
  std::vector<std::uint32_t> indices;
  const auto accessor = primitive_.index("indices", context_.accessors.size(), "accessors");
  if (accessor == kNone) {
    context_.document.spend(std::uint64_t{vertexCount_} * 4, primitive_);
    indices.resize(vertexCount_);
    std::iota(indices.begin(), indices.end(), 0u);
  } else {
    indices = readIndices(context_.document, context_.accessors[accessor]);
    const auto highest = std::max_element(indices.begin(), indices.end());
    if (*highest >= vertexCount_) {
      primitive_.at("indices").refuse(
          fmt::format("index {} at element {} of /accessors/{}", *highest,
                      highest - indices.begin(), accessor),
          fmt::format("indices below {}, the count of POSITION", vertexCount_));
    }
  }
  if (mode_ != kTriangles) context_.document.spend(indices.size() * 12, primitive_);
  elements_ = elementList(std::move(indices), mode_);
  const std::size_t corners = elementOf(mode_).corners;
  if (const auto rest = elements_.size() % corners; rest != 0) {
    warn(fmt::format("has {} indices, not a multiple of {}: the last {} are ignored",
                     elements_.size(), corners, rest));
    elements_.resize(elements_.size() - rest);
  }
  return !elements_.empty();
}

// Exporters let many primitives index a few vertices each of one large accessor.
void PrimitiveReader::keepUsedVertices() {
  if (elements_.size() * 2 >= vertexCount_) return;
  vertices_ = elements_;
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (std::uint32_t& index : elements_) {
    index = static_cast<std::uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), index) -
                                       vertices_.begin());
  }
}

void PrimitiveReader::readPositions() {
  const Accessor* accessor = attribute("POSITION");
  requireShape(accessor, 3, "POSITION");
  mesh_.positions = packed<vec3>(floats(*accessor, 3));
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
  warn(fmt::format("has positions that are infinite or not a number: {} of {} {}s dropped",
                   (elements_.size() - kept) / corners, elements_.size() / corners, name));
  elements_.resize(kept);
}

void PrimitiveReader::readNormals() {
  const Accessor* accessor = attribute("NORMAL");
  if (!accessor) return;
  requireShape(accessor, 3, "NORMAL");
  mesh_.normals = packed<vec3>(floats(*accessor, 3));
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
  context_.document.spend(indices.size() * (sizeof(vec3) * 2 + sizeof(vec2)), primitive_);
  mesh_.positions = unwelded(mesh_.positions, indices);
  for (auto& texCoords : mesh_.texCoords) texCoords = unwelded(texCoords, indices);
  mesh_.colors = unwelded(mesh_.colors, indices);
  std::iota(indices.begin(), indices.end(), 0u);
  makeNormals(mesh_);
}

void PrimitiveReader::readTangents() {
  const Accessor* accessor = attribute("TANGENT");
  if (!accessor) return;
  requireShape(accessor, 4, "TANGENT");
  auto tangents = packed<vec4>(floats(*accessor, 4));
  for (vec4& tangent : tangents) {
    const vec3 direction(tangent);
    const float square = glm::dot(direction, direction);
    if (!(std::isfinite(square) && square > 1e-20f)) {
      warn("has tangents without a direction: they are made from the texture coordinates");
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
    const Accessor* accessor = attribute(name);
    if (!accessor) continue;
    requireShape(accessor, 2, name);
    auto values = floats(*accessor, 2);
    bool repaired = false;
    for (float& value : values) {
      if (std::isfinite(value)) continue;
      value = 0.f;
      repaired = true;
    }
    if (repaired) warn(fmt::format("has values in {} that are not finite: 0 instead", name));
    mesh_.texCoords[set] = packed<vec2>(values);
  }
}

void PrimitiveReader::readColors() {
  const Accessor* accessor = attribute("COLOR_0");
  if (!accessor) return;
  if (accessor->components != 3) requireShape(accessor, 4, "COLOR_0");
  const auto values = floats(*accessor, 4);
  mesh_.colors.resize(values.size() / 4);
  bool clamped = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = std::isfinite(values[i]) ? std::clamp(values[i], 0.f, 1.f) : 0.f;
    clamped |= !(value == values[i]);
    mesh_.colors[i / 4][static_cast<int>(i % 4)] = static_cast<std::uint8_t>(value * 255.f + 0.5f);
  }
  if (clamped) warn("has values in COLOR_0 outside 0 to 1: clamped");
}

std::optional<Mesh> PrimitiveReader::read() {
  mode_ = static_cast<int>(primitive_.integer("mode", kTriangles, 0, 6));
  if (!attribute("POSITION")) {
    warn("has no POSITION: skipped");
    return std::nullopt;
  }
  if (!readElements()) {
    warn(fmt::format("has no {}: skipped", elementOf(mode_).name));
    return std::nullopt;
  }
  mesh_.name = name_;
  keepUsedVertices();
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
  if (triangles && mesh_.normals.empty()) makeFlat();
  if (!primitive_.elements("targets").empty()) {
    warn("has morph targets, which are not applied: drawn in its basic shape");
  }
  return std::move(mesh_);
}

// Primitives with the same key have the same triangles.
std::string keyOf(const Place& primitive) {
  std::string key = fmt::format("{} {}", primitive.integer("mode", kTriangles, 0, 6),
                                primitive.integer("indices", kNone, 0, kNone));
  for (const auto& [name, accessor] : primitive.at("attributes").members()) {
    key += fmt::format(" {} {}", name, accessor.integer(0, kNone));
  }
  return key;
}

}  // namespace

void readMeshes(Context& context) {
  const Place root = context.document.root();
  const std::size_t materialCount = root.elements("materials").size();
  std::map<std::string, std::uint32_t> known;
  for (const Place& mesh : root.elements("meshes")) {
    auto& parts = context.parts.emplace_back();
    const std::string name = mesh.text("name", fmt::format("mesh {}", context.parts.size() - 1));
    const auto primitives = mesh.at("primitives").elements();
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const auto [it, added] = known.emplace(keyOf(primitives[i]), kNone);
      if (added) {
        auto made = PrimitiveReader(context, primitives[i],
                                    primitives.size() > 1 ? fmt::format("{}:{}", name, i) : name)
                        .read();
        if (made) {
          it->second = static_cast<std::uint32_t>(context.scene.meshes.size());
          context.scene.meshes.push_back(std::move(*made));
        }
      }
      const auto material = primitives[i].index("material", materialCount, "materials");
      if (it->second != kNone) parts.push_back({it->second, material});
    }
  }
}

}  // namespace lucerna::scene::gltf
