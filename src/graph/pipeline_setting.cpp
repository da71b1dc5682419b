// --set Row.param=value, and the files that rows name.
#include <algorithm>
#include <filesystem>

#include "core/text.hpp"
#include "graph/pipeline.hpp"
#include "graph/registry.hpp"
#include "graph/value_check.hpp"

namespace lucerna::graph {
namespace {

std::string resolved(const std::string& path, const std::string& folder) {
  if (path.empty()) return path;
  const std::string name =
      (std::filesystem::path(folder) / path).lexically_normal().generic_string();
  return name.starts_with("/") || name.starts_with("../") ? name : "./" + name;
}

std::vector<std::string> rowNames(const Pipeline& pipeline) {
  std::vector<std::string> names;
  for (const PassRow& row : pipeline.passes) names.push_back(row.name);
  return names;
}

Status setEnabled(PassRow& row, const std::string& text) {
  const ParamDescription enabled{
      .name = row.name + ".enabled", .type = ParamType::Bool, .defaultValue = true};
  LUCERNA_TRY(value, parseValue(enabled, text));
  row.enabled = std::get<bool>(value);
  return {};
}

Status setRead(PassRow& row, const PassDescription& description, const std::string& port,
               const std::string& from) {
  std::vector<std::string> inputs;
  for (const PortDescription& p : description.ports)
    if (p.direction != Direction::Out) inputs.push_back(p.name);
  if (!description.input(port))
    return error(ErrorKind::Usage, "pass '{}' has no input '{}'{}; its inputs: {}", row.name, port,
                 didYouMean(port, inputs), inputs.empty() ? "none" : join(inputs));
  if (from.empty())
    row.reads.erase(port);
  else
    row.reads[port] = from;
  return {};
}

Status setParam(PassRow& row, const PassDescription& description, const std::string& name,
                const std::string& text) {
  const ParamDescription* param = description.param(name);
  if (!param) {
    std::vector<std::string> known;
    for (const ParamDescription& p : description.params) known.push_back(p.name);
    known.emplace_back("enabled");
    return error(ErrorKind::Usage, "pass '{}' ({}) has no parameter '{}'{}; it has: {}", row.name,
                 row.type, name, didYouMean(name, known), join(known));
  }
  LUCERNA_TRY(value, parseValue(*param, text));
  row.params[name] = param->type == ParamType::File ? Value(resolved(text, ".")) : value;
  return {};
}

}  // namespace

void resolveFiles(Pipeline& pipeline, const Registry& registry) {
  if (pipeline.folder.empty()) return;
  for (PassRow& row : pipeline.passes) {
    const PassType* type = registry.find(row.type);
    if (!type) continue;
    for (const ParamDescription& param : type->describe({}).params) {
      const auto value = row.params.find(param.name);
      if (param.type != ParamType::File || value == row.params.end()) continue;
      if (auto* path = std::get_if<std::string>(&value->second))
        *path = resolved(*path, pipeline.folder);
    }
  }
}

Status applySetting(Pipeline& pipeline, const Registry& registry, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::size_t dot = setting.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals || dot == 0 ||
      dot + 1 == equals)
    return error(ErrorKind::Usage,
                 "--set '{}': wanted Pass.param=value, Pass.enabled=false or "
                 "Pass.reads.port=Other.port",
                 setting);
  const std::string rowName = setting.substr(0, dot);
  const std::string key = setting.substr(dot + 1, equals - dot - 1);
  const std::string text = setting.substr(equals + 1);
  const auto row = std::find_if(pipeline.passes.begin(), pipeline.passes.end(),
                                [&](const PassRow& r) { return r.name == rowName; });
  if (row == pipeline.passes.end()) {
    const std::vector<std::string> names = rowNames(pipeline);
    return error(ErrorKind::Usage, "--set '{}': no pass is named '{}'{}; the pipeline has: {}",
                 setting, rowName, didYouMean(rowName, names), join(names));
  }
  const PassType* type = registry.find(row->type);
  if (!type) {
    const std::vector<std::string> types = registry.typeNames();
    return error(ErrorKind::Usage, "--set '{}': pass '{}' has the unknown type '{}'{}", setting,
                 rowName, row->type, didYouMean(row->type, types));
  }
  const PassDescription description = describeChecked(*type, row->params);
  const Status status = key == "enabled" ? setEnabled(*row, text)
                        : key.starts_with("reads.")
                            ? setRead(*row, description, key.substr(6), text)
                            : setParam(*row, description, key, text);
  if (!status) return error(ErrorKind::Usage, "--set '{}': {}", setting, status.error().message);
  return {};
}

}  // namespace lucerna::graph
