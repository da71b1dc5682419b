// Meshes: one primitive for each object and map that its triangles lie in. Primitives of a mesh
// share its vertices.
#include <algorithm>

#include "core/check.hpp"
#include "scene/gltf/writer_parts.hpp"

namespace lucerna::scene::gltf {
namespace {

enum Mode { kPoints = 0, kLines = 1, kTriangles = 4 };

Mode modeOf(const Mesh& mesh) {
  return !mesh.lines.empty() ? kLines : !mesh.points.empty() ? kPoints : kTriangles;
}

std::vector<vec2> coordinatesOf(const std::vector<vec3>& lightmap) {
  std::vector<vec2> coordinates;
  coordinates.reserve(lightmap.size());
  for (const vec3& place : lightmap) coordinates.emplace_back(place);
  return coordinates;
}

}  // namespace

// Vertices of a triangle lie in one map.
void MeshWriter::addParts(const Mesh& mesh, Streams& streams) {
  std::map<int, std::vector<std::uint32_t>> parts;
  if (mesh.lightmap.empty() || out_.settings.lightmaps.empty()) {
    parts[-1] = mesh.elements();
  } else {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const int map = static_cast<int>(mesh.lightmap[mesh.indices[i]].z);
      CHECK(map < static_cast<int>(out_.settings.lightmaps.size()));
      parts[map].insert(parts[map].end(), &mesh.indices[i], &mesh.indices[i] + 3);
    }
    if (parts.rbegin()->first >= 0)
      streams.accessors["lightmap"] = addStream(out_, coordinatesOf(mesh.lightmap));
  }
  for (const auto& [map, indices] : parts)
    streams.parts.push_back({map, addIndices(out_, indices, mesh.positions.size())});
}

MeshWriter::Streams& MeshWriter::streamsOf(std::uint32_t index) {
  Streams& streams = streams_[index];
  if (!streams.parts.empty()) return streams;
  const Mesh& mesh = out_.scene.meshes[index];
  streams.accessors["POSITION"] = addPositions(out_, mesh.positions);
  const auto add = [&](const char* attribute, const auto& values) {
    if (!values.empty()) streams.accessors[attribute] = addStream(out_, std::span(values));
  };
  add("NORMAL", mesh.normals);
  add("TANGENT", mesh.tangents);
  add("TEXCOORD_0", mesh.texCoords[0]);
  add("COLOR_0", mesh.colors);
  addParts(mesh, streams);
  return streams;
}

std::size_t MeshWriter::zeros(std::size_t count) {
  const auto [known, isNew] = zeros_.emplace(count, 0);
  if (isNew) known->second = addZeros(out_, count);
  return known->second;
}

// Sets of texture coordinates are numbered without gaps: what the mesh lacks is 0, as Lucerna reads
// it.
Json MeshWriter::attributes(const Object& object, const Part& part) {
  const Mesh& mesh = out_.scene.meshes[object.mesh];
  Streams& streams = streamsOf(object.mesh);
  const Material& material = out_.scene.materials[object.material];
  const int lightSet = part.map < 0 ? -1 : lightmapSet(material);
  const bool ownSet1 = !mesh.texCoords[1].empty() && lightSet != 1;
  if (ownSet1 && !streams.accessors.contains("TEXCOORD_1"))
    streams.accessors["TEXCOORD_1"] = addStream(out_, mesh.texCoords[1]);
  std::map<std::string, std::size_t> named = streams.accessors;
  const auto light = named.extract("lightmap");
  if (lightSet >= 0) named[fmt::format("TEXCOORD_{}", lightSet)] = light.mapped();
  const int sets = std::max({lightSet + 1, ownSet1 ? 2 : 0, coordinateSets(material)});
  for (int set = 0; set < sets; ++set) {
    const std::string name = fmt::format("TEXCOORD_{}", set);
    if (!named.contains(name)) named[name] = zeros(mesh.positions.size());
  }
  Json json = Json::object();
  for (const auto& [name, accessor] : named) json[name] = accessor;
  return json;
}

void MeshWriter::addPrimitives(const Object& object, Json& primitives) {
  const Mode mode = modeOf(out_.scene.meshes[object.mesh]);
  for (const Part& part : streamsOf(object.mesh).parts) {
    Json primitive{{"attributes", attributes(object, part)},
                   {"indices", part.indices},
                   {"material", materials_.material(object.material, part.map)}};
    if (mode != kTriangles) primitive["mode"] = static_cast<int>(mode);
    primitives.push_back(std::move(primitive));
  }
}

std::size_t MeshWriter::mesh(std::span<const Object> objects) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> key;
  for (const Object& object : objects) key.emplace_back(object.mesh, object.material);
  const auto [known, isNew] = meshes_.emplace(std::move(key), 0);
  if (!isNew) return known->second;
  Json json = Json::object();
  const std::string& name = out_.scene.meshes[objects.front().mesh].name;
  if (!name.empty()) json["name"] = name;
  Json primitives = Json::array();
  for (const Object& object : objects) addPrimitives(object, primitives);
  json["primitives"] = std::move(primitives);
  known->second = out_.append("meshes", std::move(json));
  return known->second;
}

}  // namespace lucerna::scene::gltf
