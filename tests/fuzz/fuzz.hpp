// Fuzz targets: functions of bytes that nobody trusts. Each must come back from any bytes with a
// value that keeps its promises or with an error that helps; a CHECK says so when it does not.
// libFuzzer runs one of them (libfuzzer.cpp), the ordinary tests replay their corpus
// (replay_test.cpp). docs/dev/fuzzing.md says how.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "scene/scene.hpp"

namespace lucerna::fuzz {

using ByteView = std::span<const std::byte>;

// The targets, one a file. None reads a file or starts a process.
void gltf(ByteView bytes);          // the glTF reader: a .gltf or .glb without other files
void pipeline(ByteView bytes);      // pipeline JSON: read, validated, scheduled, printed
void sceneJson(ByteView bytes);     // scene JSON over and including a small scene
void image(ByteView bytes);         // headers and pixels of PNG, JPEG, TGA, BMP and HDR
void exr(ByteView bytes);           // header, main picture and layers of OpenEXR
void scriptAnswer(ByteView bytes);  // what a script's process writes
void importAnswer(ByteView bytes);  // what the import worker writes
void dracoAnswer(ByteView bytes);   // what the worker that unpacks Draco's meshes writes

// What the targets share.
std::string_view textOf(ByteView bytes);
// A refusal is of the given kind, names the thing, says something and ends without a newline.
void checkRefusal(const Error& error, ErrorKind kind, std::string_view name);
// Does with a scene what every program does with one, and CHECKs that it stays sound.
void useScene(scene::Scene scene);

}  // namespace lucerna::fuzz
