// A scene as a glTF 2.0 file, for other programs: NAME.gltf, NAME.bin and pictures tex-NNN.png.
//
// What glTF can say of it as it stands: bent meshes as they are bent now; no animation, skins or
// morph targets. What it cannot say is approximated or left out: docs/user/gltf-copy.md. The same
// scene gives the same bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// The picture that Mesh::lightmap means by its index, for MOZ_lightmap.
struct GltfLightmap {
  std::string file;       // beside the glTF, which only names it: .png, .jpg, .hdr or .exr
  float intensity = 1.f;  // irradiance is this times what the file holds, linear
};

struct GltfSettings {
  std::string name = "scene";
  std::vector<GltfLightmap> lightmaps;  // as many as the maps; empty: Mesh::lightmap is left out
};

struct GltfReport {
  struct File {
    std::string name;
    std::uint64_t hash = 0;  // hashBytes() of what it holds
  };
  std::vector<File> files;         // lightmaps are none of them
  std::vector<std::string> notes;  // what was approximated or left out, one sentence each
};

// complete() has been called: objects have a material. Each file is whole or not there; NAME.gltf
// comes last. Errors: a file that cannot be written (ErrorKind::Failed), a lightmap of another kind
// (ErrorKind::Usage).
Result<GltfReport> writeGltf(const Scene& scene, const std::filesystem::path& folder,
                             const GltfSettings& settings = {});

}  // namespace lucerna::scene
