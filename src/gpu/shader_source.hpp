// Shader text by path (relative to src/), with includes. Shaders are compiled into the libraries;
// a folder given by setRoot() (--shaders DIR, LUCERNA_SHADERS) is read first, which gives hot reload.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace lucerna::gpu {

struct EmbeddedShader {
  std::string_view path;  // "passes/gbuffer/gbuffer.frag"
  std::string_view text;
};

// A source after include expansion, with the way back from its lines to files.
struct ExpandedShader {
  std::string text;
  std::vector<std::string> files;  // index: the source-string number of #line directives
};

class ShaderSources {
 public:
  void add(std::span<const EmbeddedShader> shaders);
  void setRoot(std::filesystem::path root);

  // Expands `#include "path"` (paths relative to src/, each file once) and puts `#version 450 core`
  // and the defines on top. Errors (ErrorKind::Pipeline) name file and line.
  Result<ExpandedShader> expand(const std::string& path,
                                const std::map<std::string, std::string>& defines) const;
  // Files under the root that changed since the last call.
  std::vector<std::string> changedFiles();

 private:
  std::map<std::string, std::string_view, std::less<>> embedded_;
  std::filesystem::path root_;
  std::map<std::string, std::filesystem::file_time_type> times_;
};

// Turns a driver's log ("1:12(3): error", "1(12) : error") into "file:line: error" lines.
std::string mapShaderLog(const std::string& log, const ExpandedShader& shader);

}  // namespace lucerna::gpu
