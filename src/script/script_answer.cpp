#include "script/script_answer.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace lucerna::script {
namespace {

using Json = nlohmann::json;

// Of nested lists and objects: what writes them again recurses. The pipeline's own limit is far
// lower and says more.
constexpr int kMaxDepth = 1000;

// Params that were given but that the script never asked for.
Status checkAllUsed(const ScriptInput& input, const std::vector<std::string>& declared,
                    const std::string& name) {
  for (const auto& [param, value] : input.params) {
    if (std::find(declared.begin(), declared.end(), param) != declared.end()) continue;
    return error(ErrorKind::Usage, "{}: the script has no parameter '{}'{}; it has {}", name, param,
                 didYouMean(param, declared),
                 declared.empty() ? std::string("none") : join(declared));
  }
  return {};
}

// Not an object: there is none, or it nests too deep.
Json parse(std::string_view answer) {
  bool tooDeep = false;
  const auto watchDepth = [&](int depth, Json::parse_event_t, Json&) {
    tooDeep = tooDeep || depth > kMaxDepth;
    return !tooDeep;
  };
  Json parsed = Json::parse(answer, watchDepth, /*allow_exceptions=*/false);
  return tooDeep ? Json() : parsed;
}

// Throws Json::exception where a member is missing or of another type.
Result<graph::Pipeline> fromJson(Json answer, const std::string& name, const ScriptInput& input) {
  if (const auto failure = answer.find("error"); failure != answer.end())
    return Error{ErrorKind::Pipeline, failure->get_ref<const std::string&>()};
  LUCERNA_TRY_VOID(checkAllUsed(input, answer.at("params").get<std::vector<std::string>>(), name));
  Json& rows = answer.at("pipeline").at("passes");
  const auto& lines = answer.at("places").get_ref<const Json::array_t&>();
  if (lines.size() != rows.size())
    return error(
        ErrorKind::Pipeline,
        "{}: the script changed what the engine itself uses and came back with {} rows and {} "
        "places; leave the built-in prototypes alone",
        name, rows.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    rows.at(i)["place"] =
        fmt::format("{}:{}", name, lines[i].get_ref<const Json::number_unsigned_t&>());
  LUCERNA_TRY(pipeline, graph::pipelineFromJson(answer["pipeline"].dump(), name));
  if (pipeline.name.empty()) pipeline.name = std::filesystem::path(name).stem().string();
  return pipeline;
}

}  // namespace

Result<graph::Pipeline> pipelineFromAnswer(std::string_view answer, const std::string& name,
                                           const ScriptInput& input) {
  Json parsed = parse(answer);
  if (!parsed.is_object())
    return error(ErrorKind::Pipeline, "{}: the script's process gave no readable answer", name);
  try {
    return fromJson(std::move(parsed), name, input);
  } catch (const Json::exception& e) {
    return error(ErrorKind::Pipeline, "{}: the script's process gave a damaged answer ({})", name,
                 e.what());
  }
}

}  // namespace lucerna::script
