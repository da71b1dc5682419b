// A pipeline as data: the list of passes that a person edits.
//
//   {"lucerna": "pipeline/1", "name": "deferred", "output": "ToneMap.color",
//    "passes": [{"name": "Ao", "type": "ScreenSpaceAo", "enabled": true,
//                "reads": {"depth": "GBuffer.depth"}, "params": {"radius": 0.5}}, ...]}
//
// `name` defaults to the type, `enabled` to true, `output` to the last enabled row's "color".
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "graph/value.hpp"

namespace lucerna::graph {

struct PassRow {
  std::string name, type;
  bool enabled = true;
  std::map<std::string, std::string>
      reads;  // input port -> "Row.port", or "Row" for the port of the same name
  ParamValues params;
  std::string place;  // "deferred.js:12" or "row 3"; for messages
};

struct Pipeline {
  std::string name;
  std::string output;  // "Row.port" or ""
  std::vector<PassRow> passes;
  std::string source;  // file, for messages
};

// Errors (ErrorKind::Pipeline) list every fault of form, each with its place.
Result<Pipeline> pipelineFromJson(const std::string& text, const std::string& source);
std::string toJson(const Pipeline& pipeline);

class Registry;

// "Pass.param=value" and "Pass.enabled=false" of --set. Errors (ErrorKind::Usage) say which rows
// and parameters there are.
Status applySetting(Pipeline& pipeline, const Registry& registry, const std::string& setting);

}  // namespace lucerna::graph
