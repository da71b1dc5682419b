// The child process of importScene().
#pragma once

#include <string>

namespace lucerna::scene {

// `lucerna_worker import PATH`: writes the scene as a stream (scene_stream.hpp) to stdout, or one
// sentence to stderr. Returns the exit code.
int importWorker(const std::string& path);

}  // namespace lucerna::scene
