#include "scene/import/ac3d_text.hpp"

#include <array>
#include <charconv>

namespace lucerna::scene {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

// The first `count` words of a line.
std::string_view firstWords(std::string_view line, int count) {
  std::size_t at = 0;
  while (count-- > 0) {
    at = line.find_first_not_of(" \t", at);
    if (at == std::string_view::npos) return line;
    at = line.find_first_of(" \t", at);
    if (at == std::string_view::npos) return line;
  }
  return line.substr(0, at);
}

struct TextureLine {
  std::string_view nameAndKeyword;  // `texture "x"`
  std::string_view layer;           // what follows the name
};

TextureLine splitTexture(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t", std::string_view("texture").size());
  if (start == std::string_view::npos) return {line, {}};
  std::size_t end = line[start] == '"' ? line.find('"', start + 1) : line.find(' ', start);
  if (end == std::string_view::npos) return {line, {}};
  if (line[start] == '"') ++end;
  const std::size_t layer = line.find_first_not_of(" \t", end);
  return {line.substr(0, end),
          layer == std::string_view::npos ? std::string_view() : line.substr(layer)};
}

}  // namespace

std::string plainAc3d(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  long references = 0;  // lines of vertex references still to come
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (references > 0) {
      --references;
      line = firstWords(line, 3);  // vertex, u, v
    } else if (line.starts_with("refs ")) {
      std::from_chars(line.data() + 5, line.data() + line.size(), references);
    } else if (line.starts_with("texture ")) {
      const TextureLine texture = splitTexture(line);
      // What TORCS' own tools write where there is no texture.
      if (line.find("empty_texture_no_mapping") != line.npos || line.find("(null)") != line.npos)
        continue;
      if (texture.layer == "tiled" || texture.layer == "skids" || texture.layer == "shad") continue;
      line = texture.nameAndKeyword;
    }
    result += line;
    result += '\n';
  }
  return result;
}

}  // namespace lucerna::scene
