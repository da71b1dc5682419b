// The child process of decodeDraco().
#pragma once

namespace lucerna::scene::gltf {

// `lucerna_worker draco`: reads requests from stdin, writes meshes to stdout. Returns the exit
// code.
int dracoWorker();

}  // namespace lucerna::scene::gltf
