// Buffers and buffer views: declared sizes are checked against each other, then against the files,
// and only then is memory taken.
#include <algorithm>
#include <array>
#include <fstream>
#include <map>

#include "scene/gltf/document.hpp"

namespace lucerna::scene::gltf {

namespace {

constexpr std::uint64_t kMaxBytes = 1ull << 32;  // of one buffer

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percentDecoded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 &&
        hexDigit(text[i + 2]) >= 0) {
      result += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

constexpr std::array<std::int8_t, 256> base64Values() {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    values[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}

Bytes base64Decoded(std::string_view text, const Place& place) {
  static constexpr auto kValues = base64Values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) place.refuse(fmt::format("the character '{}' in base64", c), "A-Z a-z 0-9 + /");
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<std::byte>((bits >> count) & 0xFF));
    }
  }
  return bytes;
}

// What to do about a file that is not there: names count from the folder of the scene as it was
// given, as most tools have it.
std::string howToPlace(const std::filesystem::path& scene) {
  std::error_code code;
  if (!std::filesystem::is_symlink(scene, code)) return "put the file beside the scene";
  return fmt::format("put the file beside the symbolic link {}, or name what that leads to: {}",
                     scene.string(), std::filesystem::canonical(scene, code).string());
}

// A file that has at least `length` bytes: all of it, as far as a buffer can reach, because other
// buffers may name it too.
Bytes readBufferFile(const Document& document, std::uint64_t length, const Place& buffer) {
  const std::filesystem::path path = resolveUri(document, buffer.at("uri"));
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) {
    fail(buffer.at("uri").pointer(), fmt::format("no file {}", path.string()),
         fmt::format("a file of at least {} bytes", length), howToPlace(document.path));
  }
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code || size < length) {
    buffer.at("byteLength")
        .refuse(fmt::format("{}, but {} has {} bytes", length, path.string(), code ? 0 : size),
                "at most the size of the file");
  }
  Bytes bytes(std::min<std::uint64_t>(size, kMaxBytes));
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream) {
    fail(buffer.at("uri").pointer(), fmt::format("{}, which cannot be read", path.string()),
         "a readable file", "check its permissions");
  }
  return bytes;
}

// What was read already, by file: many buffers that name one file share its bytes.
using KnownFiles = std::map<std::filesystem::path, std::span<const std::byte>>;

std::span<const std::byte> readBuffer(Document& document, const Place& buffer, std::size_t index,
                                      KnownFiles& known) {
  const std::uint64_t length = buffer.at("byteLength").integer(1, kMaxBytes);
  const auto uri = buffer.find("uri");
  if (!uri) {
    // In a GLB the BIN chunk; otherwise extensions may fill it, and no data is here.
    if (index != 0 || !document.hasBinary) return {};
    if (length > document.binary.size()) {
      buffer.at("byteLength")
          .refuse(fmt::format("{}, but the BIN chunk has {} bytes", length, document.binary.size()),
                  "at most the size of the chunk");
    }
    return document.binary.subspan(0, length);
  }
  const std::string& text = uri->text();
  auto inlined = decodeDataUri(text, *uri);
  if (!inlined) {
    auto& bytes = known[resolveUri(document, *uri).lexically_normal()];
    if (bytes.size() < length) {
      document.resources.push_back(readBufferFile(document, length, buffer));
      bytes = document.resources.back();
    }
    return bytes.subspan(0, length);
  }
  document.resources.push_back(std::move(*inlined));
  const Bytes& bytes = document.resources.back();
  if (bytes.size() < length) {
    buffer.at("byteLength")
        .refuse(fmt::format("{}, but its data has {} bytes", length, bytes.size()),
                "at most the size of the data");
  }
  return {bytes.data(), length};
}

}  // namespace

std::optional<Bytes> decodeDataUri(const std::string& uri, const Place& place) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const auto comma = uri.find(',');
  if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
    place.refuse("a data URI of another kind", "\"data:...;base64,...\"");
  }
  return base64Decoded(std::string_view(uri).substr(comma + 1), place);
}

std::filesystem::path resolveUri(const Document& document, const Place& uri) {
  const std::string& text = uri.text();
  if (text.empty()) uri.refuse("a relative file name");
  if (document.outsideFiles == OutsideFiles::Refuse) {
    fail(uri.pointer(), "\"" + text + "\"", "data inside this file",
         "no other file may be read here");
  }
  if (text.find("://") != std::string::npos) {
    fail(uri.pointer(), "\"" + text + "\"", "a relative file name",
         "save what it points to beside the scene and name that file");
  }
  std::string decoded = percentDecoded(text);
  if (decoded.find('\0') != std::string::npos) uri.refuse("a relative file name");
  return document.folder() / decoded;
}

void readBuffers(Document& document) {
  const auto buffers = document.root().elements("buffers");
  const auto views = document.root().elements("bufferViews");
  struct Range {
    std::uint32_t buffer;
    std::uint64_t offset, length;
  };
  std::vector<Range> ranges;
  for (const Place& view : views) {
    const std::uint32_t buffer = view.at("buffer").index(buffers.size(), "buffers");
    const std::uint64_t size = buffers[buffer].at("byteLength").integer(1, kMaxBytes);
    const std::uint64_t offset = view.integer("byteOffset", 0, 0, size);
    const std::uint64_t length = view.at("byteLength").integer(1, kMaxBytes);
    if (length > size - offset) {
      view.at("byteLength")
          .refuse(fmt::format("{} at byte {}", length, offset),
                  fmt::format("a view inside the {} bytes of /buffers/{}", size, buffer));
    }
    ranges.push_back({buffer, offset, length});
    document.views.push_back(
        {{}, length, static_cast<std::uint32_t>(view.integer("byteStride", 0, 1, 252))});
  }
  std::vector<std::span<const std::byte>> data;
  KnownFiles known;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    data.push_back(readBuffer(document, buffers[i], i, known));
  }
  document.bufferBytes = document.binary.size();
  for (const Bytes& bytes : document.resources) document.bufferBytes += bytes.size();
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto& bytes = data[ranges[i].buffer];
    BufferView& view = document.views[i];
    if (const auto packed = views[i].extension("EXT_meshopt_compression"))
      unpackMeshopt(document, *packed, data, view);
    else if (!bytes.empty())
      view.bytes = bytes.subspan(ranges[i].offset, ranges[i].length);
  }
}

}  // namespace lucerna::scene::gltf
