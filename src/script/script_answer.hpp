// What the parent makes of the script process's answer.
#pragma once

#include <string>
#include <string_view>

#include "script/script.hpp"

namespace lucerna::script {

// The answer is the text that prelude.js ends with: {"pipeline", "places", "params"} or {"error"}.
// The script shares its process with the code that answers, so nothing in it is trusted. Errors are
// those of runPipelineSource().
Result<graph::Pipeline> pipelineFromAnswer(std::string_view answer, const std::string& name,
                                           const ScriptInput& input);

}  // namespace lucerna::script
