#include "scene/gltf/document.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace lucerna::scene::gltf {

namespace {

constexpr int kMaxDepth = 64;                   // of nested arrays and objects
constexpr std::size_t kMaxTokens = 10'000'000;  // brackets, commas and colons of the JSON
constexpr std::size_t kMostWarnings = 100;
constexpr std::uint64_t kMaxText = 512ull << 20;    // bytes of JSON
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"

constexpr std::array kReadExtensions = {
    "KHR_lights_punctual",     "KHR_texture_transform",   "KHR_materials_emissive_strength",
    "KHR_materials_unlit",     "KHR_mesh_quantization",   "KHR_materials_pbrSpecularGlossiness",
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
};

// What to do about extensions that are not read, where there is something better to say.
struct Advice {
  const char* extension;
  const char* next;
};
constexpr const char* kOtherPictures = "export the file again with PNG or JPEG textures";
constexpr std::array kAdvice = {
    Advice{"KHR_texture_basisu",
           "its textures are KTX2 files, which are not decoded: export the file again with PNG or "
           "JPEG textures"},
    Advice{"KHR_meshopt_compression",
           "export the file again with EXT_meshopt_compression, which is read, or without"},
    Advice{"EXT_texture_webp", kOtherPictures},
    Advice{"EXT_texture_avif", kOtherPictures},
    Advice{"MSFT_texture_dds", kOtherPictures},
};

std::string adviceAbout(const std::string& extension) {
  const auto known = std::find_if(kAdvice.begin(), kAdvice.end(), [&](const Advice& advice) {
    return extension == advice.extension;
  });
  return known != kAdvice.end() ? known->next : "export the file again without " + extension;
}

std::uint32_t read32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;  // little-endian, as all machines that we build for
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::string at(std::size_t byte) {
  return fmt::format("byte {}", byte);
}

// Splits a GLB into its JSON and its BIN chunk (glTF 2.0, section 4).
std::string_view splitBinary(Document& document) {
  const std::span<const std::byte> file = document.file;
  const std::string again = "export the file again";
  if (file.size() >= 4 && read32(file, 0) != 0x46546C67) {
    fail(at(0), fmt::format("{:#010x}", read32(file, 0)), "the GLB magic \"glTF\" (0x46546c67)",
         "rename a JSON file to .gltf, or " + again);
  }
  if (file.size() < 20) {
    fail(at(0), fmt::format("a file of {} bytes", file.size()),
         "a GLB header and chunk of at least 20", "check that the file was copied completely");
  }
  if (read32(file, 4) != 2) {
    fail(at(4), fmt::format("version {}", read32(file, 4)), "version 2", again + " as glTF 2.0");
  }
  const std::size_t length = read32(file, 8);
  if (length > file.size()) {
    fail(at(8), fmt::format("a length of {}", length),
         fmt::format("at most the {} bytes that the file has", file.size()),
         "check that the file was copied completely");
  }
  if (length < file.size()) document.warn("bytes after the end of the GLB are ignored");

  std::string_view text;
  std::size_t position = 12;
  for (int chunk = 0; position < length; ++chunk) {
    if (length - position < 8) {
      fail(at(position), fmt::format("{} bytes", length - position), "a chunk header of 8", again);
    }
    const std::size_t size = read32(file, position);
    const std::uint32_t type = read32(file, position + 4);
    const std::string place = fmt::format("chunk {} at byte {}", chunk, position);
    position += 8;
    if (size > length - position) {
      fail(place, fmt::format("a chunk length of {}", size),
           fmt::format("at most the {} bytes that are left", length - position),
           "check that the file was copied completely");
    }
    const auto content = file.subspan(position, size);
    position += size;
    if (size % 4 != 0) document.warn(place + " has a length that is no multiple of 4");
    if (chunk == 0) {
      if (type != kJsonChunk)
        fail(place, fmt::format("type {:#010x}", type), "a JSON chunk first", again);
      text = {reinterpret_cast<const char*>(content.data()), content.size()};
    } else if (type == kJsonChunk) {
      fail(place, "a second JSON chunk", "one only", again);
    } else if (type == kBinaryChunk) {
      if (document.hasBinary) fail(place, "a second BIN chunk", "one at most", again);
      if (chunk != 1) fail(place, "the BIN chunk", "it straight after the JSON chunk", again);
      document.binary = content;
      document.hasBinary = true;
    } else {
      document.warn(place + fmt::format(" has the unknown type {:#010x} and is ignored", type));
    }
  }
  return text;
}

// JSON nests far less than this in practice, and a parser may not bear more. Each value takes up to
// about a hundred bytes once parsed, however short its text.
void checkSize(std::string_view text) {
  int depth = 0;
  std::size_t tokens = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxDepth) {
        fail(at(i), fmt::format("more than {} nested arrays and objects", kMaxDepth),
             fmt::format("at most {}", kMaxDepth), "export the file again without its extras");
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
    tokens += !inString && (c == '{' || c == '[' || c == ',' || c == ':');
  }
  if (tokens > kMaxTokens) {
    fail("JSON", fmt::format("{} values", tokens), fmt::format("at most {}", kMaxTokens),
         "split the scene into several files");
  }
}

