// DIR/manifest.json: what a bake consists of. Documented in docs/user/lightmaps.md, with a schema
// in docs/user/lightmap.schema.json.
#pragma once

#include <string>
#include <vector>

#include "core/math/math.hpp"
#include "core/result.hpp"

namespace lucerna::lightmap {

struct FileEntry {
  std::string file;  // beside the manifest
  std::string hash;  // of its bytes: sixteen hexadecimal digits of core/hash.hpp
};

struct MapEntry {
  FileEntry master;                // EXR, Half, RGB: irradiance
  std::vector<FileEntry> encoded;  // KTX2 and PNG, as asked for
  vec3 largest{0.f};               // irradiance
  std::uint64_t texels = 0;        // that charts cover, without those inside of solids
};

struct PatchEntry {
  std::string group;
  FileEntry patch;
  std::string form;                         // "tiles" or "triangles"
  std::uint64_t bytes = 0, otherBytes = 0;  // of this; of the other form, see bake/make_patch
};

struct ObjectEntry {
  std::string node;
  std::uint32_t object = 0;  // index in Scene::objects
  std::uint32_t charts = 0;
  std::vector<int> maps;
  std::string hash{};  // of where it stands at 0 s (lightmap/scene_hash.hpp); "": not known
};

struct LightEntry {
  std::string name, group;
  std::uint32_t light = 0;  // index in Scene::lights
  std::string hash{};       // of its light (lightmap/scene_hash.hpp); "": not known
};

struct Manifest {
  std::string scene;         // its name
  std::string sceneHash;     // of everything in it that the light depends on, and the settings
  std::string geometryHash;  // of its objects' shapes (lightmap/scene_hash.hpp); "": not known
  std::string settings;      // of the bake, as one JSON object's text
  std::string processor;     // instruction set that the rays were followed with
  int side = 0;              // texels of a map
  float density = 0.f;       // texels a metre
  FileEntry layout;
  std::vector<MapEntry> maps;
  std::vector<PatchEntry> patches;
  std::vector<ObjectEntry> objects;
  std::vector<LightEntry> lights;
  std::vector<FileEntry> gltf;  // the copy of the scene, and pictures that only it names
};

// All files that it names.
std::vector<FileEntry> filesOf(const Manifest& manifest);

std::string toJson(const Manifest& manifest);
// Errors (ErrorKind::Input): is no lightmap's, or of another version, or its hash is wrong; else
// every fault, one a line. Names of files stay within the folder.
Result<Manifest> manifestFrom(std::string_view text, const std::string& name);

std::string hashText16(std::uint64_t hash);

}  // namespace lucerna::lightmap
