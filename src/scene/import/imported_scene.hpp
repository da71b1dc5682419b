// What the import worker sends back: a scene whose textures are still names of files.
#pragma once

#include <string>
#include <vector>

#include "core/file.hpp"
#include "scene/scene.hpp"

namespace lucerna::scene {

// One entry of what becomes Scene::textures; materials' slots index these.
struct ImportedTexture {
  std::string path;       // as the file gives it; may use backslashes and be relative to the file
  Bytes bytes;            // an embedded image file; path is then only a name
  std::string alphaPath;  // a second picture whose brightness becomes alpha; empty: none
  Wrap wrapS = Wrap::Repeat, wrapT = Wrap::Repeat;
  bool bump = false;  // from a bump slot, where files put normal maps and height maps alike
};

struct ImportedScene {
  Scene scene;  // without textures
  std::vector<ImportedTexture> textures;
};

}  // namespace lucerna::scene
