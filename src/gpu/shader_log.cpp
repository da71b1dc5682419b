#include <charconv>
#include <optional>

#include "core/text.hpp"
#include "gpu/shader_source.hpp"

namespace lucerna::gpu {
namespace {

// Reads a line of a log from left to right; each step says whether the text was there.
struct Cursor {
  std::string_view rest;

  bool take(std::string_view text) {
    if (!rest.starts_with(text)) return false;
    rest.remove_prefix(text.size());
    return true;
  }
  bool takeNumber(std::size_t& number) {
    const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (parsed.ec != std::errc()) return false;
    rest.remove_prefix(static_cast<std::size_t>(parsed.ptr - rest.data()));
    return true;
  }
  void skipBlanks() {
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  }
};

struct Diagnostic {
  std::size_t line = 0;  // of the expanded text, from 1
  std::string text;      // "error: ..."
};

// "0:12(3): error: ..." (Mesa), "0(12) : error C0000: ..." (NVIDIA), "ERROR: 0:12: ..." (AMD).
std::optional<Diagnostic> parse(std::string_view line) {
  Cursor cursor{line};
  std::string severity;
  if (cursor.take("ERROR:"))
    severity = "error: ";
  else if (cursor.take("WARNING:"))
    severity = "warning: ";
  cursor.skipBlanks();
  Diagnostic result;
  std::size_t ignored = 0;
  if (!cursor.takeNumber(ignored)) return std::nullopt;
  if (cursor.take(":")) {
    if (!cursor.takeNumber(result.line)) return std::nullopt;
    if (cursor.take("(") && !(cursor.takeNumber(ignored) && cursor.take(")"))) return std::nullopt;
  } else if (!(cursor.take("(") && cursor.takeNumber(result.line) && cursor.take(")"))) {
    return std::nullopt;
  }
  cursor.skipBlanks();
  if (!cursor.take(":")) return std::nullopt;
  cursor.skipBlanks();
  result.text = severity + std::string(cursor.rest);
  return result;
}

std::string mapLine(const std::string& line, const ExpandedShader& shader) {
  const std::optional<Diagnostic> found = parse(line);
  if (!found || found->line < 1 || found->line > shader.lines.size()) return line;
  const ExpandedShader::Place place = shader.lines[found->line - 1];
  if (place.file < 0) return "(defines): " + found->text;
  return fmt::format("{}:{}: {}", shader.files[static_cast<std::size_t>(place.file)], place.line,
                     found->text);
}

}  // namespace

std::string mapShaderLog(const std::string& log, const ExpandedShader& shader) {
  std::vector<std::string> lines;
  for (std::string line : split(log, '\n')) {
    while (!line.empty() && (line.back() == '\r' || line.back() == '\0')) line.pop_back();
    if (!line.empty()) lines.push_back(mapLine(line, shader));
  }
  return join(lines, "\n");
}

}  // namespace lucerna::gpu
