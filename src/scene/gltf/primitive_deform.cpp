// Morph targets, and joints with their weights.
#include <algorithm>
#include <cmath>

#include "scene/gltf/primitive_source.hpp"

namespace lucerna::scene::gltf {

namespace {

// Deltas of one attribute; what is no number becomes 0. Missing components are 0, too.
std::vector<float> readDeltas(PrimitiveSource& source, const Accessor& accessor, int components) {
  auto values = source.floats(accessor, components);
  if (components == 4 && accessor.components == 3) {
    for (std::size_t i = 3; i < values.size(); i += 4) values[i] = 0.f;
  }
  bool repaired = false;
  for (float& value : values) {
    if (std::isfinite(value)) continue;
    value = 0.f;
    repaired = true;
  }
  if (repaired) source.warn("has morph targets with values that are not finite: 0 instead");
  return values;
}

MorphTarget readTarget(PrimitiveSource& source, const Place& place, const Mesh& mesh) {
  MorphTarget target;
  const auto read = [&](const char* name, auto& stream, std::initializer_list<int> components) {
    using Vector = typename std::remove_reference_t<decltype(stream)>::value_type;
    if (const Accessor* accessor = source.targetAttribute(place, name, components))
      stream = packed<Vector>(readDeltas(source, *accessor, Vector::length()));
  };
  read("POSITION", target.positions, {3});
  if (!mesh.normals.empty()) read("NORMAL", target.normals, {3});
  if (!mesh.tangents.empty()) read("TANGENT", target.tangents, {3});
  if (!mesh.texCoords[0].empty()) read("TEXCOORD_0", target.texCoords[0], {2});
  if (!mesh.texCoords[1].empty()) read("TEXCOORD_1", target.texCoords[1], {2});
  if (!mesh.colors.empty()) read("COLOR_0", target.colors, {3, 4});
  return target;
}

// Weights are not negative and 1 together; a joint without weight is 0.
void normalize(PrimitiveSource& source, Influences& influences) {
  bool wrong = false, none = false;
  for (std::size_t i = 0; i < influences.weights.size(); i += influences.perVertex) {
    const std::span weights(&influences.weights[i], influences.perVertex);
    const std::span joints(&influences.joints[i], influences.perVertex);
    float sum = 0.f;
    for (float& weight : weights) {
      if (!(weight >= 0.f && std::isfinite(weight))) {
        weight = 0.f;
        wrong = true;
      }
      sum += weight;
    }
    if (!(sum > 0.f && std::isfinite(sum))) {
      none = true;
      sum = 1.f;
      std::fill(weights.begin(), weights.end(), 0.f);
      weights[0] = 1.f;
    }
    for (std::size_t k = 0; k < weights.size(); ++k) {
      weights[k] /= sum;
      if (weights[k] == 0.f) joints[k] = 0;
    }
  }
  if (wrong) source.warn("has joint weights that are negative or not finite: 0 instead");
  if (none) source.warn("has vertices without a joint's weight: they follow their first joint");
}

}  // namespace

void readTargets(PrimitiveSource& source, Mesh& mesh) {
  for (const Place& place : source.place().elements("targets"))
    mesh.targets.push_back(readTarget(source, place, mesh));
}

void readInfluences(PrimitiveSource& source, Mesh& mesh) {
  std::vector<std::vector<float>> joints, weights;  // four a vertex each
  for (int set = 0;; ++set) {
    const std::string jointsName = fmt::format("JOINTS_{}", set);
    const std::string weightsName = fmt::format("WEIGHTS_{}", set);
    const Accessor* j = source.attribute(jointsName.c_str(), {4});
    const Accessor* w = source.attribute(weightsName.c_str(), {4});
    if (!j && !w) break;
    const Place attributes = source.place().at("attributes");
    if (!j || !w) {
      attributes.refuse(j ? jointsName + " alone" : weightsName + " alone",
                        jointsName + " together with " + weightsName);
    }
    if (j->normalized || (j->type != ComponentType::U8 && j->type != ComponentType::U16)) {
      j->place.refuse(typeName(*j), "VEC4 of unsigned bytes or shorts for " + jointsName);
    }
    joints.push_back(source.floats(*j, 4));
    weights.push_back(source.floats(*w, 4));
  }
  if (joints.empty()) return;
  Influences& influences = mesh.influences;
  influences.perVertex = static_cast<std::uint32_t>(4 * joints.size());
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    for (std::size_t set = 0; set < joints.size(); ++set) {
      for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
        influences.joints.push_back(static_cast<std::uint16_t>(joints[set][i]));
        influences.weights.push_back(weights[set][i]);
      }
    }
  }
  normalize(source, influences);
}

}  // namespace lucerna::scene::gltf
