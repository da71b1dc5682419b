// Pipeline scripts: a .js file is a program that produces the same data as a .json pipeline. It
// runs in a child process (core/worker_program.hpp), so that a loop without end or an allocation
// without bounds becomes an error message. docs/user/pipelines.md describes the globals.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/result.hpp"
#include "graph/pipeline.hpp"

namespace lucerna::script {

struct ScriptInput {
  std::map<std::string, std::string> params;  // values of param(), by name, as text
  std::uint64_t seed = 0;                     // of Math.random
};

// Errors (ErrorKind::Pipeline) read "file:line: message". Each row's place is "file:line" of its
// pass() call. What the script prints goes to stderr.
Result<graph::Pipeline> runPipelineScript(const std::string& path, const ScriptInput& input = {});

// The same for source text; `name` stands for the file in messages.
Result<graph::Pipeline> runPipelineSource(const std::string& source, const std::string& name,
                                          const ScriptInput& input = {});

// The child's side: reads the request from stdin, writes the answer to stdout, returns the exit
// code.
int scriptWorker();

}  // namespace lucerna::script
