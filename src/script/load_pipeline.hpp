// The one way in for pipelines: a shipped name, a .js or a .json file.
#pragma once

#include <string>
#include <vector>

#include "script/script.hpp"

namespace lucerna::script {

std::vector<std::string> shippedPipelineNames();  // "deferred", ...

// nameOrFile: a shipped name, or a path that ends in .js or .json. `input` is for scripts.
// Errors: ErrorKind::Pipeline, ErrorKind::Input (no such file), ErrorKind::Usage (unknown name).
Result<graph::Pipeline> loadPipeline(const std::string& nameOrFile, const ScriptInput& input = {});

}  // namespace lucerna::script
