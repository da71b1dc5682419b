#include "scene/gltf/gltf_writer.hpp"

#include <algorithm>

#include "core/hash.hpp"
#include "scene/gltf/writer_parts.hpp"

namespace lucerna::scene {
namespace gltf {

void Notes::add(const std::string& what) {
  const auto known = std::ranges::find(counts_, what, &std::pair<std::string, std::size_t>::first);
  if (known == counts_.end())
    counts_.emplace_back(what, 1);
  else
    ++known->second;
}

std::vector<std::string> Notes::sentences() const {
  std::vector<std::string> result;
  for (const auto& [what, count] : counts_)
    result.push_back(count == 1 ? what : fmt::format("{} ({} times)", what, count));
  return result;
}

std::size_t Output::append(const char* array, Json value) {
  Json& list = root[array];
  list.push_back(std::move(value));
  return list.size() - 1;
}

Json& Output::extend(Json& owner, const char* extension) {
  extensions.insert(extension);
  Json& made = owner["extensions"][extension];
  if (made.is_null()) made = Json::object();
  return made;
}

Json jsonOf(vec2 v) {
  return {v.x, v.y};
}
Json jsonOf(vec3 v) {
  return {v.x, v.y, v.z};
}
Json jsonOf(vec4 v) {
  return {v.x, v.y, v.z, v.w};
}

namespace {

Status writeWith(const std::filesystem::path& folder, const std::string& name,
                 std::span<const std::byte> bytes, GltfReport& report) {
  LUCERNA_TRY_VOID(writeFile(folder / name, bytes));
  report.files.push_back({name, hashBytes(bytes)});
  return {};
}

}  // namespace
}  // namespace gltf

Result<GltfReport> writeGltf(const Scene& scene, const std::filesystem::path& folder,
                             const GltfSettings& settings) {
  LUCERNA_TRY_VOID(gltf::checkLightmaps(settings));
  gltf::Output out{.scene = scene, .settings = settings};
  out.root["asset"] = {{"version", "2.0"}, {"generator", "Lucerna"}};
  gltf::TextureWriter textures(out);
  gltf::MaterialWriter materials(out, textures);
  gltf::MeshWriter meshes(out, materials);
  gltf::writeNodes(out, meshes);
  if (!out.extensions.empty()) out.root["extensionsUsed"] = out.extensions;

  GltfReport report;
  LUCERNA_TRY(pictures, gltf::writePictures(folder, textures.pictures()));
  report.files = std::move(pictures);
  if (!out.binary.empty()) {
    const std::string binary = settings.name + ".bin";
    out.append("buffers", {{"uri", binary}, {"byteLength", out.binary.size()}});
    LUCERNA_TRY_VOID(gltf::writeWith(folder, binary, out.binary, report));
  }
  // Names may come from files that are not in UTF-8.
  const std::string text =
      out.root.dump(-1, ' ', false, gltf::Json::error_handler_t::replace) + "\n";
  LUCERNA_TRY_VOID(gltf::writeWith(folder, settings.name + ".gltf",
                                   std::as_bytes(std::span<const char>(text)), report));
  report.notes = out.notes.sentences();
  return report;
}

}  // namespace lucerna::scene
