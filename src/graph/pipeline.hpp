// A pipeline as data: the list of passes that a person edits.
//
//   {"lucerna": "pipeline/1", "name": "deferred", "output": "ToneMap.color",
//    "passes": [{"name": "Ao", "type": "ScreenSpaceAo", "enabled": true,
//                "reads": {"depth": "GBuffer.depth"}, "params": {"radius": 0.5}}, ...]}
//
// A row's `name` defaults to its type, `enabled` to true, `output` to the last enabled row's
// "color". `docs/user/pipeline.schema.json` is the schema.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "graph/fault.hpp"
#include "graph/value.hpp"

namespace lucerna::graph {

struct PassRow {
  std::string name, type;
  bool enabled = true;
  std::map<std::string, std::string>
      reads;  // input port -> "Row.port", or "Row" for the port of the same name
  ParamValues params;
  std::string place{};  // "deferred.js:12" or "row 3"; for messages
};

struct Pipeline {
  std::string name{};
  std::string output{};  // "Row.port" or ""
  std::vector<PassRow> passes{};
  std::string source{};  // file, for messages
  // What the text that it was read from has wrong (BadForm). validate() gives them with its own, so
  // that all faults are told at once; what is wrong is left out above.
  std::vector<Fault> formFaults{};
  std::string folder{};  // of that file; "" if the pipeline is compiled in
};

inline constexpr std::size_t kMaxPipelineRows = 256;

// Faults of form are in the result. An error (ErrorKind::Pipeline) is a text that is no JSON at
// all, or no object.
Result<Pipeline> pipelineFromJson(const std::string& text, const std::string& source);
// Gives the same pipeline back through pipelineFromJson, places aside.
std::string toJson(const Pipeline& pipeline);

class Registry;

// Makes paths (ParamType::File) that are relative to pipeline.folder relative to the working
// directory: "./" or "../" in front then tells them from paths of what is compiled in.
void resolveFiles(Pipeline& pipeline, const Registry& registry);

// One of --set: "Row.param=value", "Row.enabled=false" or "Row.reads.port=Other.port". Paths are
// relative to the working directory. Errors (ErrorKind::Usage) say which rows and parameters there
// are.
Status applySetting(Pipeline& pipeline, const Registry& registry, const std::string& setting);

}  // namespace lucerna::graph
