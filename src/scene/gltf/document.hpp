// A glTF file opened and checked as a container: the JSON, the binary chunk, the buffers.
#pragma once

#include <deque>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "scene/gltf/place.hpp"
#include "scene/outside_files.hpp"

namespace lucerna::scene::gltf {

struct BufferView {
  std::span<const std::byte> bytes;  // empty where the buffer has no data of its own
  std::uint64_t length = 0;          // declared, bytes
  std::uint32_t stride = 0;          // bytes; 0: elements are packed
};

struct Document {
  std::filesystem::path path;
  OutsideFiles outsideFiles = OutsideFiles::Read;
  Bytes file;  // of a .glb
  Json json;
  std::span<const std::byte> binary;  // the BIN chunk, in `file`
  bool hasBinary = false;
  std::deque<Bytes> resources;  // what buffers with a uri hold
  std::vector<BufferView> views;
  std::uint64_t bufferBytes = 0;   // of all buffers; a file that several name counts once
  std::set<std::string> required;  // extensions that the file says it cannot do without
  std::vector<std::string> warnings;

  Place root() const { return {json, json}; }
  std::filesystem::path folder() const { return path.parent_path(); }
  // The same sentence counts once, and after the first hundred none is kept: to find the pointer of
  // a place is a search through the document.
  void warn(std::string sentence) { warn(nullptr, std::move(sentence)); }
  void warn(const Place& place, std::string what) { warn(&place, std::move(what)); }
  // Notes that `bytes` more are made from the buffers. A file whose parts are used so often, or
  // whose zeros are so many, that they grow beyond all proportion is refused.
  void spend(std::uint64_t bytes, const Place& place);

 private:
  void warn(const Place* place, std::string what);

  std::set<std::pair<const void*, std::string>> said_;  // of which place, what
  std::uint64_t spent_ = 0;
};

// Checks the content of the file at `path` and takes it apart: GLB structure, nesting, JSON syntax,
// asset.version and the extensions that the file requires. Throws Fault.
void openDocument(Document& document, const std::filesystem::path& path, Bytes file);

// Checks buffers and bufferViews against each other and against the real sizes, then reads the
// buffers. Throws Fault.
void readBuffers(Document& document);

// Unpacks a view that has EXT_meshopt_compression: `place` is that object, `buffers` what all
// buffers hold. Throws Fault.
void unpackMeshopt(Document& document, const Place& place,
                   std::span<const std::span<const std::byte>> buffers, BufferView& view);

// "data:MEDIATYPE;base64,..." gives its bytes; nothing if the text is no data URI. Throws Fault.
std::optional<Bytes> decodeDataUri(const std::string& uri, const Place& place);
// The file that a relative URI names: percent-decoded, in the folder of the document. Throws Fault,
// also where the document may read no other file.
std::filesystem::path resolveUri(const Document& document, const Place& uri);

}  // namespace lucerna::scene::gltf
