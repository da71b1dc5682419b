#include "app/row_files.hpp"

#include <algorithm>

namespace lucerna::app {
namespace {

struct Writer {
  std::string name;                 // "-o", "'Albedo'"
  std::string param;                // "Albedo.file"; of -o none
  std::string pattern;              // as given
  std::vector<NumberedPath> files;  // one a view
};

// So that "out.png" and "./out.png" are one. The folder has no frame number, or is none yet.
std::string inRealFolder(const std::string& pattern) {
  const std::filesystem::path path(pattern);
  std::error_code noFolder;
  const auto folder = std::filesystem::weakly_canonical(
      path.has_parent_path() ? path.parent_path() : ".", noFolder);
  return noFolder ? pattern : (folder / path.filename()).string();
}

std::optional<Writer> writerOf(const graph::PassRow& row, const graph::ParamDescription& param,
                               int views) {
  const auto given = row.params.find(param.name);
  const auto* pattern =
      std::get_if<std::string>(given == row.params.end() ? &param.defaultValue : &given->second);
  if (!pattern) return std::nullopt;
  const auto path = NumberedPath::parse(inRealFolder(*pattern));
  if (!path) return std::nullopt;
  Writer writer{.name = fmt::format("'{}'", row.name),
                .param = row.name + "." + param.name,
                .pattern = *pattern,
                .files = {}};
  for (int view = 0; view < views; ++view)
    writer.files.push_back(views == 1 ? *path : path->ofView(view));
  return writer;
}

bool meet(const Writer& a, const Writer& b, std::uint64_t frames) {
  return std::ranges::any_of(a.files, [&](const NumberedPath& first) {
    return std::ranges::any_of(
        b.files, [&](const NumberedPath& second) { return first.meets(second, frames); });
  });
}

}  // namespace

Status checkRowFiles(const graph::Pipeline& pipeline, const graph::Registry& registry,
                     const FrameName& output, const RenderSettings& settings) {
  std::vector<Writer> writers;
  if (const auto path = NumberedPath::parse(inRealFolder(output.pattern())))
    writers.push_back({.name = "-o", .param = "", .pattern = output.pattern(), .files = {*path}});
  for (const graph::PassRow& row : pipeline.passes) {
    const graph::PassType* type = registry.find(row.type);
    if (!type || !row.enabled) continue;
    for (const graph::ParamDescription& param : type->describe(row.params).params) {
      if (!param.writesFile) continue;
      const auto writer = writerOf(row, param, settings.stereo.eyes());
      if (!writer) continue;
      for (const Writer& other : writers)
        if (meet(other, *writer, settings.frames))
          return error(ErrorKind::Usage,
                       "{} and {} would write the same file, '{}'; give the row another one by "
                       "--set {}=NAME",
                       other.name, writer->name, writer->pattern, writer->param);
      writers.push_back(*writer);
    }
  }
  return {};
}

}  // namespace lucerna::app
