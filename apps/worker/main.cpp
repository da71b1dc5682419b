// lucerna_worker: reads what is not trusted, a scene of somebody else's format, meshes packed
// by Draco or a pipeline script, for the process that started it.

#include <cstdio>
#include <string>

#include "core/result.hpp"
#include "scene/gltf/draco_worker.hpp"
#include "scene/import/import_worker.hpp"
#include "script/script.hpp"

int main(int count, char** words) {
  const std::string name = count > 1 ? words[1] : "";
  if (name == "script" && count == 2) return lucerna::script::scriptWorker();
  if (name == "import" && count == 3) return lucerna::scene::importWorker(words[2]);
  if (name == "draco" && count == 2) return lucerna::scene::gltf::dracoWorker();
  std::fprintf(stderr, "lucerna_worker is started by Lucerna itself, as a child process\n");
  return static_cast<int>(lucerna::ErrorKind::Usage);
}