void parse(Document& document, std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) {
    text.remove_prefix(3);
    document.warn("the byte-order mark before the JSON is ignored");
  }
  if (text.empty()) fail("/", "no JSON at all", "a JSON object", "export the file again");
  checkSize(text);
  try {
    document.json = Json::parse(text);
  } catch (const Json::exception& exception) {
    std::string what =
        exception.what();  // "[json.exception.parse_error.101] parse error at line..."
    if (const auto end = what.find("] "); end != std::string::npos) what = what.substr(end + 2);
    fail("JSON", what, "well-formed JSON in UTF-8", "export the file again");
  }
}

void checkExtensions(Document& document) {
  const auto read = [](const std::string& name) {
    return std::find(kReadExtensions.begin(), kReadExtensions.end(), name) != kReadExtensions.end();
  };
  for (const Place& place : document.root().elements("extensionsRequired")) {
    const std::string& name = place.text();
    document.required.insert(name);
    if (!read(name)) {
      fail(place.pointer(), "\"" + name + "\"", "an extension that Lucerna reads",
           adviceAbout(name));
    }
  }
  for (const Place& place : document.root().elements("extensionsUsed")) {
    const std::string& name = place.text();
    if (!read(name)) document.warn("the extension " + name + " is not read: drawn without it");
  }
}

}  // namespace

void Document::warn(const Place* place, std::string what) {
  if (said_.size() > kMostWarnings) return;
  if (!said_.emplace(place ? place->id() : nullptr, what).second) return;
  if (said_.size() > kMostWarnings)
    warnings.push_back(
        fmt::format("more than {} warnings: the others are left out", kMostWarnings));
  else
    warnings.push_back(place ? place->pointer() + " " + what : std::move(what));
}

void Document::spend(std::uint64_t bytes, const Place& place) {
  spent_ += bytes;
  const std::uint64_t most = std::max<std::uint64_t>(256ull << 20, 32 * bufferBytes);
  if (spent_ > most) {
    place.refuse(fmt::format("data that expands to {} bytes or more", spent_),
                 fmt::format("at most {}, as much as the file's size makes plausible", most));
  }
}

void openDocument(Document& document, const std::filesystem::path& path, Bytes file) {
  document.path = path;
  document.file = std::move(file);
  const bool magic = document.file.size() >= 4 && read32(document.file, 0) == 0x46546C67;
  const bool binary = magic || path.extension() == ".glb" || path.extension() == ".GLB";
  const std::string_view text =
      binary ? splitBinary(document)
             : std::string_view(reinterpret_cast<const char*>(document.file.data()),
                                document.file.size());
  if (text.size() > kMaxText) {
    fail("JSON", fmt::format("{} bytes", text.size()), fmt::format("at most {}", kMaxText),
         "keep buffers and images in files of their own");
  }
  parse(document, text);
  if (!binary) document.file = {};

  const Place version = document.root().at("asset").at("version");
  if (!version.text().starts_with("2.")) {
    version.refuse("\"2.0\"");
  }
  checkExtensions(document);
}

}  // namespace lucerna::scene::gltf
