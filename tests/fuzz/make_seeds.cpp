// Writes the seeds and the dictionary that must follow the code: what passes declare, and the
// workers' streams.   fuzz_make_seeds FOLDER
#include <cstdio>
#include <set>

#include "core/file.hpp"
#include "graph/pipeline.hpp"
#include "passes/register_passes.hpp"
#include "scene/gltf/draco_decode.hpp"
#include "scene/import/scene_stream.hpp"

namespace lucerna {
namespace {

namespace fs = std::filesystem;

std::string dictionary(const graph::Registry& registry) {
  std::set<std::string> words{"lucerna", "pipeline/1", "output", "passes", "name", "type",
                              "enabled", "reads",      "params", "true",   "false"};
  for (const auto& resource : registry.resources()) words.insert(resource.name);
  for (const std::string& type : registry.typeNames()) {
    words.insert(type);
    const graph::PassDescription pass = registry.find(type)->describe({});
    for (const graph::PortDescription& port : pass.ports) words.insert(port.name);
    for (const graph::ParamDescription& param : pass.params) {
      words.insert(param.name);
      words.insert(param.choices.begin(), param.choices.end());
    }
  }
  std::string text;
  for (const std::string& word : words) text += "\"" + word + "\"\n";
  return text;
}

graph::PassRow rowOf(const std::string& type) {
  graph::PassRow row;
  row.name = row.type = type;
  return row;
}

// Behind the rows of a deferred picture a row of the type, with all its parameters spelt out.
std::string pipelineWith(const std::string& type, const graph::Registry& registry) {
  graph::Pipeline pipeline;
  for (const char* before : {"Cull", "GBuffer", "TiledLighting", "Background"})
    pipeline.passes.push_back(rowOf(before));
  graph::PassRow row = rowOf(type);
  row.name = "It";
  for (const graph::ParamDescription& param : registry.find(type)->describe({}).params)
    row.params[param.name] = param.defaultValue;
  pipeline.passes.push_back(row);
  return graph::toJson(pipeline);
}

// Something of everything.
scene::ImportedScene importedScene() {
  scene::ImportedScene imported;
  imported.textures.emplace_back().path = "a.png";
  scene::Scene& scene = imported.scene;
  scene::Mesh& mesh = scene.meshes.emplace_back();
  mesh.positions = {vec3(0.f), vec3(1.f, 0.f, 0.f), vec3(0.f, 1.f, 0.f)};
  mesh.normals.assign(3, vec3(0.f, 0.f, 1.f));
  mesh.texCoords[0] = {vec2(0.f), vec2(1.f, 0.f), vec2(0.f, 1.f)};
  mesh.indices = {0, 1, 2};
  scene::Material& material = scene.materials.emplace_back();
  material.albedoTexture.texture = material.normalTexture.texture = 0;
  const std::uint32_t node = scene::addNode(scene, "node", mat4(1.f));
  scene::Node child;
  child.parent = node;
  child.matrix = mat4(2.f);
  scene::addNode(scene, child);
  scene::Object& object = scene.objects.emplace_back();
  object.node = node;
  object.mesh = object.material = 0;
  scene.lights.emplace_back().node = node;
  scene.cameras.emplace_back().node = node;
  scene::AnimationChannel& channel = scene.animations.emplace_back().channels.emplace_back();
  channel.node = node;
  channel.times = {0.f, 1.f};
  channel.values = {vec4(0.f), vec4(1.f)};
  scene.warnings.emplace_back("a warning");
  scene.bake.area.emplace();
  scene.bake.patchTolerance = 1.f;
  scene.bake.mapSize = 2048;
  return imported;
}

// As draco_answer_fuzz.cpp asks for them.
std::vector<scene::gltf::DracoMesh> dracoMeshes() {
  return {{.fault = "", .indices = {0, 1, 2}, .attributes = {Bytes(36), Bytes(12)}},
          {.fault = "", .indices = {0, 1, 2, 2, 1, 3}, .attributes = {Bytes(16)}}};
}

Status write(const fs::path& folder) {
  graph::Registry registry;
  passes::registerPasses(registry);
  std::error_code ignored;  // writing tells
  fs::create_directories(folder / "pipeline", ignored);
  fs::create_directories(folder / "import_answer", ignored);
  fs::create_directories(folder / "draco_answer", ignored);
  LUCERNA_TRY_VOID(writeText(folder / "pipeline.dict", dictionary(registry)));
  for (const std::string& type : registry.typeNames())
    LUCERNA_TRY_VOID(
        writeText(folder / "pipeline" / (type + ".json"), pipelineWith(type, registry)));
  LUCERNA_TRY_VOID(
      writeFile(folder / "draco_answer/meshes.bin", scene::gltf::writeDracoAnswer(dracoMeshes())));
  return writeFile(folder / "import_answer/scene.bin", scene::writeStream(importedScene()));
}

}  // namespace
}  // namespace lucerna

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "fuzz_make_seeds FOLDER\n");
    return 2;
  }
  const lucerna::Status written = lucerna::write(arguments[1]);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written ? 0 : 1;
}
