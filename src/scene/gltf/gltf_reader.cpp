#include "scene/gltf/gltf_reader.hpp"

#include "scene/gltf/convert.hpp"

namespace lucerna::scene {

Result<Scene> readGltf(const std::filesystem::path& path) {
  LUCERNA_TRY(content, readFile(path));
  return readGltf(path, std::move(content), OutsideFiles::Read);
}

Result<Scene> readGltf(const std::filesystem::path& path, Bytes content,
                       OutsideFiles outsideFiles) {
  gltf::Document document;
  document.outsideFiles = outsideFiles;
  Scene scene;
  scene.name = path.stem().string();
  try {
    gltf::openDocument(document, path, std::move(content));
    gltf::readBuffers(document);
    gltf::Context context{document, gltf::readAccessors(document), scene, {}, {}, {}, {}};
    gltf::readMaterials(context);
    gltf::unpackPrimitives(context);
    gltf::readMeshes(context);
    gltf::readNodes(context);
    gltf::readSkins(context);
    // Every node bends a copy of its own.
    document.spend(bytesOfBent(scene, scene.meshes), document.root());
    gltf::readAnimations(context);
  } catch (const gltf::Fault& fault) {
    return error(fault.kind, "{}: {}", path.string(), fault.message);
  }
  if (scene.objects.empty()) document.warn("the file has nothing to draw");
  scene.warnings.insert(scene.warnings.begin(), document.warnings.begin(), document.warnings.end());
  return scene;
}

}  // namespace lucerna::scene
