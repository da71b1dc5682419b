// KHR_draco_mesh_compression: what is packed is asked for all at once, then stands in for
// accessors.
#include <algorithm>
#include <map>

#include "scene/gltf/draco_decode.hpp"
#include "scene/gltf/primitive_source.hpp"

namespace lucerna::scene::gltf {

namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";
constexpr const char* kPlain = ": the data beside it, which are not packed, are drawn";

// A primitive and what its packed data is to give.
struct PackedPrimitive {
  std::string key;
  Place extension;
  const Accessor* indices;
  std::vector<std::pair<std::string, const Accessor*>> attributes;
};

// Gathers what is packed: data that many primitives name is sent to the decoder once.
class Packer {
 public:
  explicit Packer(Context& context) : context_(context) {}
  void add(const Place& primitive, const Place& extension);

  std::vector<PackedPrimitive> primitives;
  DracoJob job;  // a request for each of them

 private:
  const Accessor* accessorOf(const Place& place) const {
    return &context_.accessors[place.index(context_.accessors.size(), "accessors")];
  }
  std::uint32_t dataOf(const Place& extension);

  Context& context_;
  std::map<std::uint32_t, std::uint32_t> known_;  // bufferView: DracoJob::packed
};

std::uint32_t Packer::dataOf(const Place& extension) {
  const auto& views = context_.document.views;
  const Place place = extension.at("bufferView");
  const std::uint32_t index = place.index(views.size(), "bufferViews");
  const BufferView& view = views[index];
  if (view.bytes.empty()) place.refuse("a view of a buffer whose data is nowhere", "one with data");
  const auto [known, isNew] = known_.emplace(index, static_cast<std::uint32_t>(job.packed.size()));
  if (isNew) job.packed.push_back(view.bytes);
  return known->second;
}

void Packer::add(const Place& primitive, const Place& extension) {
  const auto mode = primitive.integer("mode", 4, 0, 6);
  if (mode != 4 && mode != 5) {
    primitive.at("mode").refuse("4 (triangles) or 5 (a strip of them), which Draco can pack");
  }
  PackedPrimitive packed{
      primitiveKey(primitive), extension, accessorOf(primitive.at("indices")), {}};
  DracoRequest request;
  request.packed = dataOf(extension);
  request.leastIndices = request.mostIndices = packed.indices->count;
  if (mode == 5) {  // a list comes of it too, which has fewer triangles where some are degenerate
    request.leastIndices = 3;
    request.mostIndices = 3 * std::max<std::uint64_t>(packed.indices->count, 2) - 6;
  }
  std::uint64_t bytes = job.packed[request.packed].size() + request.mostIndices * 4;
  for (const auto& [name, id] : extension.at("attributes").members()) {
    const Place place = primitive.at("attributes").at(name.c_str());
    const Accessor* accessor = accessorOf(place);
    if (packed.attributes.empty()) request.vertices = accessor->count;
    if (accessor->count != request.vertices) {
      place.refuse(fmt::format("an accessor with count {}", accessor->count),
                   fmt::format("{}, as in the other packed attributes", request.vertices));
    }
    packed.attributes.emplace_back(name, accessor);
    request.attributes.push_back({static_cast<std::uint32_t>(id.integer(0, kNone)), accessor->type,
                                  static_cast<std::uint32_t>(accessor->components)});
    bytes += accessor->count * bytesOf(request.attributes.back());
  }
  if (packed.attributes.empty())
    extension.at("attributes").refuse("no attribute", "POSITION at least");
  context_.document.spend(bytes, extension);
  primitives.push_back(std::move(packed));
  job.requests.push_back(std::move(request));
}

// Whether its accessors have data of their own, for readers that know nothing of Draco.
bool hasPlainData(const PackedPrimitive& packed) {
  return !packed.indices->bytes.empty() &&
         std::all_of(packed.attributes.begin(), packed.attributes.end(),
                     [](const auto& attribute) { return !attribute.second->bytes.empty(); });
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
  result.indices.count = static_cast<std::uint32_t>(mesh.indices.size());
  const auto bytes = std::as_bytes(std::span(mesh.indices));
  result.indices = unpacked(context, result.indices, Bytes(bytes.begin(), bytes.end()));
  for (std::size_t i = 0; i < packed.attributes.size(); ++i) {
    const auto& [name, accessor] = packed.attributes[i];
    result.attributes.emplace(name, unpacked(context, *accessor, std::move(mesh.attributes[i])));
  }
  return result;
}

Result<std::vector<DracoMesh>> decode(const Document& document, const DracoJob& job) {
  if (document.outsideFiles == OutsideFiles::Refuse)
    return error(ErrorKind::Input, "its Draco data wants a decoder; none may be started here");
  return decodeDraco(job);
}

}  // namespace

void unpackPrimitives(Context& context) {
  Packer packer(context);
  for (const Place& mesh : context.document.root().elements("meshes")) {
    for (const Place& primitive : mesh.at("primitives").elements()) {
      const auto extension = primitive.extension(kExtension);
      if (extension && context.unpacked.try_emplace(primitiveKey(primitive)).second)
        packer.add(primitive, *extension);
    }
  }
  if (packer.primitives.empty()) return;
  Document& document = context.document;
  // Where the extension is not required, the accessors are good for those who cannot unpack.
  const bool required = document.required.contains(kExtension);
  const auto plain = [&](const PackedPrimitive& packed) {
    return !required && hasPlainData(packed);
  };
  auto meshes = decode(document, packer.job);
  if (!meshes) {
    const Error& error = meshes.error();
    if (error.kind == ErrorKind::Cancelled || !std::ranges::all_of(packer.primitives, plain))
      throw Fault{"/meshes: " + error.message, error.kind};
    document.warn("/meshes: " + error.message + kPlain);
    context.unpacked.clear();
    return;
  }
  for (std::size_t i = 0; i < packer.primitives.size(); ++i) {
    const PackedPrimitive& packed = packer.primitives[i];
    DracoMesh& mesh = (*meshes)[i];
    if (mesh.fault.empty()) {
      context.unpacked[packed.key] = unpack(context, packed, std::move(mesh));
      continue;
    }
    if (!plain(packed)) {
      fail(packed.extension.pointer(), "Draco data with a fault: " + mesh.fault,
           "a mesh as the accessors state it",
           std::string("export the file again, perhaps without ") + kExtension);
    }
    document.warn(packed.extension, "has a fault (" + mesh.fault + ")" + kPlain);
    context.unpacked.erase(packed.key);
  }
}

}  // namespace lucerna::scene::gltf
