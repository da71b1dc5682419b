// What a primitive is read from: its accessors, and which of their elements it uses.
#pragma once

#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include "scene/gltf/convert.hpp"

namespace lucerna::scene::gltf {

class PrimitiveSource {
 public:
  PrimitiveSource(Context& context, const Place& primitive, std::string name);

  const Place& place() const { return primitive_; }
  const std::string& name() const { return name_; }
  Document& document() const { return context_.document; }
  std::uint32_t vertexCount() const { return vertexCount_; }  // of the accessors

  // An attribute, null if it is absent. It must have one of the numbers of components and as many
  // elements as the first one asked for.
  const Accessor* attribute(const char* name, std::initializer_list<int> components);
  // The same of a morph target, which names them like the primitive.
  const Accessor* targetAttribute(const Place& target, const char* name,
                                  std::initializer_list<int> components);
  // As glTF counts them; what was packed is a list of triangles.
  int mode() const;
  // Null if the primitive draws its vertices in their order.
  const Accessor* indices() const;

  // Gathers what `elements` use, if that is few of the accessors' vertices, and renumbers them:
  // exporters let many primitives index a few vertices each of one large accessor.
  void keepUsedVertices(std::vector<std::uint32_t>& elements);
  // Of the vertices that are used, `components` each.
  std::vector<float> floats(const Accessor& accessor, int components) const {
    return readFloats(context_.document, accessor, components, vertices_);
  }
  // "PLACE (NAME) what"
  void warn(const std::string& what) const {
    context_.document.warn(primitive_, "(" + name_ + ") " + what);
  }

 private:
  const Accessor* find(const Place& owner, const char* name) const;
  const Accessor* checked(const Place& owner, const char* name, const Accessor* accessor,
                          std::initializer_list<int> components);

  Context& context_;
  Place primitive_;
  const UnpackedPrimitive* unpacked_ = nullptr;  // if it is packed
  std::string name_;
  std::uint32_t vertexCount_ = 0;
  std::vector<std::uint32_t> vertices_;  // those that are used, if few are; else empty: all
};

template <typename Vector>
std::vector<Vector> packed(const std::vector<float>& floats) {
  std::vector<Vector> vectors(floats.size() * sizeof(float) / sizeof(Vector));
  if (!vectors.empty()) std::memcpy(&vectors[0].x, floats.data(), vectors.size() * sizeof(Vector));
  return vectors;
}

// The primitive as a Mesh; nothing, with a warning, if it has nothing to draw.
std::optional<Mesh> readPrimitive(PrimitiveSource& source);
// Parts of it: Mesh::targets and Mesh::influences.
void readTargets(PrimitiveSource& source, Mesh& mesh);
void readInfluences(PrimitiveSource& source, Mesh& mesh);

}  // namespace lucerna::scene::gltf
