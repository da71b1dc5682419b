#include "gpu/shader_source.hpp"

#include <algorithm>
#include <optional>

#include "core/file.hpp"
#include "core/text.hpp"

namespace lucerna::gpu {
namespace {

namespace fs = std::filesystem;

// The text after `#word` if the line is that directive.
std::optional<std::string_view> directive(std::string_view line, std::string_view word) {
  const auto skipBlanks = [&line] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  };
  skipBlanks();
  if (!line.starts_with('#')) return std::nullopt;
  line.remove_prefix(1);
  skipBlanks();
  if (!line.starts_with(word)) return std::nullopt;
  line.remove_prefix(word.size());
  skipBlanks();
  return line;
}

constexpr std::uint64_t kMaxUserShaderBytes = 4 << 20;

// A file that does not exist has the earliest time, so that it counts as changed when it appears.
fs::file_time_type timeOf(const fs::path& path) {
  std::error_code missing;
  const auto time = fs::last_write_time(path, missing);
  return missing ? fs::file_time_type::min() : time;
}

bool isShaderFile(const fs::path& path) {
  const fs::path extension = path.extension();
  return extension == ".vert" || extension == ".frag" || extension == ".comp" ||
         extension == ".glsl";
}

}  // namespace

void ShaderSources::add(std::span<const EmbeddedShader> shaders) {
  for (const EmbeddedShader& shader : shaders)
    embedded_.insert_or_assign(std::string(shader.path), shader.text);
}

void ShaderSources::setRoot(fs::path root) {
  root_ = std::move(root);
  times_ = listRoot();
}

bool ShaderSources::contains(std::string_view path) const {
  return embedded_.contains(path);
}

bool isUserShader(std::string_view path) {
  return path.starts_with("/") || path.starts_with("./") || path.starts_with("../");
}

Result<std::string> ShaderSources::read(const std::string& path, const std::string& includedFrom) {
  const std::string place = includedFrom.empty() ? "" : includedFrom + ": error: ";
  if (isUserShader(path)) {
    userTimes_.emplace(path, timeOf(path));
    auto text = readText(path, kMaxUserShaderBytes);
    if (!text) return error(ErrorKind::Pipeline, "{}{}", place, text.error().message);
    return text;
  }
  if (!root_.empty()) {
    std::error_code ignored;
    if (fs::is_regular_file(root_ / path, ignored)) return readText(root_ / path);
  }
  if (const auto found = embedded_.find(path); found != embedded_.end())
    return std::string(found->second);
  std::vector<std::string> known;
  for (const auto& [name, text] : embedded_) known.push_back(name);
  const std::string searched =
      root_.empty() ? "the built-in shaders" : root_.string() + " and the built-in shaders";
  return error(ErrorKind::Pipeline, "{}no shader file '{}' in {}{}; paths are relative to src/",
               place, path, searched, didYouMean(path, known));
}

// The file that an #include of `from` means.
std::string ShaderSources::included(const std::string& path, const std::string& from) const {
  if (!isUserShader(from)) return path;
  const fs::path beside = fs::path(from).parent_path() / path;
  std::error_code ignored;
  if (!fs::is_regular_file(beside, ignored)) return path;
  const std::string name = beside.lexically_normal().generic_string();
  return isUserShader(name) ? name : "./" + name;
}

Status ShaderSources::append(const std::string& path, const std::string& includedFrom,
                             ExpandedShader& result) {
  if (std::find(result.files.begin(), result.files.end(), path) != result.files.end()) return {};
  LUCERNA_TRY(text, read(path, includedFrom));
  const int file = static_cast<int>(result.files.size());
  result.files.push_back(path);
  int number = 0;
  for (const std::string& line : split(text, '\n')) {
    const std::string place = fmt::format("{}:{}", path, ++number);
    if (directive(line, "version"))
      return error(ErrorKind::Pipeline,
                   "{}: error: #version stands in a shader file, but it is put in front of every "
                   "shader; remove the line",
                   place);
    const auto argument = directive(line, "include");
    if (!argument) {
      result.text += line + "\n";
      result.lines.push_back({file, number});
      continue;
    }
    const std::size_t close = argument->starts_with('"') ? argument->find('"', 1) : 0;
    if (close == 0 || close == std::string_view::npos)
      return error(ErrorKind::Pipeline,
                   "{}: error: found '{}', expected #include \"path relative to src/\"", place,
                   line);
    LUCERNA_TRY_VOID(
        append(included(std::string(argument->substr(1, close - 1)), path), place, result));
  }
  return {};
}

Result<ExpandedShader> ShaderSources::expand(const std::string& path,
                                             const std::map<std::string, std::string>& defines) {
  ExpandedShader result;
  result.text = "#version 450 core\n";
  result.lines.resize(1 + defines.size());
  for (const auto& [name, value] : defines) {
    CHECK(value.find('\n') == std::string::npos, "define {} has several lines", name);
    result.text += fmt::format("#define {} {}\n", name, value);
  }
  LUCERNA_TRY_VOID(append(path, "", result));
  return result;
}

ShaderSources::Times ShaderSources::listRoot() const {
  Times times;
  std::error_code failure;  // files may vanish while we look: they are then not listed
  if (root_.empty()) return times;
  fs::recursive_directory_iterator entry(root_, fs::directory_options::skip_permission_denied,
                                         failure);
  for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure)) {
    if (!isShaderFile(entry->path())) continue;
    std::error_code vanished;
    const auto time = entry->last_write_time(vanished);
    if (!vanished) times[entry->path().lexically_relative(root_).generic_string()] = time;
  }
  return times;
}

std::vector<std::string> ShaderSources::changedFiles() {
  Times now = listRoot();
  std::vector<std::string> changed;
  for (const auto& [path, time] : now) {
    const auto before = times_.find(path);
    if (before == times_.end() || before->second != time) changed.push_back(path);
  }
  for (const auto& [path, time] : times_)
    if (!now.contains(path)) changed.push_back(path);
  for (auto& [path, time] : userTimes_)
    if (const auto newTime = timeOf(path); newTime != std::exchange(time, newTime))
      changed.push_back(path);
  std::sort(changed.begin(), changed.end());
  times_ = std::move(now);
  return changed;
}

}  // namespace lucerna::gpu
