#include <algorithm>
#include <array>
#include <charconv>
#include <regex>

#include "core/text.hpp"
#include "gpu/shader_source.hpp"

namespace lucerna::gpu {
namespace {

// How a driver writes a place. Capture groups: line of the expanded text, rest.
struct LogForm {
  std::regex pattern;
  const char* severity;  // put before the rest where the form has it in front of the place
};

const std::array<LogForm, 4>& logForms() {
  static const std::array<LogForm, 4> forms = {
      LogForm{std::regex(R"(^\d+:(\d+)\(\d+\)\s*:\s*(.*)$)"), ""},           // Mesa
      LogForm{std::regex(R"(^\d+\((\d+)\)\s*:\s*(.*)$)"), ""},               // NVIDIA
      LogForm{std::regex(R"(^ERROR:\s*\d+:(\d+):\s*(.*)$)"), "error: "},     // AMD
      LogForm{std::regex(R"(^WARNING:\s*\d+:(\d+):\s*(.*)$)"), "warning: "}  // AMD
  };
  return forms;
}

std::string mapLine(const std::string& line, const ExpandedShader& shader) {
  for (const LogForm& form : logForms()) {
    std::smatch match;
    if (!std::regex_match(line, match, form.pattern)) continue;
    const std::string digits = match[1].str();
    std::size_t number = 0;
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (parsed.ec != std::errc() || number < 1 || number > shader.lines.size()) return line;
    const ExpandedShader::Place place = shader.lines[number - 1];
    if (place.file < 0) return fmt::format("(defines): {}{}", form.severity, match[2].str());
    return fmt::format("{}:{}: {}{}", shader.files[static_cast<std::size_t>(place.file)],
                       place.line, form.severity, match[2].str());
  }
  return line;
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
