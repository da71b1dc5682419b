#include <algorithm>

#include "fuzz/fuzz.hpp"
#include "scene/gltf/draco_decode.hpp"

namespace lucerna::fuzz {
namespace {

using scene::gltf::DracoMesh;
using scene::gltf::DracoRequest;
using Type = scene::gltf::ComponentType;

// A triangle with colours, and what was a strip.
std::vector<DracoRequest> requests() {
  return {{.packed = 0,
           .attributes = {{0, Type::F32, 3}, {1, Type::U8, 4}},
           .vertices = 3,
           .leastIndices = 3,
           .mostIndices = 3},
          {.packed = 1,
           .attributes = {{0, Type::S16, 2}},
           .vertices = 4,
           .leastIndices = 3,
           .mostIndices = 9}};
}

void checkMesh(const DracoMesh& mesh, const DracoRequest& request) {
  if (!mesh.fault.empty()) return;
  CHECK(mesh.indices.size() >= request.leastIndices && mesh.indices.size() <= request.mostIndices);
  CHECK(mesh.attributes.size() == request.attributes.size());
  for (std::size_t i = 0; i < mesh.attributes.size(); ++i)
    CHECK(mesh.attributes[i].size() == request.vertices * bytesOf(request.attributes[i]));
}

}  // namespace

void dracoAnswer(ByteView bytes) {
  const std::vector<DracoRequest> asked = requests();
  const auto meshes = scene::gltf::readDracoAnswer(asked, bytes);
  if (!meshes) return checkRefusal(meshes.error(), ErrorKind::Input, "the decoder");
  CHECK(meshes->size() == asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) checkMesh((*meshes)[i], asked[i]);
  CHECK(std::ranges::equal(scene::gltf::writeDracoAnswer(*meshes), bytes));
}

}  // namespace lucerna::fuzz
