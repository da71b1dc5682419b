// The import worker's answer as bytes: raw blocks in this machine's byte order, read back by the
// same program. What is read is untrusted all the same: the worker may have been taken over.
#pragma once

#include <span>

#include "core/result.hpp"
#include "scene/import/imported_scene.hpp"

namespace lucerna::scene {

Bytes writeStream(const ImportedScene& imported);

// Counts are checked against the bytes that are there before anything is allocated, and the scene
// by checkScene(). The error is one phrase, no sentence for the user.
Result<ImportedScene> readStream(std::span<const std::byte> bytes);

}  // namespace lucerna::scene
