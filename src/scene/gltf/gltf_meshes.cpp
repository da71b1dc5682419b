// Meshes: which of their primitives are the same, and what these become.
#include <map>

#include "scene/gltf/primitive_source.hpp"

namespace lucerna::scene::gltf {

namespace {

// Its default weights. All primitives of a mesh have as many targets.
void readWeights(const Place& mesh, const std::vector<Place>& primitives, MeshParts& parts) {
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const std::size_t targets = primitives[i].elements("targets").size();
    if (i == 0) parts.targets = targets;
    if (targets != parts.targets) {
      primitives[i].refuse(fmt::format("{} morph targets", targets),
                           fmt::format("{}, as the mesh's first primitive has", parts.targets));
    }
  }
  parts.weights = readMorphWeights(mesh, parts.targets);
}

}  // namespace

std::string primitiveKey(const Place& primitive) {
  std::string key = fmt::format("{} {}", primitive.integer("mode", 4, 0, 6),
                                primitive.integer("indices", kNone, 0, kNone));
  for (const auto& [name, accessor] : primitive.at("attributes").members()) {
    key += fmt::format(" {} {}", name, accessor.integer(0, kNone));
  }
  for (const Place& target : primitive.elements("targets")) {
    key += " target";
    for (const auto& [name, accessor] : target.members()) {
      key += fmt::format(" {} {}", name, accessor.integer(0, kNone));
    }
  }
  if (const auto packed = primitive.extension("KHR_draco_mesh_compression")) {
    key += fmt::format(" packed {}", packed->integer("bufferView", kNone, 0, kNone));
    for (const auto& [name, id] : packed->at("attributes").members()) {
      key += fmt::format(" {} {}", name, id.integer(0, kNone));
    }
  }
  return key;
}

std::vector<float> readMorphWeights(const Place& owner, std::size_t targets) {
  std::vector<float> weights;
  for (const Place& weight : owner.elements("weights")) weights.push_back(weight.number());
  if (!weights.empty() && weights.size() != targets) {
    owner.at("weights").refuse(fmt::format("{} weights", weights.size()),
                               fmt::format("{}, one a morph target", targets));
  }
  return weights;
}

void readMeshes(Context& context) {
  const Place root = context.document.root();
  const std::size_t materialCount = root.elements("materials").size();
  std::map<std::string, std::uint32_t> known;
  for (const Place& mesh : root.elements("meshes")) {
    MeshParts& made = context.meshes.emplace_back();
    const std::string name = mesh.name(fmt::format("mesh {}", context.meshes.size() - 1));
    const auto primitives = mesh.at("primitives").elements();
    readWeights(mesh, primitives, made);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const auto [it, added] = known.emplace(primitiveKey(primitives[i]), kNone);
      if (added) {
        PrimitiveSource source(context, primitives[i],
                               primitives.size() > 1 ? fmt::format("{}:{}", name, i) : name);
        if (auto read = readPrimitive(source)) {
          it->second = static_cast<std::uint32_t>(context.scene.meshes.size());
          context.scene.meshes.push_back(std::move(*read));
        }
      }
      const auto material = primitives[i].index("material", materialCount, "materials");
      if (it->second != kNone) made.parts.push_back({it->second, material});
    }
  }
}

}  // namespace lucerna::scene::gltf
