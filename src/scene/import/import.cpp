#include "scene/import/import.hpp"

#include "core/text.hpp"
#include "core/worker_program.hpp"
#include "scene/import/import_textures.hpp"
#include "scene/import/scene_stream.hpp"

namespace lucerna::scene {

ChildLimits importLimits(std::uint64_t fileBytes) {
  // Of a million triangles, assimp reads 25 bytes a microsecond of any format, and takes at most 17
  // bytes for one of FBX, of which 3 come back from the compressed kind.
  constexpr std::uint64_t kBytesPerMillisecond = 2000;
  constexpr std::uint64_t kResidentPerByte = 32, kOutputPerByte = 8;
  ChildLimits limits;
  limits.time = std::chrono::milliseconds(5'000 + fileBytes / kBytesPerMillisecond);
  limits.residentBytes = (384ull << 20) + kResidentPerByte * fileBytes;
  limits.outputBytes = (128ull << 20) + kOutputPerByte * fileBytes;
  return limits;
}

Result<Scene> importScene(const std::filesystem::path& path) {
  std::error_code code;
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code)
    return error(ErrorKind::Input, "{}: {}; wanted a readable file", path.string(), code.message());
  WorkerAnswer answer =
      runWorker({.arguments = {"import", path.string()},
                 .limits = importLimits(size),
                 .name = path.string() + ": the reader of this file",
                 .kind = ErrorKind::Input,
                 .remedy = "wanted a valid file of that kind; check it, or export it again, for "
                           "example as glTF"});
  LUCERNA_TRY_VOID(answer.status);
  Result<ImportedScene> imported = readStream(answer.out);
  if (!imported)
    return error(ErrorKind::Input,
                 "{}: the reader of this file gave a scene that {}; wanted a valid file; check it, "
                 "or export it again, for example as glTF",
                 path.string(), imported.error().message);
  answer.out = {};
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (equalIgnoringCase(path.extension().string(), ".obj")) addEmissionMaps(*imported, folder);
  loadTextures(*imported, folder);
  Scene scene = std::move(imported->scene);
  if (scene.objects.empty())
    return error(ErrorKind::Input,
                 "{}: holds no triangles; wanted a scene to draw; check whether it was cut off",
                 path.string());
  return scene;
}

}  // namespace lucerna::scene
