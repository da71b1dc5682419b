// Shader text by path, with includes. Most paths are relative to src/: those shaders are compiled
// into the libraries; a folder given by setRoot() (--shaders DIR, LUCERNA_SHADERS) is read first.
// A path that begins with "/", "./" or "../" is a file of the user's. What was read from files is
// watched, which gives hot reload.
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

// A source after include expansion, with the way back from its lines to files. No #line directives:
// Mesa reports file 0 for most errors whatever they say.
struct ExpandedShader {
  struct Place {
    int file = -1;  // index into files; -1: #version or a define
    int line = 0;   // from 1
  };
  std::string text;
  std::vector<std::string> files;
  std::vector<Place> lines;  // of each line of text
};

class ShaderSources {
 public:
  void add(std::span<const EmbeddedShader> shaders);
  void setRoot(std::filesystem::path root);

  // Expands `#include "path"` (each file once) and puts `#version 450 core` and the defines on top.
  // Paths are relative to src/; in a user's file, first to its own folder. Includes are taken
  // before the preprocessor runs, so they stand outside #if. Errors (ErrorKind::Pipeline) name file
  // and line.
  Result<ExpandedShader> expand(const std::string& path,
                                const std::map<std::string, std::string>& defines);
  bool contains(std::string_view path) const;  // compiled in

  // Shader files under the root and users' files read so far that changed since the last call (at
  // first: since setRoot or their first reading), as expand() names them, sorted.
  std::vector<std::string> changedFiles();

 private:
  using Times = std::map<std::string, std::filesystem::file_time_type>;
  Result<std::string> read(const std::string& path, const std::string& includedFrom);
  Status append(const std::string& path, const std::string& includedFrom, ExpandedShader& result);
  std::string included(const std::string& path, const std::string& from) const;
  Times listRoot() const;

  std::map<std::string, std::string_view, std::less<>> embedded_;
  std::filesystem::path root_;
  Times times_;      // of the root's files
  Times userTimes_;  // of users' files
};

// A path of a user's file rather than one relative to src/.
bool isUserShader(std::string_view path);

// Turns a driver's log into "file:line: error: ..." lines. Reads the forms of Mesa
// ("0:12(3): error: ..."), NVIDIA ("0(12) : error C0000: ...") and AMD ("ERROR: 0:12: ...");
// other lines stay as they are.
std::string mapShaderLog(const std::string& log, const ExpandedShader& shader);

}  // namespace lucerna::gpu
