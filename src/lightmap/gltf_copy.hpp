// A copy of a scene for programs that know glTF and MOZ_lightmap: docs/user/gltf-copy.md.
#pragma once

#include <filesystem>
#include <span>

#include "lightmap/layout.hpp"
#include "lightmap/manifest.hpp"
#include "scene/gltf/gltf_writer.hpp"

namespace lucerna::lightmap {

struct GltfCopy {
  std::vector<FileEntry> files;    // scene.gltf, scene.bin and tex-NNN.png
  std::vector<std::string> notes;  // as scene::GltfReport
};

// Writes scene.gltf with each object where the layout has it. maps: one for each of the layout's.
// baked: indices in Scene::lights (others, as of a sky's lights, mean none); such a light is in the
// maps and would else be seen twice, so its node stays without it. The layout must fit the scene.
Result<GltfCopy> writeGltfCopy(scene::Scene scene, const Layout& layout,
                               std::vector<scene::GltfLightmap> maps,
                               std::span<const std::uint32_t> baked,
                               const std::filesystem::path& folder);

}  // namespace lucerna::lightmap
