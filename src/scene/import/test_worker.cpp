// Stands in for lucerna_worker in tests: `test_worker draco`, or `test_worker import PATH`, where a
// file name that says so makes it misbehave as a reader taken over by a hostile file might.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "scene/gltf/draco_worker.hpp"
#include "scene/import/import_worker.hpp"

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "draco") return lucerna::scene::gltf::dracoWorker();
  if (argc != 3 || std::string(argv[1]) != "import") return 2;
  const std::string path = argv[2];
  const auto says = [&](const char* word) { return path.find(word) != std::string::npos; };
  if (says("worker_crashes")) {
    std::signal(SIGSEGV, SIG_DFL);  // the address sanitizer has a handler that ends with code 1
    std::raise(SIGSEGV);
  }
  if (says("worker_hangs")) std::this_thread::sleep_for(std::chrono::hours(1));
  if (says("worker_hungers")) {
    std::vector<std::string> eaten;
    for (;;) eaten.emplace_back(8 << 20, 'x');
  }
  if (says("worker_lies")) {
    std::fputs("this is no scene at all, but it is long enough to look like one", stdout);
    return 0;
  }
  return lucerna::scene::importWorker(path);
}
