#include "scene/import/import_worker.hpp"

#include <cstdio>

#include "scene/import/assimp_reader.hpp"
#include "scene/import/scene_stream.hpp"

namespace lucerna::scene {

int importWorker(const std::string& path) {
  const Result<ImportedScene> imported = readWithAssimp(path);
  if (!imported) {
    std::fputs(imported.error().message.c_str(), stderr);
    return static_cast<int>(imported.error().kind);
  }
  const Bytes bytes = writeStream(*imported);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() &&
                       std::fflush(stdout) == 0;
  return written ? 0 : static_cast<int>(ErrorKind::Failed);
}

}  // namespace lucerna::scene
