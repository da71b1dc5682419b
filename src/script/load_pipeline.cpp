#include "script/load_pipeline.hpp"

#include <filesystem>

#include "core/file.hpp"
#include "core/text.hpp"
#include "script/shipped.hpp"

namespace lucerna::script {

namespace {

Result<graph::Pipeline> readPipelineJson(const std::string& path, const ScriptInput& input) {
  if (!input.params.empty())
    return error(ErrorKind::Usage,
                 "{}: 'script.{}' is set, but a JSON pipeline has no parameters of its own", path,
                 input.params.begin()->first);
  LUCERNA_TRY(text, readText(path));
  LUCERNA_TRY(pipeline, graph::pipelineFromJson(text, path));
  if (pipeline.name.empty()) pipeline.name = std::filesystem::path(path).stem().string();
  return pipeline;
}

}  // namespace

std::vector<std::string> shippedPipelineNames() {
  std::vector<std::string> names;
  for (const EmbeddedText& file : shippedPipelines())
    names.emplace_back(file.name.substr(0, file.name.rfind('.')));
  return names;
}

Result<graph::Pipeline> loadPipeline(const std::string& nameOrFile, const ScriptInput& input) {
  const std::string extension = std::filesystem::path(nameOrFile).extension().string();
  if (extension == ".js" || extension == ".json") {
    LUCERNA_TRY(pipeline, extension == ".js" ? runPipelineScript(nameOrFile, input)
                                             : readPipelineJson(nameOrFile, input));
    pipeline.folder = std::filesystem::path(nameOrFile).parent_path().string();
    if (pipeline.folder.empty()) pipeline.folder = ".";
    return pipeline;
  }
  for (const EmbeddedText& file : shippedPipelines())
    if (file.name.substr(0, file.name.rfind('.')) == nameOrFile)
      return runPipelineSource(std::string(file.text), std::string(file.name), input);
  const std::vector<std::string> names = shippedPipelineNames();
  return error(ErrorKind::Usage,
               "pipeline '{}' is not known{}; the shipped ones are {}, a file ends in .js or .json",
               nameOrFile, didYouMean(nameOrFile, names), join(names));
}

}  // namespace lucerna::script
