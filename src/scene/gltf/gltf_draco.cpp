// KHR_draco_mesh_compression: what is packed is asked for all at once, then stands in for
// accessors.
#include "scene/gltf/draco_decode.hpp"
#include "scene/gltf/primitive_source.hpp"

namespace lucerna::scene::gltf {

namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

// A primitive and what its packed data is to give.
struct PackedPrimitive {
  std::string key;
  Place extension;
  const Accessor* indices;
  std::vector<std::pair<std::string, const Accessor*>> attributes;
  DracoRequest request;
};

PackedPrimitive readPacked(Context& context, const Place& primitive, const Place& extension) {
  constexpr int kTriangles = 4;
  if (primitive.integer("mode", kTriangles, 0, 6) != kTriangles)
    primitive.at("mode").refuse("4 (triangles), for its data is packed by Draco");
  const auto accessorOf = [&](const Place& place) {
    return &context.accessors[place.index(context.accessors.size(), "accessors")];
  };
  PackedPrimitive packed{
      primitiveKey(primitive), extension, accessorOf(primitive.at("indices")), {}, {}};
  auto& views = context.document.views;
  const BufferView& view = views[extension.at("bufferView").index(views.size(), "bufferViews")];
  if (view.bytes.empty())
    extension.at("bufferView").refuse("a view of a buffer whose data is nowhere", "one with data");
  packed.request.packed = view.bytes;
  packed.request.indices = packed.indices->count;
  std::uint64_t bytes = std::uint64_t{packed.indices->count} * 4;
  for (const auto& [name, id] : extension.at("attributes").members()) {
    const Place place = primitive.at("attributes").at(name.c_str());
    const Accessor* accessor = accessorOf(place);
    if (packed.attributes.empty()) packed.request.vertices = accessor->count;
    if (accessor->count != packed.request.vertices) {
      place.refuse(fmt::format("an accessor with count {}", accessor->count),
                   fmt::format("{}, as in the other packed attributes", packed.request.vertices));
    }
    packed.attributes.emplace_back(name, accessor);
    packed.request.attributes.push_back({static_cast<std::uint32_t>(id.integer(0, kNone)),
                                         accessor->type,
                                         static_cast<std::uint32_t>(accessor->components)});
    bytes += accessor->count * bytesOf(packed.request.attributes.back());
  }
  if (packed.attributes.empty())
    extension.at("attributes").refuse("no attribute", "POSITION at least");
  context.document.spend(bytes, extension);
  return packed;
}

// The accessor as it is, over bytes that the document keeps from now on.
Accessor unpacked(Context& context, const Accessor& like, Bytes bytes) {
  Accessor accessor = like;
  context.document.resources.push_back(std::move(bytes));
  accessor.bytes = context.document.resources.back();
  accessor.stride = bytesOf(accessor.type) * static_cast<std::uint32_t>(accessor.components);
  accessor.lost = false;
  return accessor;
}

UnpackedPrimitive unpack(Context& context, const PackedPrimitive& packed, DracoMesh mesh) {
  UnpackedPrimitive result{*packed.indices, {}};
  result.indices.type = ComponentType::U32;
  result.indices.components = 1;
  const auto bytes = std::as_bytes(std::span(mesh.indices));
  result.indices = unpacked(context, result.indices, Bytes(bytes.begin(), bytes.end()));
  for (std::size_t i = 0; i < packed.attributes.size(); ++i) {
    const auto& [name, accessor] = packed.attributes[i];
    result.attributes.emplace(name, unpacked(context, *accessor, std::move(mesh.attributes[i])));
  }
  return result;
}

}  // namespace

void unpackPrimitives(Context& context) {
  std::vector<PackedPrimitive> packed;
  for (const Place& mesh : context.document.root().elements("meshes")) {
    for (const Place& primitive : mesh.at("primitives").elements()) {
      const auto extension = primitive.extension(kExtension);
      if (!extension || !context.unpacked.try_emplace(primitiveKey(primitive)).second) continue;
      packed.push_back(readPacked(context, primitive, *extension));
    }
  }
  if (packed.empty()) return;
  std::vector<DracoRequest> requests;
  for (const PackedPrimitive& primitive : packed) requests.push_back(primitive.request);
  auto meshes = decodeDraco(requests);
  const std::string again = std::string("export the file again, perhaps without ") + kExtension;
  if (!meshes) {
    fail("/meshes", "Draco data, whose decoder " + meshes.error().message,
         "meshes that it can unpack", again);
  }
  for (std::size_t i = 0; i < packed.size(); ++i) {
    DracoMesh& mesh = (*meshes)[i];
    if (!mesh.fault.empty())
      fail(packed[i].extension.pointer(), "Draco data with a fault: " + mesh.fault,
           "a mesh as the accessors state it", again);
    context.unpacked[packed[i].key] = unpack(context, packed[i], std::move(mesh));
  }
}

}  // namespace lucerna::scene::gltf
